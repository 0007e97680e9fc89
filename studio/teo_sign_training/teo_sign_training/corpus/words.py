# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The words that fill slots: by class, the common ones more often, some held out for tests."""

from __future__ import annotations

import hashlib
from bisect import bisect
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import accumulate
from pathlib import Path
from random import Random

from teo_sign_training.corpus.grammar import Grammar
from teo_sign_training.corpus.writing import Clitics
from teo_sign_translator.data_files import read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.text.rules import TextRules

#: One word in this many is held out.
_HELD_OUT_ONE_IN = 20
#: A word is this much less likely in a class that it is listed in but that says it less well than another.
_SECONDARY = 0.05
#: The r-th word of a class has weight 1 / (r + this): the twentieth is half as likely as the first.
_RANK_OFFSET = 20

#: `-` is of languages without gender.
_GENDERS = {"m": "m", "f": "f", "mf": "mf", "m+f": "mf", "mp": "m", "fp": "f", "inv": "mf", "-": "-"}


@dataclass(frozen=True, slots=True, eq=False)
class ListedWord:
    """A word that may fill a slot.

    Attributes:
        lemma: Dictionary form.
        features: Gender and class of a noun; frame and arguments of a verb.
    """

    lemma: str
    features: Mapping[str, str]


@dataclass(frozen=True)
class Pool:
    """Words with their weights; the held-out ones apart."""

    known: tuple[ListedWord, ...]
    known_weights: tuple[float, ...]
    held: tuple[ListedWord, ...]
    held_weights: tuple[float, ...]

    @classmethod
    def of(cls, weighted: Iterable[tuple[ListedWord, float]], held_out: frozenset[str]) -> Pool:
        """A pool of words and weights."""
        known = [(word, weight) for word, weight in weighted if word.lemma not in held_out]
        held = [(word, weight) for word, weight in weighted if word.lemma in held_out]
        return cls(
            tuple(word for word, _ in known),
            tuple(accumulate(weight for _, weight in known)),
            tuple(word for word, _ in held),
            tuple(accumulate(weight for _, weight in held)),
        )

    def draw(self, random: Random, held: bool) -> ListedWord | None:
        """A word, or None if there is none."""
        words, weights = (
            (self.held, self.held_weights) if held and self.held else (self.known, self.known_weights)
        )
        return words[bisect(weights, random.random() * weights[-1])] if words else None


def is_held_out(lemma: str) -> bool:
    """Whether a word is held out of training: by its hash, so the same words in every run."""
    return int.from_bytes(hashlib.sha256(lemma.encode()).digest()[:4], "big") % _HELD_OUT_ONE_IN == 0


