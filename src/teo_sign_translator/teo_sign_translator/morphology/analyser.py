# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Readings of words and forms of lemmas."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Iterator
from functools import lru_cache
from pathlib import Path

from teo_common.text_folding import strip_marks
from teo_sign_translator.data_files import data_file
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.morphology import lexicon
from teo_sign_translator.morphology.conjugation import ConjugatedForms
from teo_sign_translator.morphology.lexicon import (
    ACCENTS_MISSING,
    EXACT,
    NAME,
    RARE,
    Candidate,
    Entry,
    WordForms,
    effort,
)
from teo_sign_translator.morphology.readings import Reading, tag_class
from teo_sign_translator.morphology.suffixing import SUFFIXES, SuffixedForms

#: Most readings of one word; few words have more, and none of them is likely.
MAX_READINGS = 4
#: Words whose readings are kept ready [words]: more than are in use in any conversation; about 10 MB.
_CACHED_WORDS = 20_000

#: Longer words are names of chemicals, or no words [letters]: to look into them takes time and finds nothing.
_LONGEST_WORD = 40

_NUMBER = re.compile(r"\d+(?:[.,:]\d+)*")


class Morphology:
    """The readings of a language's words and the forms of its lemmas.

    Attributes:
        folder: The language's text folder.
        phrases: Forms of several words, without marks ("woke up"); `_` joins these in the lists.
    """

    def __init__(self, words: WordForms, folder: Path) -> None:
        """Expand the lexicon's lists; `load` is the usual way."""
        self.folder = folder
        self._words = words
        self._preferences = lexicon.preferences(folder)
        self._by_folded: dict[str, list[Entry]] = defaultdict(list)
        self._by_tag: dict[tuple[str, str], str] = {}
        for entry in words.entries():
            self._by_folded[strip_marks(entry.form.written)].append(entry)
            self._by_tag.setdefault((entry.form.lemma, entry.form.tag), entry.form.written)
        self._cached = lru_cache(_CACHED_WORDS)(self._readings)
        self.phrases = frozenset(written for written in self._by_folded if " " in written)

    @classmethod
    def load(cls, folder: Path | None = None) -> Morphology:
        """Read a language's tables: 0.2 s and 20 MB for one with a table of conjugations.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data" if a file is damaged.
        """
        folder = folder or data_file("")
        suffixed = (folder / SUFFIXES).is_file()
        return cls(SuffixedForms(folder) if suffixed else ConjugatedForms(folder), folder)

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

    def knows(self, form: str) -> bool:
        """Whether a word in lower case is one of everyday use, written so or with accents left out."""
        if len(form) > _LONGEST_WORD:
            return False
        found = self._candidates(form, strip_marks(form), capital=False)
        return any(each.effort in (EXACT, ACCENTS_MISSING) and each.source != NAME for each in found)

    def is_form(self, written: str, lemma: str, tag: str) -> bool:
        """Whether a lemma has the form that a tag names, and it is this one."""
        return any(self._by_tag.get((lemma, asked)) == written for asked in _forms_that_serve(tag))

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
        forms = self._words.forms(lemma, tag)
        if not forms:
            raise TranslationError(
                "no_form",
                f"expected a known lemma and a tag that it has a form for, got {lemma!r} and {tag!r}: "
                "add the lemma to text/lexicon",
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
        candidates = self._candidates(form, folded, capital=capital)
        if not candidates:
            unknown = self._words.guess(form)
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
        if capital and ranked[0].effort == RARE:
            return (Reading(word, "NAME", exact=False), *readings)[:MAX_READINGS]
        return readings

    def _candidates(self, form: str, folded: str, *, capital: bool) -> list[Candidate]:
        listed: list[Candidate] = []
        for (written, lemma, tag), source in self._by_folded.get(folded, ()):
            cost = effort(written.lower(), form)
            place = -1 if capital and tag.startswith("NAME:") else source
            listed.append(Candidate(cost, place, Reading(lemma, tag, exact=cost == EXACT)))
        return self._words.unlisted(form, folded, listed, self._by_folded)


def _distinct(readings: Iterable[Reading]) -> tuple[Reading, ...]:
    """The first readings that differ in lemma, tag class or exactness; none again with less accents."""
    kept: dict[tuple[str, str, bool], Reading] = {}
    tags = set()
    for reading in readings:
        if (reading.lemma, reading.tag) not in tags:
            tags.add((reading.lemma, reading.tag))
            kept.setdefault((reading.lemma, tag_class(reading.tag), reading.exact), reading)
    return tuple(kept.values())[:MAX_READINGS]


def _preference(reading: Reading, order: tuple[str, ...]) -> int:
    places = [order.index(name) for name in (reading.lemma, tag_class(reading.tag)) if name in order]
    return min(places, default=len(order))


def _forms_that_serve(tag: str) -> Iterator[str]:
    """The tag itself, then the tags of forms that serve its gender, number or person among others."""
    yield tag
    if tag_class(tag) in ("N", "A", "DET", "WH") and tag[-1] in "sp" and tag[-2] in "mfc":
        beginning, gender, number = tag[:-2], tag[-2], tag[-1]
        yield f"{beginning}c{number}"
        yield f"{beginning}{gender}n"
        yield f"{beginning}cn"
    if tag_class(tag) == "V":  # a form of all persons: "go" of ("go", "V:ind:pres:1s")
        yield tag.rpartition(":")[0]
