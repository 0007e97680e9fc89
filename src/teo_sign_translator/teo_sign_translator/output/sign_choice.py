# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign, or which letters, a gloss is shown by."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence, Set
from dataclasses import replace
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_lines
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.output.output_words import OutputWord, spelled
from teo_sign_translator.output.translation import Kind, Origin

# What a look-up table can name: Spanish letters, `_` for spaces, as long as a message holds.
_SIGN_NAME = re.compile(r"[A-ZÁÉÍÓÚÜÑ_]{1,64}")


def read_synonyms(path: Path | None = None) -> dict[str, tuple[str, ...]]:
    """For each gloss the others that mean the same, in the order of the list.

    Args:
        path: The file; by default the package's `data/synonyms.tsv`, a line a group.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    path = path or data_file("synonyms.tsv")
    synonyms: dict[str, tuple[str, ...]] = {}
    for line_number, line in read_lines(path):
        group = [gloss.strip() for gloss in line.split(",")]
        if len(group) < 2 or any(not _SIGN_NAME.fullmatch(gloss) or gloss in synonyms for gloss in group):
            raise invalid_line(path, line_number, "two or more glosses, each listed once", f"'{line}'")
        for gloss in group:
            synonyms[gloss] = tuple(other for other in group if other != gloss)
    return synonyms


def read_signs(path: Path) -> frozenset[str]:
    """The glosses that have signs, from a file with one on each line.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    signs: set[str] = set()
    for line_number, line in read_lines(path):
        gloss = line.strip().upper()
        if not _SIGN_NAME.fullmatch(gloss):
            raise invalid_line(path, line_number, "one gloss", f"'{line.strip()}'")
        signs.add(gloss)
    return frozenset(signs)


def listed_signs(file: str) -> frozenset[str] | None:
    """The glosses of a file that a parameter names; None if it names none.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return read_signs(Path(file)) if file else None


class SignChooser:
    """Chooses signs: the gloss's own, its lemma's, a synonym's, else letters."""

    def __init__(self, synonyms: dict[str, tuple[str, ...]], morphology: Morphology | None) -> None:
        """Take the ways from a gloss without a sign to one that has one.

        Args:
            synonyms: For each gloss others that mean the same.
            morphology: Gives lemmas; None if glosses are lemmas.
        """
        self._synonyms = synonyms
        self._morphology = morphology

    def choose(self, output_words: Iterable[OutputWord], signs: Set[str] | None) -> list[OutputWord]:
        """Make output words of what has signs, in the same order.

        Args:
            output_words: Glosses, letters, numbers, pauses.
            signs: Glosses that have a sign of their own. None if that is not known: then every gloss that
                could have one is kept, for the executor to look up, and names are spelled.
        """
        return [chosen for output_word in output_words for chosen in self._choose(output_word, signs)]

    def _choose(self, output_word: OutputWord, signs: Set[str] | None) -> Sequence[OutputWord]:
        if output_word.kind is not Kind.LEXICAL or not output_word.signs:
            return [output_word]
        (gloss,) = output_word.signs
        if signs is None:
            keeps = not output_word.is_name and _SIGN_NAME.fullmatch(gloss)
            return [output_word] if keeps else _letters(output_word)
        if gloss in signs:
            return [output_word]
        if output_word.is_name:
            return _letters(output_word)
        for other in self._lemmas(gloss):
            if other in signs:
                return [replace(output_word, signs=(other,), origin=Origin.LEMMA)]
        for known in (gloss, *self._lemmas(gloss)):
            for other in self._synonyms.get(known, ()):
                if other in signs:
                    return [replace(output_word, signs=(other,), origin=Origin.SYNONYM)]
        parts = [part for part in gloss.split("_") if part]
        if len(parts) > 1:
            return [c for part in parts for c in self._choose(replace(output_word, signs=(part,)), signs)]
        return _letters(output_word)

    def _lemmas(self, gloss: str) -> tuple[str, ...]:
        """Other glosses of the same word: AMIGO for AMIGA."""
        if self._morphology is None or "_" in gloss:
            return ()
        readings = self._morphology.readings(gloss.lower())
        lemmas = (reading.lemma.upper() for reading in readings if reading.exact)
        return tuple(dict.fromkeys(lemma for lemma in lemmas if lemma != gloss))


def _letters(output_word: OutputWord) -> list[OutputWord]:
    (gloss,) = output_word.signs
    return [
        each for part in gloss.split("_") for each in spelled(part, output_word.words, output_word.confidence)
    ]