@dataclass
class WordLists:
    """All word lists.

    Attributes:
        morphology: Inflects.
        rules: How numbers and short forms are said.
        nouns: Columns by lemma and class: gender, classes.
        adjectives: Likewise: gender, classes, use.
        adverbs: By class.
        names: By class.
        verbs: Entries by frame.
        lists: The grammar's own lists.
        clitics: Tell verbs that take a reflexive pronoun.
        held_out: Lemmas that only tests see.
    """

    morphology: Morphology
    rules: TextRules
    nouns: list[ListedWord]
    adjectives: list[ListedWord]
    adverbs: list[ListedWord]
    names: list[ListedWord]
    verbs: list[ListedWord]
    lists: Mapping[str, tuple[str, ...]]
    clitics: Clitics
    held_out: frozenset[str] = frozenset()
    _pools: dict[tuple[object, ...], Pool] = field(default_factory=dict)
    _forms: dict[tuple[str, str], str] = field(default_factory=dict)

    @classmethod
    def load(cls, grammar_folder: Path, morphology: Morphology, grammar: Grammar) -> WordLists:
        """Read `verbs.tsv` of the grammar's folder and the `lexicon` folder beside it.

        Raises:
            TranslationError: "invalid_data" naming file and line.
        """
        lexicon = grammar_folder.parent / "lexicon"
        return cls(
            morphology,
            TextRules.load(morphology.folder),
            _merged(_listed(lexicon / "nouns.tsv", ("gender", "classes", "forms"))),
            _merged(_listed(lexicon / "adjectives.tsv", ("gender", "classes", "use", "forms"))),
            _merged(_listed(lexicon / "adverbs.tsv", ("classes",))),
            _merged(_listed(lexicon / "names.tsv", ("classes",))),
            _listed(grammar_folder / "verbs.tsv", ("frame", "kind", "subject", "object", "det", "other")),
            grammar.word_lists,
            grammar.writing.clitics,
        )

    def inflect(self, lemma: str, tag: str) -> str:
        """The form of a lemma that a tag names, from a cache if it was asked for before.

        Raises:
            TranslationError: "no_form".
        """
        key = (lemma, tag)
        form = self._forms.get(key)
        if form is None:
            form = self._forms[key] = self.morphology.inflect(lemma, tag)
        return form

    def pool(self, category: str, arguments: Mapping[str, str]) -> Pool:
        """The words that fit a slot.

        Raises:
            TranslationError: "invalid_grammar" if the slot names an unknown word or class.
        """
        key = (category, *arguments.items())
        pool = self._pools.get(key)
        if pool is None:
            build = {
                "noun": self._nouns,
                "adj": self._adjectives,
                "verb": self._verbs,
                "name": self._names,
                "adverb": self._adverbs,
            }[category]
            pool = self._pools[key] = Pool.of(list(build(arguments)), self.held_out)
        return pool

    def _nouns(self, arguments: Mapping[str, str]) -> Iterable[tuple[ListedWord, float]]:
        number = arguments.get("num", "s")
        for word, weight in self._chosen(self.nouns, arguments.get("class", ""), "noun"):
            if not word.lemma.replace("_", "").isalpha():
                continue  # mp3 is two words to a reader of sentences
            gender = word.features["gender"]
            only_plural = gender in ("mp", "fp")
            kind = word.features["classes"].split(",")[0]
            mass = word.lemma in self.lists["mass"] or kind in self.lists["mass_classes"]
            either = word.lemma in self.lists["mass_or_not"]
            if only_plural and number == "p":
                continue  # they are among the singulars, which their sense is
            if mass and not either and (number == "p" or arguments.get("count") == "yes"):
                continue
            if not mass and not either and arguments.get("count") == "no":
                continue
            wanted = arguments.get("gender", "")
            for each in _GENDERS[gender]:
                if wanted and each != wanted:
                    continue
                written = "p" if only_plural else number
                # One form of both genders has a tag of its own.
                form = {"mf": "c", "-": ""}.get(gender, each)
                features = {
                    "gender": each,
                    "number": written,
                    "person": "3",
                    "class": kind,
                    "tag": f"N:{form}{written}",
                }
                if only_plural:
                    features["plural_only"] = "yes"
                yield ListedWord(word.lemma, features), weight / len(_GENDERS[gender])

    def _adjectives(self, arguments: Mapping[str, str]) -> Iterable[tuple[ListedWord, float]]:
        use = arguments.get("use", "")
        classes = arguments.get("class", "")
        fits = arguments.get("fits", "")
        if fits:
            classes = ",".join(self.lists.get(f"fits_{fits}", self.lists["fits_object"]))
        for word, weight in self._chosen(self.adjectives, classes, "adjective"):
            if use and word.features["use"] not in (use, "both"):
                continue
            yield word, weight

    def _verbs(self, arguments: Mapping[str, str]) -> Iterable[tuple[ListedWord, float]]:
        if "lemma" in arguments:
            for lemma in arguments["lemma"].split(","):
                bare, pronominal = self.clitics.bare(lemma)
                yield ListedWord(bare, {"pronominal": "yes" if pronominal else "", "kind": "state"}), 1.0
            return
        entries = [verb for verb in self.verbs if verb.features["frame"] == arguments["frame"]]
        if not entries:
            raise TranslationError(
                "invalid_grammar", f"verbs.tsv: expected a verb of frame '{arguments['frame']}'"
            )
        for rank, verb in enumerate(entries):
            bare, pronominal = self.clitics.bare(verb.lemma)
            features = {key: value for key, value in verb.features.items() if value != "-"} | {
                "pronominal": "yes" if pronominal else ""
            }
            if "det" in features:
                features["det"] = ",".join(features["det"])
            features["kind"] = "event" if verb.features["kind"] == "e" else "state"
            yield ListedWord(bare, features), 1 / (rank + 40)

    def _names(self, arguments: Mapping[str, str]) -> Iterable[tuple[ListedWord, float]]:
        for word, weight in self._chosen(self.names, arguments["class"], "name"):
            gender = "f" if "f" in word.features["classes"].split(",") else "m"
            yield ListedWord(word.lemma, {"gender": gender, "number": "s", "person": "3"}), weight

    def _adverbs(self, arguments: Mapping[str, str]) -> Iterable[tuple[ListedWord, float]]:
        yield from self._chosen(self.adverbs, arguments["class"], "adverb")

    def _chosen(self, words: list[ListedWord], classes: str, what: str) -> Iterable[tuple[ListedWord, float]]:
        """Words of classes, of the grammar's lists or named; each class has the same weight."""
        by_lemma = {word.lemma: word for word in words}
        known = {each for word in words for each in word.features["classes"].split(",")}
        for name in filter(None, classes.split(",")):
            if name in known:
                members = [word for word in words if name in word.features["classes"].split(",")]
                members.sort(key=lambda word: word.features["classes"].split(",")[0] != name)
                weights = [
                    (1 if word.features["classes"].split(",")[0] == name else _SECONDARY)
                    / (rank + _RANK_OFFSET)
                    for rank, word in enumerate(members)
                ]
            else:
                lemmas = self.lists.get(name, (name,))
                missing = [lemma for lemma in lemmas if lemma not in by_lemma]
                if missing:
                    raise TranslationError(
                        "invalid_grammar",
                        f"expected a class, a list or {what}s of the lexicon, got {missing} in '{name}'",
                    )
                members = [by_lemma[lemma] for lemma in lemmas]
                weights = [1 / (rank + _RANK_OFFSET) for rank in range(len(members))]
            scale = 1 if name in known or name in self.lists else 0.3
            total = sum(weights)
            for word, weight in zip(members, weights, strict=True):
                yield word, scale * weight / total


def _listed(path: Path, columns: tuple[str, ...]) -> list[ListedWord]:
    return [
        ListedWord(fields[0], dict(zip(columns, fields[1:], strict=True)))
        for _, fields in read_rows(path, columns=len(columns) + 1)
    ]


def _merged(words: list[ListedWord]) -> list[ListedWord]:
    """One entry a lemma, its classes joined; the first line's other columns count."""
    merged: dict[str, ListedWord] = {}
    for word in words:
        before = merged.get(word.lemma)
        if before:
            classes = dict.fromkeys(
                [*before.features["classes"].split(","), *word.features["classes"].split(",")]
            )
            word = ListedWord(word.lemma, {**before.features, "classes": ",".join(classes)})
        merged[word.lemma] = word
    return list(merged.values())
