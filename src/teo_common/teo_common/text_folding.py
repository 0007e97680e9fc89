# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Spanish text without what people leave out when they type: accents, capitals, marks."""

from __future__ import annotations

import unicodedata

_TILDE = "\N{COMBINING TILDE}"


def without_accents(text: str) -> str:
    """The text without accents but with its ñ: `"¿Él, pingüino, año?"` is `"¿El, pinguino, año?"`."""
    if text.isascii():
        return text
    kept: list[str] = []
    for character in unicodedata.normalize("NFD", text):
        is_tilde_of_n = character == _TILDE and kept and kept[-1] in "nN"
        if unicodedata.category(character) != "Mn" or is_tilde_of_n:
            kept.append(character)
    return unicodedata.normalize("NFC", "".join(kept))


def fold(text: str) -> str:
    """Lower case without accents but with ñ: `"CÓMO"` is `"como"`, `"Año"` is `"año"`."""
    return without_accents(text.lower())


def strip_marks(text: str) -> str:
    """Lower case without any mark, that of ñ too, as a keyboard without ñ types it: `"Año"` is `"ano"`."""
    if text.isascii():
        return text.lower()
    decomposed = unicodedata.normalize("NFD", text.lower())
    return "".join(character for character in decomposed if unicodedata.category(character) != "Mn")


def folded(sentence: str) -> str:
    """What all ways of typing a sentence share: its letters and digits, in lower case, without marks."""
    return "".join(letter for letter in strip_marks(sentence) if letter.isalnum())
