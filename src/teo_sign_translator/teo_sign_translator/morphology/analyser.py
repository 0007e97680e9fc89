# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Readings of words and forms of lemmas."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import NamedTuple

from teo_common.text_folding import strip_marks
from teo_sign_translator.data_files import data_file
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.accents import accents_fit, unaccented
from teo_sign_translator.morphology.conjugation import Conjugations
from teo_sign_translator.morphology.derivation import DIMINUTIVE, SUPERLATIVE, Derived, derived, of_adverb
from teo_sign_translator.morphology.enclitics import attach_pronouns, detach_pronouns
from teo_sign_translator.morphology.guessing import guess
from teo_sign_translator.morphology.lexicon import Form
from teo_sign_translator.morphology.reading import Reading
from teo_sign_translator.morphology.tags import tag_class

#: Most readings of one word; few words have more, and none of them is likely.
MAX_READINGS = 4
#: Words whose readings are kept ready [words]: more than are in use in any conversation; about 10 MB.
_CACHED_WORDS = 20_000

#: Longer words are names of chemicals, or no words [letters]: to look into them takes time and finds nothing.
_LONGEST_WORD = 40

_NUMBER = re.compile(r"\d+(?:[.,:]\d+)*")
_SPOKEN_PARTICIPLE = re.compile(r"(?P<stem>\w{2,})ao(?P<plural>s?)")
#: What a reading comes from, the likeliest first.
_CLOSED, _ADVERB, _NOUN, _ADJECTIVE, _LATE_ADVERB, _VERB, _NAME, _WITH_PRONOUNS = range(8)
#: How much a reading asks of the reader, from none: accents left out, an ending taken off, a rare verb.
_EXACT, _ACCENTS_MISSING, _ACCENTS_WRONG, _DERIVED, _RARE = range(5)


class _Candidate(NamedTuple):
    """A reading, and the numbers that order it among the others; small is likely."""

    effort: int
    source: int
    reading: Reading


class _Entry(NamedTuple):
    """A form of the lexicon, and what it comes from."""

    form: Form
    source: int


