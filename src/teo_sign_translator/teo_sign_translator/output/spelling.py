# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words as letters of the LSE manual alphabet."""

from __future__ import annotations

from teo_common.text_folding import without_accents

#: The 30 signs of the LSE manual alphabet; CH, LL and RR are one sign each.
ALPHABET = frozenset("ABCDEFGHIJKLMNÑOPQRSTUVWXYZ") | {"CH", "LL", "RR"}

#: Signs of numbers, which may stand in a word ("UC3M").
DIGITS = frozenset("0123456789")

# Letters of other Latin alphabets that are no base letter with a mark, as Spanish texts transcribe them.
_TRANSCRIPTION = str.maketrans(
    {"ẞ": "SS", "Æ": "AE", "Œ": "OE", "Ø": "O", "Ł": "L", "Đ": "D", "Ð": "D", "Þ": "TH", "ª": "A", "º": "O"}
)


def plain_letters(word: str) -> str:
    """A word in capitals A to Z and Ñ, without accents; letters that have no such form stay as they are."""
    return without_accents(word.upper()).translate(_TRANSCRIPTION)


def letters(word: str) -> tuple[str, ...]:
    """The signs that spell a word, e.g. `"Guillermo"` gives G U I LL E R M O.

    Characters that no sign exists for are left out; `unsignable` names them beforehand.
    """
    plain = plain_letters(word)
    result: list[str] = []
    index = 0
    while index < len(plain):
        size = 2 if plain[index : index + 2] in ALPHABET else 1
        if plain[index : index + size] in ALPHABET:
            result.append(plain[index : index + size])
        index += size
    return tuple(result)


def unsignable(word: str) -> tuple[str, ...]:
    """Characters of a word that neither letters nor numbers can spell, in order, without repetition."""
    return tuple(dict.fromkeys(c for c in word if any(p not in ALPHABET | DIGITS for p in plain_letters(c))))
