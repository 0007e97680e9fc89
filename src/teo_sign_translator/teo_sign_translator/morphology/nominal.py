"""Plural and feminine of nouns and adjectives, by rule.

The rules are those of the Ortografía de la lengua española (RAE 2010); the words that do not follow
them are in the lexicon files.
"""

from __future__ import annotations

import re

_ACUTE = dict(zip("aeiou", "áéíóú", strict=True))
_PLAIN = {accented: plain for plain, accented in _ACUTE.items()}
#: A vowel or a diphthong: what a syllable is built around. Two strong vowels, and an accented weak one beside
#: a strong one, are two syllables.
_NUCLEUS = re.compile(r"(?<![qg])[iuü]?[aeoáéó][iuü]?(?![aeoáéó])|[iuü]?[aeoáéó]|[íú]|[iuü]+")
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
        return _stressed_as_before(word) + "es"
    return word + ("es" if word.endswith(_NATIVE_FINALS) else "s")


def feminine(word: str) -> str:
    """Feminine of a noun or adjective that has one: `"alemán"` is `"alemana"`, `"jefe"` is `"jefa"`."""
    if word[-1] in "oe":
        return word[:-1] + "a"
    return (_stressed_as_before(word) if word[-1] in "ns" else word) + "a"


def is_invariable(word: str) -> bool:
    """Whether one form serves both numbers: ending in -s or -x with the stress before it (`"lunes"`)."""
    if word[-1] not in "sx":
        return False
    return not any(accented in word[-3:] for accented in _PLAIN) and len(syllables(word)) > 1


def syllables(word: str) -> list[str]:
    """The vowels of each syllable: `["o", "i", "a"]` of `"oía"` is three, `["io"]` of `"dios"` one."""
    return _NUCLEUS.findall(word)


def unaccented(word: str) -> str:
    """The word without acute accents; `ñ` and `ü` stay."""
    return "".join(_PLAIN.get(character, character) for character in word)


def _stressed_as_before(word: str) -> str:
    """A stem with one syllable more, stressed as before: `"jamon-"` of `"jamón"`, `"jóven-"` of `"joven"`."""
    accents = [index for index, character in enumerate(word) if character in _PLAIN]
    if not accents:
        nuclei = list(_NUCLEUS.finditer(word))
        if len(nuclei) < 2:
            return word
        start, end = nuclei[-2].span()
        strong = next((index for index in range(start, end) if word[index] in "aeo"), end - 1)
        return word[:strong] + _ACUTE[word[strong]] + word[strong + 1 :]
    index = accents[-1]
    in_hiatus = word[index] in "íú" and index > 0 and word[index - 1] in "aeo"
    in_last_syllable = not syllables(word[index + 1 :])
    if in_last_syllable and not in_hiatus:
        return word[:index] + _PLAIN[word[index]] + word[index + 1 :]
    return word