class Morphology:
    """The readings of Spanish words and the forms of Spanish lemmas."""

    def __init__(self, conjugations: Conjugations) -> None:
        """Expand the lexicon's lists; `load` is the usual way."""
        self._conjugations = conjugations
        self._everyday = {verb.lemma for verb in lexicon.verbs()}
        self._preferences = lexicon.preferences()
        self._by_folded: dict[str, list[_Entry]] = defaultdict(list)
        self._by_tag: dict[tuple[str, str], str] = {}
        for entry in _lexicon_entries():
            self._by_folded[strip_marks(entry.form.written)].append(entry)
            self._by_tag.setdefault((entry.form.lemma, entry.form.tag), entry.form.written)
        self._cached = lru_cache(_CACHED_WORDS)(self._readings)

    @classmethod
    def load(cls) -> Morphology:
        """Read the package's tables: 0.2 s and 20 MB.

        Raises:
            TranslationError: "invalid_data" if a file is damaged.
        """
        return cls(Conjugations(data_file("morphology/conjugations.tsv")))

    def readings(self, word: str) -> tuple[Reading, ...]:
        """What a word may be.

        Accents may be missing: readings that fit the word as typed come first, then those that need others.

        Args:
            word: One word as typed, in any Unicode; a capital at its beginning hints at a name.

        Returns:
            At least one reading and at most four, most likely first; no two with the same lemma, tag class
            and exactness.
        """
        return self._cached(unicodedata.normalize("NFC", word))

    def inflect(self, lemma: str, tag: str) -> str:
        """The form of a lemma that a tag names.

        Where one form serves both genders or both numbers, either may be asked for: ("grande", "A:fs") is
        "grande", ("crisis", "N:fp") is "crisis".

        Raises:
            TranslationError: "no_form" if the lemma is unknown or has no such form.
        """
        for asked in _forms_that_serve(tag):
            if (lemma, asked) in self._by_tag:
                return self._by_tag[lemma, asked]
        if tag == "NUM" and _NUMBER.fullmatch(lemma):
            return lemma
        forms = self._conjugations.forms(lemma, tag)
        if not forms:
            raise TranslationError(
                "no_form",
                f"expected a known lemma and a tag that it has a form for, got {lemma!r} and {tag!r}: "
                "add the lemma to data/lexicon",
            )
        return forms[0]

    def _readings(self, word: str) -> tuple[Reading, ...]:
        form = word.lower()
        if _NUMBER.fullmatch(form):
            return (Reading(form, "NUM"),)
        if not any(character.isalnum() for character in form):
            return (Reading(form, "MARK"),)
        if len(form) > _LONGEST_WORD:
            return (Reading(form, "X", exact=False),)
        capital = word[0].isupper()
        folded = strip_marks(form)
        candidates = self._candidates(form, folded, capital) or self._spoken_participles(folded)
        if not candidates:
            unknown = guess(form, self._conjugations)
            return (Reading(word, "NAME", exact=False), unknown) if capital else (unknown,)
        order = self._preferences.get(form, ())
        ranked = sorted(
            candidates,
            key=lambda each: (
                each.effort,
                _preference(each.reading, order),
                each.source,
                strip_marks(each.reading.lemma) != folded,  # música is music first, then a woman who plays it
            ),
        )
        readings = _distinct(each.reading for each in ranked)
        if capital and ranked[0].effort == _RARE:
            return (Reading(word, "NAME", exact=False), *readings)[:MAX_READINGS]
        return readings

    def _candidates(self, form: str, folded: str, capital: bool) -> list[_Candidate]:
        """All readings of a word; rare verbs, and words with other accents, only where there is nothing else.

        The short words of the closed classes are always there: people mistake tú for tu and más for mas.
        """
        common = [*self._listed(form, folded, capital), *self._verbs(form, folded)]
        if not any(each.effort == _EXACT and each.reading.exact for each in common):
            common += self._derived(form, folded)
        common += self._adverbs(form, folded)
        likely = [each for each in common if each.effort != _RARE] or common
        fitting = [each for each in likely if each.effort != _ACCENTS_WRONG or each.source == _CLOSED]
        return fitting or likely

    def _listed(self, form: str, folded: str, capital: bool) -> Iterator[_Candidate]:
        for (written, lemma, tag), source in self._by_folded.get(folded, ()):
            effort = _effort(written.lower(), form)
            if capital and tag.startswith("NAME:"):
                source = -1
            yield _Candidate(effort, source, Reading(lemma, tag, exact=effort == _EXACT))

    def _verbs(self, form: str, folded: str) -> Iterator[_Candidate]:
        for verb, tag, written in self._conjugations.readings(folded):
            if verb in self._everyday or accents_fit(written, form):  # tráfico is not the rare traficar
                yield self._verb(verb, tag, written, form, ())
        for bare, pronouns in detach_pronouns(folded):
            for verb, tag, written in self._conjugations.readings(bare):
                if tag in ("V:inf", "V:ger") or tag.startswith("V:imp"):
                    yield self._verb(verb, tag, attach_pronouns(written, pronouns), form, pronouns)

    def _verb(self, verb: str, tag: str, written: str, form: str, pronouns: tuple[str, ...]) -> _Candidate:
        effort = _effort(written, form)
        reading = Reading(verb, tag, pronouns, exact=effort == _EXACT)
        if verb not in self._everyday:
            effort = _RARE
        return _Candidate(effort, _WITH_PRONOUNS if pronouns else _VERB, reading)

    def _spoken_participles(self, folded: str) -> list[_Candidate]:
        """Participles in -ado as people say and type them: mandao."""
        spoken = _SPOKEN_PARTICIPLE.fullmatch(folded)
        written = f"{spoken['stem']}ado{spoken['plural']}" if spoken else ""
        return [each for each in self._verbs(written, written) if each.reading.tag.startswith("V:part")]

    def _adverbs(self, form: str, folded: str) -> Iterator[_Candidate]:
        """An adverb in -mente, and the adjective that it is made from."""
        base = of_adverb(folded)
        for (written, lemma, tag), _ in self._by_folded.get(base, ()) if base else ():
            if tag in ("A:fs", "A:cs"):
                adverb = written + "mente"
                effort = _effort(adverb, form)
                yield _Candidate(effort, _LATE_ADVERB, Reading(adverb, "ADV:manner", exact=effort == _EXACT))
                yield _Candidate(_DERIVED, _ADJECTIVE, Reading(lemma, tag, exact=effort == _EXACT))

    def _derived(self, form: str, folded: str) -> Iterator[_Candidate]:
        if unaccented(form) == form:  # mérito is no mere little
            for little in derived(DIMINUTIVE, folded):
                yield from self._from_base(little, ("N", "A", "ADV", "DET"))
        for utmost in derived(SUPERLATIVE, folded):
            yield from self._from_base(utmost, ("A", "DET"))

    def _from_base(self, derived: Derived, classes: tuple[str, ...]) -> Iterator[_Candidate]:
        for base in derived.bases:
            for (_, lemma, tag), source in self._by_folded.get(base, ()):
                stem, last = tag[:-2], tag[-2:]
                if tag_class(tag) not in classes or (tag_class(tag) == "DET" and ":quant" not in tag):
                    continue
                if tag_class(tag) == "ADV":
                    yield _Candidate(_DERIVED, source, Reading(lemma, tag))
                elif last[1] == "s" and last[0] in (derived.gender, "c"):
                    yield _Candidate(_DERIVED, source, Reading(lemma, f"{stem}{last[0]}{derived.number}"))


