# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words of a language with a table of conjugations: verbs with pronouns, derived words, guesses."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from teo_common.text_folding import strip_marks
from teo_sign_translator.data_files import read_rows
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.lexicon import (
    ACCENTS_WRONG,
    ADJECTIVE,
    CLOSED,
    DERIVED,
    EXACT,
    LATE_ADVERB,
    NOUN,
    RARE,
    VERB,
    WITH_PRONOUNS,
    Candidate,
    Entry,
    Index,
    effort,
    listed_entries,
)
from teo_sign_translator.morphology.readings import VERB_TAGS, Reading, tag_class
from teo_sign_translator.morphology.spanish import (
    DIMINUTIVE,
    SUPERLATIVE,
    Derived,
    accents_fit,
    attach_pronouns,
    derived,
    detach_pronouns,
    of_adverb,
    unaccented,
)

#: Where one form is several of its verb (come: he, or an order; comía: I, he), the first here is taken for
#: it, and of persons the third.
_LIKELIEST_FIRST = (
    "V:ind:pres",
    "V:ind:pret",
    "V:ind:impf",
    "V:ind:fut",
    "V:cond",
    "V:sub:pres",
    "V:sub:impf",
    "V:imp",
)


def _likelihood(tag: str) -> tuple[int, bool]:
    tense, _, person = tag.rpartition(":")
    rank = _LIKELIEST_FIRST.index(tense) if tense in _LIKELIEST_FIRST else len(_LIKELIEST_FIRST)
    return rank, person != "3s"


class _VerbForm(NamedTuple):
    """One form of a verb: what it is, and how it is written."""

    infinitive: str
    tag: str
    written: str


@dataclass(frozen=True, slots=True)
class _Paradigm:
    """Endings that verbs share, by tag, and by the ending without marks."""

    infinitive: str
    by_tag: dict[str, tuple[str, ...]]
    by_folded: dict[str, list[tuple[str, str]]]


class Conjugations:
    """The verbs of text/morphology/conjugations.tsv."""

    def __init__(self, path: Path) -> None:
        """Read the file.

        Raises:
            TranslationError: "invalid_data" if it is not such a file.
        """
        self._verbs: dict[str, tuple[str, _Paradigm]] = {}
        self._stems: dict[str, list[tuple[str, _Paradigm]]] = defaultdict(list)
        for number, (_, endings, stems) in read_rows(path, 3):
            paradigm = _read_paradigm(endings.split(" "), f"{path}, line {number}")
            for word in stems.split(" "):
                stem = word.replace(".", "")
                self._verbs[stem + paradigm.infinitive] = (stem, paradigm)
                self._stems[strip_marks(stem)].append((stem, paradigm))

    def forms(self, infinitive: str, tag: str) -> tuple[str, ...]:
        """The ways to write a form, the usual one first; none if the verb is unknown or has no such form."""
        stem, paradigm = self._verbs.get(infinitive, ("", None))
        return tuple(stem + ending for ending in paradigm.by_tag.get(tag, ())) if paradigm else ()

    def endings(self, infinitive: str, folded: str) -> list[tuple[str, str]]:
        """Endings of a known verb that are typed like this without marks, each with its tag."""
        return self._verbs[infinitive][1].by_folded.get(folded, [])

    def readings(self, folded: str) -> Iterator[_VerbForm]:
        """Every verb form that is typed like this without marks; of equals, the likelier tag first."""
        for cut in range(len(folded) + 1):
            for stem, paradigm in self._stems.get(folded[:cut], ()):
                for ending, tag in paradigm.by_folded.get(folded[cut:], ()):
                    yield _VerbForm(stem + paradigm.infinitive, tag, stem + ending)


def _read_paradigm(columns: list[str], place: str) -> _Paradigm:
    if len(columns) != len(VERB_TAGS):
        raise TranslationError(
            "invalid_data", f"{place}: expected {len(VERB_TAGS)} endings, got {len(columns)}: build it again"
        )
    by_tag = {
        tag: tuple(ending.replace("_", "") for ending in column.split(","))
        for tag, column in zip(VERB_TAGS, columns, strict=True)
    }
    by_folded: dict[str, list[tuple[str, str]]] = defaultdict(list)
    for tag in sorted(by_tag, key=_likelihood):
        for ending in by_tag[tag]:
            by_folded[strip_marks(ending)].append((ending, tag))
    return _Paradigm(by_tag["V:inf"][0], by_tag, dict(by_folded))


