# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Syllables, stress and accents of Spanish words, by the Ortografía de la lengua española (RAE 2010)."""

from __future__ import annotations

import re

#: The vowels with their accents, and back.
ACUTE = dict(zip("aeiou", "áéíóú", strict=True))
PLAIN = {accented: plain for plain, accented in ACUTE.items()}

# i and u make a diphthong with their neighbour; the u of que and gui is no vowel.
_WEAK = r"(?:[iü]|u(?!(?<=[qg]u)[eiéí]))"
#: A vowel or a diphthong: what a syllable is built around. Two strong vowels, and an accented weak one beside
#: a strong one, are two syllables.
_NUCLEUS = re.compile(rf"{_WEAK}?[aeoáéó](?:{_WEAK}(?![aeoáéó]))?|[íú]|{_WEAK}{_WEAK}?")
_STRONG = re.compile("[aeo]")


def syllables(word: str) -> list[str]:
    """The vowels of each syllable: `["o", "í", "a"]` of `"oía"` is three, `["io"]` of `"dios"` one."""
    return _NUCLEUS.findall(word)


def unaccented(word: str) -> str:
    """The word without acute accents; `ñ` and `ü` stay."""
    return "".join(PLAIN.get(character, character) for character in word)


def stressed_vowel(word: str) -> int:
    """Index of the vowel that bears the stress; 0 if there is no vowel."""
    written = next((index for index, character in enumerate(word) if character in PLAIN), None)
    if written is not None:
        return written
    nuclei = list(_NUCLEUS.finditer(word))
    if not nuclei:
        return 0
    before_last = word[-1] in "aeiouns" and len(nuclei) > 1
    nucleus = nuclei[-2 if before_last else -1]
    strong = _STRONG.search(nucleus.group())
    return nucleus.start() + strong.start() if strong else nucleus.end() - 1


def with_stress(word: str, stressed: int) -> str:
    """The word with its accent if it needs one for the stress to be where it is said to be.

    Args:
        word: Without accents.
        stressed: Index of the vowel that bears the stress.
    """
    if stressed_vowel(word) == stressed:
        return word
    return word[:stressed] + ACUTE.get(word[stressed], word[stressed]) + word[stressed + 1 :]


def in_hiatus(word: str, index: int) -> bool:
    """Whether the vowel is an accented i or u after a strong one: its accent always stays (`"país"`)."""
    return word[index] in "íú" and index > 0 and word[index - 1] in "aeo"


def accents_fit(form: str, typed: str) -> bool:
    """Whether a form can be typed like this by leaving marks out: `"cómo"` as `"como"`, `"año"` as `"ano"`.

    Both have the same letters but for their marks.
    """
    return len(form) == len(typed) and all(
        mine == theirs or theirs.isascii() for mine, theirs in zip(form, typed, strict=True)
    )