def _lexicon_entries() -> Iterator[_Entry]:
    for adverb in lexicon.adverbs():
        tag = lexicon.ADVERB_TAGS[adverb.kind]
        late = adverb.kind in ("manner", "degree", "sentence")
        yield _Entry(Form(adverb.lemma, adverb.lemma, tag), _LATE_ADVERB if late else _ADVERB)
    described = {adjective.lemma for adjective in lexicon.adjectives()}
    for noun in lexicon.nouns():
        # A word for people is more often said of them: "está enfermo" before "un enfermo".
        after_adjective = noun.classes[0] == "person" and noun.lemma in described
        source = _LATE_ADVERB if after_adjective else _NOUN
        yield from (_Entry(form, source) for form in lexicon.nominal_forms(noun))
    for adjective in lexicon.adjectives():
        yield from (_Entry(form, _ADJECTIVE) for form in lexicon.nominal_forms(adjective))
    for name in lexicon.names():
        yield _Entry(Form(name.name, name.name, lexicon.NAME_TAGS[name.kind]), _NAME)
    # Last: of the forms of a lemma and tag the first is the one that is written, and here is gran for grande.
    for form in lexicon.closed_class_forms():
        yield _Entry(form, _CLOSED)


def _distinct(readings: Iterable[Reading]) -> tuple[Reading, ...]:
    """The first readings that differ in lemma, tag class or exactness; none again with less accents."""
    kept: dict[tuple[str, str, bool], Reading] = {}
    tags = set()
    for reading in readings:
        if (reading.lemma, reading.tag) not in tags:
            tags.add((reading.lemma, reading.tag))
            kept.setdefault((reading.lemma, tag_class(reading.tag), reading.exact), reading)
    return tuple(kept.values())[:MAX_READINGS]


def _effort(written: str, typed: str) -> int:
    if written == typed:
        return _EXACT
    return _ACCENTS_MISSING if accents_fit(written, typed) else _ACCENTS_WRONG


def _preference(reading: Reading, order: tuple[str, ...]) -> int:
    places = [order.index(name) for name in (reading.lemma, tag_class(reading.tag)) if name in order]
    return min(places, default=len(order))


def _forms_that_serve(tag: str) -> Iterator[str]:
    """The tag itself, then the tags of forms that serve its gender or number among others."""
    yield tag
    if tag_class(tag) in ("N", "A", "DET", "WH") and tag[-1] in "sp" and tag[-2] in "mfc":
        beginning, gender, number = tag[:-2], tag[-2], tag[-1]
        yield f"{beginning}c{number}"
        yield f"{beginning}{gender}n"
        yield f"{beginning}cn"