#: The verb whose endings new verbs take (guglear), and its forms that hardly any noun looks like: -ado,
#: -ara, -ase, -aste and -o are endings of nouns too.
_MODEL = "amar"
_TELLING_FORMS = ("V:ger", "V:ind:impf", "V:ind:fut", "V:cond", "V:ind:pret:2p", "V:ind:pret:3p")

#: Infinitives of new verbs end so; nouns end in -ar (hogar), hardly ever so.
_NEW_INFINITIVES = ("ear", "izar", "ificar")

#: Endings of plurals and of their singulars; the first that fits counts.
_PLURALS = tuple(
    (re.compile(several + "$"), one)
    for several, one in (
        ("([cs])iones", r"\1ión"),
        ("ones", "ón"),
        ("anes", "án"),
        ("ines", "ín"),
        ("eses", "és"),
        ("ces", "z"),
        ("(?<=[aeiouáéíóú])([lrd])es", r"\1"),
        ("([aáeéoó])s", r"\1"),
    )
)
#: Endings that only nouns have, with their gender.
_NOUNS = (
    (("ción", "sión", "dad", "tad", "tud"), "f"),
    (("miento", "ismo", "aje"), "m"),
    (("ista",), "c"),
)
#: Shortest word that is taken for a plural [letters]: "gas" and "dos" are none.
_SHORTEST_PLURAL = 5


def guess(form: str, conjugations: Conjugations) -> Reading:
    """The likeliest reading of an unknown word in lower case."""
    for cut in range(2, len(form)):
        for ending, tag in conjugations.endings(_MODEL, strip_marks(form[cut:])):
            if ending == form[cut:] and tag.startswith(_TELLING_FORMS):
                return Reading(form[:cut] + "ar", tag, exact=False)
    if form.endswith(_NEW_INFINITIVES):
        return Reading(form, "V:inf", exact=False)
    lemma = singular(form)
    gender = next((gender for endings, gender in _NOUNS if lemma.endswith(endings)), None)
    if gender is None:
        return Reading(lemma, "X", exact=False)
    return Reading(lemma, f"N:{gender}{'s' if lemma == form else 'p'}", exact=False)


def singular(form: str) -> str:
    """The singular of an unknown word, as far as its ending tells: `"chándales"` is `"chándal"`."""
    if len(form) < _SHORTEST_PLURAL:
        return form
    return next((several.sub(one, form) for several, one in _PLURALS if several.search(form)), form)


_SPOKEN_PARTICIPLE = re.compile(r"(?P<stem>\w{2,})ao(?P<plural>s?)")


