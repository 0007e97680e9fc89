# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What becomes of words that the model leaves out of its translation: one policy.

1. A word has to be signed unless it is a function word, by the list `function_words.tsv`.
2. A gloss signs the word whose dictionary form it is, and the words that `gloss_words.tsv` lists for it.
3. Of the model's translations the one that leaves out the fewest words is taken.
4. What that leaves out is put back as the gloss of its dictionary form, beside the gloss of the nearest word;
   a question word goes last, as LSE asks; a courtesy ("por favor") is the first or the last sign.
5. A word is signed once: a dictionary form that is carried over goes if its words are signed already.
6. Where a language has `wordless.tsv`, no gloss is said without a word for it, but those that it lists.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.data_files import read_listed, read_rows
from teo_sign_translator.morphology import TAGS, Reading
from teo_sign_translator.pipeline.pipeline_words import CompletenessWords, PipelineWords
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.pointer.vocabulary import copied_gloss
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.source_word import SourceWord

#: Of a gloss that was put back: its word is right, its place a guess. Below the translator's threshold, so
#: that its sentence is called uncertain.
_PUT_BACK_CONFIDENCE = 0.2

#: Of a gloss that a rule reads from the words.
_READ_CONFIDENCE = 0.9

#: Of a courtesy: it stands first or last, as typed, and changes nothing else in the sentence.
_COURTESY_CONFIDENCE = 0.9

_ANY = "*"
_THIRD = (":3s", ":3p")
# Tags of words that LSE signs last.
_LAST = ("WH",)
# Of words that may be signed at two places.
_AGAIN = ("ADV:neg", "PRON", "DET:poss")


@dataclass(frozen=True, slots=True)
class CompleteTranslation:
    """The glosses of a sentence, none of its words left out.

    Attributes:
        glosses: In signing order.
        put_back: For each whether the model had left its word out.
        given: Whether it is the known translation of a given sentence, which leaves out what it likes.
    """

    glosses: tuple[OutputGloss, ...]
    put_back: tuple[bool, ...]
    given: bool = False

    def without(self, places: Collection[int]) -> CompleteTranslation:
        """The same without some glosses, whose words others say."""
        return self.in_order([place for place in range(len(self.glosses)) if place not in places])

    def in_order(self, places: Sequence[int]) -> CompleteTranslation:
        """The same with the glosses of some places, in their order."""
        glosses = tuple(self.glosses[place] for place in places)
        return replace(self, glosses=glosses, put_back=tuple(self.put_back[place] for place in places))

    def with_glosses(self, place: int, *glosses: OutputGloss) -> CompleteTranslation:
        """The same with glosses put in at a place."""
        put_back = (*self.put_back[:place], *(True for _ in glosses), *self.put_back[place:])
        return replace(
            self, glosses=(*self.glosses[:place], *glosses, *self.glosses[place:]), put_back=put_back
        )


def read_gloss(name: str, place: int) -> OutputGloss:
    """A gloss that the word at a place asks for, by what stands around it."""
    return OutputGloss(name, (place,), _READ_CONFIDENCE, copied=False)


def own_places(words: Sequence[SourceWord], gloss: OutputGloss) -> set[int]:
    """Of the words that a gloss stands for those whose dictionary form it is; all if none is."""
    forms = {at for at in gloss.sources for each in words[at].readings if copied_gloss(each) == gloss.gloss}
    return forms or {*gloss.sources}


