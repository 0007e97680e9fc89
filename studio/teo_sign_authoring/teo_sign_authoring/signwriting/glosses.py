# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Terms of a community's dictionary as glosses.

People type "carcel 2", "¿quien? 13" or "Mar (azul)": variants are numbered, marks and accents left out. A
gloss is the Spanish word with its accents, in capitals; variants are told apart by a number that is added.
"""

from __future__ import annotations

import re
import unicodedata

from teo_common.text_folding import strip_marks
from teo_sign_translator.morphology import Morphology
from teo_signs.sign_schema import MAX_GLOSS_LENGTH

_VARIANT = re.compile(r"\s*\d+$")
_REMARK = re.compile(r"\([^)]*\)")
_WORD = re.compile(r"[^\W\d_]+")


class GlossNames:
    """Gives terms their glosses."""

    def __init__(self, *, any_term: bool = False) -> None:
        """Load the Spanish words.

        Args:
            any_term: Whether words that are not known as Spanish are taken as they are typed.
        """
        self._morphology = Morphology.load()
        self._any_term = any_term

    def gloss(self, term: str) -> str | None:
        """The gloss of a term without the number of its variant; None if it is not a Spanish one."""
        plain = _VARIANT.sub("", _REMARK.sub(" ", unicodedata.normalize("NFC", term))).strip()
        words = _WORD.findall(plain)
        if not words or re.search(r"\d", plain):
            return None
        written = [self._spanish(word.lower()) for word in words]
        if None in written and not self._any_term:
            return None
        gloss = "_".join((spelled or word).upper() for spelled, word in zip(written, words, strict=True))
        return gloss if len(gloss) <= MAX_GLOSS_LENGTH else None

    def _spanish(self, word: str) -> str | None:
        """A word with its accents; None if it is not known."""
        readings = self._morphology.readings(word)
        headwords = [each for each in readings if strip_marks(each.lemma) == strip_marks(word)]
        for reading in headwords:
            # A guess keeps the word as typed and says that it is none.
            if reading.exact or reading.lemma != word:
                return reading.lemma.lower()
        if any(reading.exact for reading in readings):
            return word
        for reading in readings:
            if reading.lemma == word or reading.tag in ("X", "NAME"):
                continue
            try:
                written = self._morphology.inflect(reading.lemma, reading.tag)
            except ValueError:
                continue
            if strip_marks(written) == strip_marks(word):
                return written
        return None


def numbered(glosses: list[str | None]) -> list[str | None]:
    """Glosses told apart: the first of a name keeps it, the others are NAME_2, NAME_3."""
    seen: dict[str, int] = {}
    told: list[str | None] = []
    for gloss in glosses:
        if gloss is None:
            told.append(None)
            continue
        seen[gloss] = seen.get(gloss, 0) + 1
        told.append(gloss if seen[gloss] == 1 else f"{gloss}_{seen[gloss]}")
    return told
