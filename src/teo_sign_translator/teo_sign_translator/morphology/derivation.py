# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words made from a known word: `tranquilamente`, `perrito`, `buenísimo`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

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