class FunctionWords:
    """Tells function words from words with a meaning of their own."""

    def __init__(self, lemmas: dict[str, frozenset[str]]) -> None:
        """Take lemmas by the beginning of the tag that they must have; `*` among them stands for all."""
        self._lemmas = dict(lemmas)
        self._by_tag: dict[tuple[str, bool], frozenset[str]] = {}

    @classmethod
    def load(cls, path: Path) -> FunctionWords:
        """Read a language's `function_words.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        return cls(
            read_listed(
                path, lambda tag: any(_begins(known, tag) for known in TAGS), "the beginning of a tag"
            )
        )

    def may_be_left_out(self, word: SourceWord) -> bool:
        """Whether one of a word's readings is a function word, or it is a mark.

        Who types accents means them: "quién" is not "quien"; "esta" may be "está". Who types a capital
        means a name: "Me llamo Al".
        """
        if word.capital and any(reading.tag.startswith("NAME") for reading in word.readings):
            return False
        plain = word.form == fold(word.form)
        return word.is_mark or any(self.lists(reading) for reading in word.readings if plain or reading.exact)

    def lists(self, reading: Reading) -> bool:
        """Whether this reading is that of a function word.

        A verb that is one in some of its forms alone counts only as typed: "media" is hardly "medía".
        """
        found = self._by_tag.get((reading.tag, reading.exact))
        if found is None:
            listed = [
                lemmas
                for tag, lemmas in self._lemmas.items()
                if _begins(reading.tag, tag) and (reading.exact or not tag.startswith("V:"))
            ]
            found = self._by_tag[reading.tag, reading.exact] = frozenset[str]().union(*listed)
        return _ANY in found or reading.lemma in found


@dataclass(frozen=True, slots=True)
class Completeness:
    """Chooses among a model's translations and puts back what the chosen one leaves out.

    Attributes:
        function_words: What may be left out.
        gloss_words: For each gloss the lemmas that it signs though they are not its own: ways to say it, each
            of one lemma or of several together.
        wordless: Glosses that no word need say, each with the beginnings of the tags of which a sentence must
            have one, if any; None if any gloss may be said so.
        words: Words of the language with a rule of their own.
        tags: Words that ask for agreement behind a sentence ("…, ¿no?"), and deny nothing there.
    """

    function_words: FunctionWords
    gloss_words: Mapping[str, frozenset[frozenset[str]]]
    wordless: Mapping[str, tuple[str, ...]] | None
    words: CompletenessWords
    tags: frozenset[str]

    @classmethod
    def load(cls, folder: Path) -> Completeness:
        """Read the lists of words, `pipeline.yaml` and `reading.yaml` of a language's text folder.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        return cls(
            FunctionWords.load(folder / "function_words.tsv"),
            read_gloss_words(folder / "gloss_words.tsv"),
            _read_wordless(folder / "wordless.tsv"),
            PipelineWords.load(folder).completeness,
            TextRules.load(folder).sentences.tags,
        )

    def without_words(self, words: Sequence[SourceWord], glosses: Iterable[str]) -> list[str]:
        """Those of a model's glosses that no word of a sentence says, and that must not be said without."""
        if self.wordless is None:
            return []
        by_gloss, by_lemma = _places(words)
        tags = [
            reading.tag
            for word in words
            for reading in _as_typed(word)
            if reading.lemma not in self.words.of_things or not reading.tag.endswith(_THIRD)
        ]
        free = {
            gloss
            for gloss, beginnings in self.wordless.items()
            if not beginnings or any(tag.startswith(beginnings) for tag in tags)
        }
        return [
            gloss
            for gloss in glosses
            if gloss not in by_gloss
            and gloss not in free
            and not any(by_lemma.keys() >= way for way in self.gloss_words.get(gloss, ()))
        ]

    def complete(self, words: Sequence[SourceWord], hypotheses: Iterable[Hypothesis]) -> CompleteTranslation:
        """The translation that leaves out the fewest words, with these put back.

        A sentence of nothing but function words has each of them signed, since it would be empty otherwise.

        Args:
            words: Of the sentence; one at least is no mark.
            hypotheses: Its translations, best first; at least one.
        """
        candidates = [
            tuple(
                each
                for each in self._each_word_once(words, hypothesis.glosses)
                if each.gloss not in self.words.unsaid
            )
            for hypothesis in hypotheses
        ]
        best = min(candidates, key=lambda glosses: len(self.left_out(words, glosses)))
        missing = {place: self._meant(words[place]) for place in self.left_out(words, best)}
        if not best and not missing:
            missing = {place: word.readings[0] for place, word in enumerate(words) if not word.is_mark}
        glosses = list(best)
        put_back = [False] * len(best)
        for place, reading in missing.items():
            index = len(glosses)
            if not reading.tag.startswith(_LAST):
                index = self._beside(place, words, glosses)
            gloss = OutputGloss(copied_gloss(reading), (place,), _PUT_BACK_CONFIDENCE, copied=True)
            glosses.insert(index, gloss)
            put_back.insert(index, True)
        courtesy = self._courtesy(words)
        if courtesy and all(gloss.gloss != self.words.courtesy_gloss for gloss in glosses):
            index = 0 if all(word.is_mark for word in words[: courtesy[0]]) else len(glosses)
            gloss = OutputGloss(self.words.courtesy_gloss, courtesy, _COURTESY_CONFIDENCE, copied=False)
            glosses.insert(index, gloss)
            put_back.insert(index, True)
        return CompleteTranslation(tuple(glosses), tuple(put_back))

    def _each_word_once(
        self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]
    ) -> tuple[OutputGloss, ...]:
        """Glosses without marks, without those carried over again, and none said twice in a row for no word.

        Of two for one word of a meaning of its own the one stays that stands for less besides it or is
        counted, else the later one: what modifies stands behind.
        """
        by_gloss, _ = _places(words)
        taken: set[int] = set()
        result: list[OutputGloss] = []
        for gloss in glosses:
            own = by_gloss.get(gloss.gloss, [])
            if not any(map(str.isalnum, gloss.gloss)):
                continue
            again = bool(result) and result[-1].gloss == gloss.gloss
            if taken.issuperset(own) and (again or (gloss.copied and own)):
                continue
            free = self.wordless is not None and gloss.gloss in self.wordless  # the hour in "a las tres"
            said = [] if free else [each for each in result if each.gloss == gloss.gloss]
            looked_at = set(own) & {*gloss.sources}
            if said and taken >= looked_at and any(map(self._has_meaning, (words[at] for at in looked_at))):
                before = result[: result.index(said[-1])]
                counted = bool(before) and before[-1].gloss[0].isdigit()
                if counted or len(gloss.sources) > len(said[-1].sources):
                    continue
                result.remove(said[-1])
            if own:
                taken.add(_likeliest(own, gloss, taken))
            result.append(gloss)
        return tuple(result)

    def _has_meaning(self, word: SourceWord) -> bool:
        """Whether a word is no function word and denies nothing: both may be said again where they belong."""
        return not word.tag.startswith(_AGAIN) and not self.function_words.may_be_left_out(word)

    def left_out(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[int]:
        """Places of the words that have to be signed and that no gloss signs."""
        signed = {place for places in self._signed(words, glosses) for place in places}
        exclaims = bool(words) and words[-1].form == "!"
        courtesy = self._courtesy(words)
        return [
            place
            for place, word in enumerate(words)
            if place not in signed
            and place not in courtesy
            and not self.function_words.may_be_left_out(word)
            and not self.words.says_only_the_future(words, place)
            and not self._asks_for_agreement(words, place)
            and not (exclaims and word.tag.startswith("WH"))  # "¡Qué bonito!" asks nothing
        ]

    def _signed(self, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> list[list[int]]:
        """For each gloss the places of the words that it signs.

        Of each dictionary form it signs one word, if it can one that no gloss before it signs, and one that
        the model looked at for it. What else the model looked at is not signed by it.
        """
        by_gloss, by_lemma = _places(words)
        taken: set[int] = set()
        result: list[list[int]] = []
        for gloss in glosses:
            ways = (way for way in self.gloss_words.get(gloss.gloss, ()) if by_lemma.keys() >= way)
            lemmas = sorted(frozenset[str]().union(*ways))
            choices = [by_gloss.get(gloss.gloss, []), *(by_lemma.get(lemma, []) for lemma in lemmas)]
            result.append([_likeliest(places, gloss, taken) for places in choices if places])
            taken.update(result[-1])
        return result

    def _courtesy(self, words: Sequence[SourceWord]) -> tuple[int, ...]:
        """Places of the words of the courtesy; empty if none is said."""
        count = len(self.words.courtesy)
        for first in range(len(words) + 1 - count) if count else ():
            if tuple(word.form for word in words[first : first + count]) == self.words.courtesy:
                return tuple(range(first, first + count))
        return ()

    def _asks_for_agreement(self, words: Sequence[SourceWord], place: int) -> bool:
        """Whether a word is "no" of "…, ¿no?"."""
        alone = place > 0 and words[place - 1].is_mark
        return (
            alone and words[place].form in self.tags and [word.form for word in words[place + 1 :]] == ["?"]
        )

    def _meant(self, word: SourceWord) -> Reading:
        """The likeliest reading of a word that was left out: a name where a capital says so."""
        names = (reading for reading in word.readings if word.capital and reading.tag.startswith("NAME"))
        others = (each for each in word.readings if not self.function_words.lists(each))
        return next(names, None) or next(others, None) or word.readings[0]

    def _beside(self, word: int, words: Sequence[SourceWord], glosses: Sequence[OutputGloss]) -> int:
        """Where the gloss of a word belongs: beside that of the nearest word, of two the one before."""
        best, index = float("inf"), len(glosses)
        for place, signed in enumerate(self._signed(words, glosses)):
            for source in signed:
                distance = 2 * abs(source - word) - (source < word)
                if distance < best or (distance == best and source < word):
                    best, index = distance, place + (source < word)
        return index


def read_gloss_words(path: Path) -> dict[str, frozenset[frozenset[str]]]:
    """For each gloss of a language's `gloss_words.tsv` the lemmas that it signs though they are not its own.

    Returns:
        By gloss the ways to say it; `not+know` is one of two lemmas.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    listed = read_listed(path, lambda gloss: gloss == gloss.upper(), "a gloss in capitals")
    return {gloss: frozenset(frozenset(way.split("+")) for way in ways) for gloss, ways in listed.items()}


def _read_wordless(path: Path) -> dict[str, tuple[str, ...]] | None:
    if not path.is_file():
        return None
    rows = [row for _, row in read_rows(path, columns=3)]
    return {gloss: () if tags == "*" else tuple(tags.split()) for gloss, tags, _ in rows}


def _as_typed(word: SourceWord) -> Sequence[Reading]:
    """What a word is as it was typed; what it would be with other accents, where it is nothing so."""
    return [reading for reading in word.readings if reading.exact] or word.readings


def _likeliest(places: Iterable[int], gloss: OutputGloss, taken: set[int]) -> int:
    return min(places, key=lambda place: (place in taken, place not in gloss.sources))


def _places(words: Sequence[SourceWord]) -> tuple[dict[str, list[int]], dict[str, list[int]]]:
    """Places of words by the glosses that they would be copied as, and by their lemmas."""
    by_gloss: dict[str, list[int]] = defaultdict(list)
    by_lemma: dict[str, list[int]] = defaultdict(list)
    for place, word in enumerate(words):
        if not word.is_mark:
            for lemma in {reading.lemma for reading in word.readings}:
                by_lemma[lemma].append(place)
            for gloss in {copied_gloss(reading) for reading in word.readings}:
                by_gloss[gloss].append(place)
    return by_gloss, by_lemma


def _begins(tag: str, beginning: str) -> bool:
    return tag == beginning or tag.startswith(f"{beginning}:")
