# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pronouns that hang on a verb: `dímelo`, `ayudarme`, `vámonos`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from teo_sign_translator.morphology.accents import in_hiatus, stressed_vowel, unaccented, with_stress

#: Pronouns that come before another one.
_FIRST = ("me", "te", "se", "nos", "os")
_LAST = re.compile("me|te|se|nos|os|l[aeo]s?")


def attach_pronouns(form: str, pronouns: tuple[str, ...]) -> str:
    """Hang pronouns on a verb form as they are written: `"di", ("me", "lo")` is `"dímelo"`.

    The first person plural loses its s (`vámonos`), the imperative of vosotros its d (`sentaos`, but `idos`).
    """
    stressed = stressed_vowel(form)
    keeps_accent = in_hiatus(form, stressed)
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
    return with_stress(whole, stressed)


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
