# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How Spanish words are written and made: stress, plurals, feminines, pronouns at verbs, derived words.

Syllables, stress and accents follow the Ortografía de la lengua española (RAE 2010). Words that do not follow
the rules are in the lexicon's files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

#: The vowels with their accents, and back.
ACUTE = dict(zip("aeiou", "áéíóú", strict=True))
PLAIN = {accented: plain for plain, accented in ACUTE.items()}

# i and u make a diphthong with their neighbour; the u of que and gui is no vowel.
_WEAK = r"(?:[iü]|u(?!(?<=[qg]u)[eiéí]))"
#: A vowel or a diphthong: what a syllable is built around. Two strong vowels, and an accented weak one beside
#: a strong one, are two syllables.
_NUCLEUS = re.compile(rf"{_WEAK}?[aeoáéó](?:{_WEAK}(?![aeoáéó]))?|[íú]|{_WEAK}{_WEAK}?")
_STRONG = re.compile("[aeo]")


def _syllables(word: str) -> list[str]:
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


def _with_stress(word: str, stressed: int) -> str:
    """The word with its accent if it needs one for the stress to be where it is said to be.

    Args:
        word: Without accents.
        stressed: Index of the vowel that bears the stress.
    """
    if stressed_vowel(word) == stressed:
        return word
    return word[:stressed] + ACUTE.get(word[stressed], word[stressed]) + word[stressed + 1 :]


def _in_hiatus(word: str, index: int) -> bool:
    """Whether the vowel is an accented i or u after a strong one: its accent always stays (`"país"`)."""
    return word[index] in "íú" and index > 0 and word[index - 1] in "aeo"


def accents_fit(form: str, typed: str) -> bool:
    """Whether a form can be typed like this by leaving marks out: `"cómo"` as `"como"`, `"año"` as `"ano"`.

    Both have the same letters but for their marks.
    """
    return len(form) == len(typed) and all(
        mine == theirs or theirs.isascii() for mine, theirs in zip(form, typed, strict=True)
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
    return not any(accented in word[-3:] for accented in PLAIN) and len(_syllables(word)) > 1


def _stressed_as_before(word: str, ending: str) -> str:
    """Append a syllable, the stress staying: `"jamones"` of `"jamón"`, `"jóvenes"` of `"joven"`."""
    stressed = stressed_vowel(word)
    if _in_hiatus(word, stressed):
        return word + ending
    return _with_stress(unaccented(word) + ending, stressed)


#: Pronouns that come before another one.
_FIRST = ("me", "te", "se", "nos", "os")
_LAST = re.compile("me|te|se|nos|os|l[aeo]s?")


def attach_pronouns(form: str, pronouns: tuple[str, ...]) -> str:
    """Hang pronouns on a verb form as they are written: `"di", ("me", "lo")` is `"dímelo"`.

    The first person plural loses its s (`vámonos`), the imperative of vosotros its d (`sentaos`, but `idos`).
    """
    stressed = stressed_vowel(form)
    keeps_accent = _in_hiatus(form, stressed)
    stem = form
    if pronouns[0] in ("nos", "se") and form.endswith("mos"):
        stem = form[:-1]
    elif pronouns[0] == "os" and form.endswith("d") and form != "id":
        stem = form[:-1]
        keeps_accent = keeps_accent or stem.endswith("i")  # vestíos: without it, io would be one syllable
    whole = unaccented(stem) + "".join(pronouns)
    if keeps_accent:
        accented = "í" if whole[stressed] == "i" else "ú"
        return whole[:stressed] + accented + whole[stressed + 1 :]
    return _with_stress(whole, stressed)


def detach_pronouns(folded: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Every way to take pronouns off a word.

    Args:
        folded: The word without accents.

    Yields:
        What the verb form may be, without accents, and its pronouns.
    """
    for start in range(max(2, len(folded) - 6), len(folded) - 1):
        verb = folded[:start]
        for pronouns in _pronouns(folded[start:]):
            yield verb, pronouns
            if pronouns[0] in ("nos", "se") and verb.endswith("mo"):
                yield verb + "s", pronouns
            if pronouns[0] == "os" and verb[-1] in "aei":
                yield verb + "d", pronouns


def _pronouns(tail: str) -> Iterator[tuple[str, ...]]:
    """The pronouns that letters are: `("se", "lo")` of `"selo"`."""
    if _LAST.fullmatch(tail):
        yield (tail,)
    for first in _FIRST:
        if tail.startswith(first) and _LAST.fullmatch(tail, len(first)):
            yield (first, tail[len(first) :])


#: In -ito, and the superlative of an adjective in -ísimo, without marks.
DIMINUTIVE = re.compile("(?P<stem>..+?)(?P<infix>ec|c)?it(?P<ending>os?|as?)")
SUPERLATIVE = re.compile("(?P<stem>..+)isim(?P<ending>os?|as?)")
#: How a stem is spelled before i, and how before another letter: poquito poco, amiguito amigo, lucecita luz.
_SPELLINGS = (("qu", "c"), ("gu", "g"), ("c", "z"), ("bil", "bl"))


class Derived(NamedTuple):
    """What a word may be made from: words without marks, any of which may not exist, and its own form."""

    bases: tuple[str, ...]
    gender: str
    number: str


def of_adverb(folded: str) -> str | None:
    """The feminine adjective of an adverb in -mente, without marks; None if it is none."""
    base = folded.removesuffix("mente")
    return base if base != folded and len(base) > 2 else None


def derived(pattern: re.Pattern[str], folded: str) -> Iterator[Derived]:
    """Words whose `DIMINUTIVE` or `SUPERLATIVE` this is.

    `"perro"` for `"perrito"`, `"pez"` for `"pececito"`; `"rico"` for `"riquísimo"`.
    """
    match = pattern.fullmatch(folded)
    if match is None:
        return
    ending = match["ending"]
    vowel = ending[0]
    stem = match["stem"]
    stems = [stem]
    if match.groupdict().get("infix") == "c":
        stems.append(stem + "c")  # cochecito is coche-cito, osito os-ito, lapicito lapic-ito
    stems += [
        each.removesuffix(soft) + hard for each in stems for soft, hard in _SPELLINGS if each.endswith(soft)
    ]
    bases = [stem + end for stem in stems for end in (vowel, "", "e", "o", "a")]
    yield Derived(tuple(dict.fromkeys(bases)), "m" if vowel == "o" else "f", "p" if ending[1:] else "s")
