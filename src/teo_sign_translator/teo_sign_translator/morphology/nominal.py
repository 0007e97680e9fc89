# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Plural and feminine of nouns and adjectives, by rule.

The words that do not follow the rules are in the lexicon files.
"""

from __future__ import annotations

from teo_sign_translator.morphology.accents import (
    PLAIN,
    in_hiatus,
    stressed_vowel,
    syllables,
    unaccented,
    with_stress,
)

#: Final consonants that take -es; after others the plural of a borrowed word is in -s (clubs, chats, robots).
_NATIVE_FINALS = ("l", "r", "n", "d", "z", "j", "s", "x", "y", "ch")


def plural(word: str) -> str:
    """Plural of a noun or adjective: `"lápiz"` is `"lápices"`, `"joven"` `"jóvenes"`, `"crisis"` itself."""
    last = word[-1]
    if last in "aeiouáéó":
        return word + "s"
    if last in "íú":
        return word + "es"
    if last == "y" and word[-2:-1] not in set("aeiou"):
        return word + "s"
    if last == "z":
        return word[:-1] + "ces"
    if is_invariable(word):
        return word
    if last in "ns":
        return _stressed_as_before(word, "es")
    return word + ("es" if word.endswith(_NATIVE_FINALS) else "s")


def feminine(word: str) -> str:
    """Feminine of a noun or adjective that has one: `"alemán"` is `"alemana"`, `"jefe"` is `"jefa"`."""
    if word[-1] in "oe":
        return word[:-1] + "a"
    return _stressed_as_before(word, "a") if word[-1] in "ns" else word + "a"


def is_invariable(word: str) -> bool:
    """Whether one form serves both numbers: ending in -s or -x with the stress before it (`"lunes"`)."""
    if word[-1] not in "sx":
        return False
    return not any(accented in word[-3:] for accented in PLAIN) and len(syllables(word)) > 1


def _stressed_as_before(word: str, ending: str) -> str:
    """Append a syllable, the stress staying: `"jamones"` of `"jamón"`, `"jóvenes"` of `"joven"`."""
    stressed = stressed_vowel(word)
    if in_hiatus(word, stressed):
        return word + ending
    return with_stress(unaccented(word) + ending, stressed)