class ConjugatedForms:
    """`WordForms` of a language whose text folder has `morphology/conjugations.tsv`."""

    def __init__(self, folder: Path) -> None:
        """Read the lists and the table of a language's text folder.

        Raises:
            TranslationError: "invalid_data" if a file is damaged.
        """
        self._folder = folder
        self._conjugations = Conjugations(folder / "morphology/conjugations.tsv")
        self._everyday = frozenset(lexicon.verbs(folder))

    def entries(self) -> Iterator[Entry]:
        """See `WordForms`."""
        return listed_entries(self._folder, self._nominal())

    def unlisted(self, form: str, folded: str, listed: list[Candidate], index: Index) -> list[Candidate]:
        """See `WordForms`; rare verbs, and words with other accents, only where there is nothing else.

        The short words of the closed classes are always there: people mistake tú for tu and más for mas.
        """
        common = [*listed, *self._verbs(form, folded)]
        if not any(each.effort == EXACT and each.reading.exact for each in common):
            common += _derived(form, folded, index)
        common += _adverbs(form, folded, index)
        likely = [each for each in common if each.effort != RARE] or common
        fitting = [each for each in likely if each.effort != ACCENTS_WRONG or each.source == CLOSED]
        return fitting or likely or self._spoken_participles(folded)

    def guess(self, form: str) -> Reading:
        """See `WordForms`."""
        return guess(form, self._conjugations)

    def forms(self, lemma: str, tag: str) -> tuple[str, ...]:
        """See `WordForms`."""
        return self._conjugations.forms(lemma, tag)

    def _nominal(self) -> Iterator[Entry]:
        described = {adjective.lemma for adjective in lexicon.adjectives(self._folder)}
        for noun in lexicon.nouns(self._folder):
            # A word for people is more often said of them: "está enfermo" before "un enfermo".
            after_adjective = noun.classes[0] == "person" and noun.lemma in described
            source = LATE_ADVERB if after_adjective else NOUN
            yield from (Entry(form, source) for form in lexicon.nominal_forms(noun))
        for adjective in lexicon.adjectives(self._folder):
            yield from (Entry(form, ADJECTIVE) for form in lexicon.nominal_forms(adjective))

    def _verbs(self, form: str, folded: str) -> Iterator[Candidate]:
        for verb, tag, written in self._conjugations.readings(folded):
            if verb in self._everyday or accents_fit(written, form):  # tráfico is not the rare traficar
                yield self._verb(verb, tag, written, form, ())
        for bare, pronouns in detach_pronouns(folded):
            for verb, tag, written in self._conjugations.readings(bare):
                if tag in ("V:inf", "V:ger") or tag.startswith("V:imp"):
                    yield self._verb(verb, tag, attach_pronouns(written, pronouns), form, pronouns)

    def _verb(self, verb: str, tag: str, written: str, form: str, pronouns: tuple[str, ...]) -> Candidate:
        cost = effort(written, form)
        reading = Reading(verb, tag, pronouns, exact=cost == EXACT)
        if verb not in self._everyday:
            cost = RARE
        return Candidate(cost, WITH_PRONOUNS if pronouns else VERB, reading)

    def _spoken_participles(self, folded: str) -> list[Candidate]:
        """Participles in -ado as people say and type them: mandao."""
        spoken = _SPOKEN_PARTICIPLE.fullmatch(folded)
        written = f"{spoken['stem']}ado{spoken['plural']}" if spoken else ""
        return [each for each in self._verbs(written, written) if each.reading.tag.startswith("V:part")]


def _adverbs(form: str, folded: str, index: Index) -> Iterator[Candidate]:
    """An adverb in -mente, and the adjective that it is made from."""
    base = of_adverb(folded)
    for (written, lemma, tag), _ in index.get(base, ()) if base else ():
        if tag in ("A:fs", "A:cs"):
            adverb = written + "mente"
            cost = effort(adverb, form)
            yield Candidate(cost, LATE_ADVERB, Reading(adverb, "ADV:manner", exact=cost == EXACT))
            yield Candidate(DERIVED, ADJECTIVE, Reading(lemma, tag, exact=cost == EXACT))


def _derived(form: str, folded: str, index: Index) -> Iterator[Candidate]:
    if unaccented(form) == form:  # mérito is no mere little
        for little in derived(DIMINUTIVE, folded):
            yield from _from_base(little, ("N", "A", "ADV", "DET"), index)
    for utmost in derived(SUPERLATIVE, folded):
        yield from _from_base(utmost, ("A", "DET"), index)


def _from_base(derived: Derived, classes: tuple[str, ...], index: Index) -> Iterator[Candidate]:
    for base in derived.bases:
        for (_, lemma, tag), source in index.get(base, ()):
            stem, last = tag[:-2], tag[-2:]
            if tag_class(tag) not in classes or (tag_class(tag) == "DET" and ":quant" not in tag):
                continue
            if tag_class(tag) == "ADV":
                yield Candidate(DERIVED, source, Reading(lemma, tag))
            elif last[1] == "s" and last[0] in (derived.gender, "c"):
                yield Candidate(DERIVED, source, Reading(lemma, f"{stem}{last[0]}{derived.number}"))
