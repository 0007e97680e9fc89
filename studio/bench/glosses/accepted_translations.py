# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Notation for the translations that are accepted for a sentence.

`YO (PASADO) PAN/BOLLO COMPRAR || PAN YO COMPRAR`: glosses in order; `/` between glosses of which any one may
stand; brackets round what may be left out; `||` between whole translations. What stands in brackets in
several places of a translation, as in `(YO) PAN (YO) COMPRAR`, is said in one of them at most.
"""

from __future__ import annotations

from collections.abc import Sequence

from teo_common.text_folding import without_accents
from teo_sign_translator.errors import TranslationError

#: Letters of words that accents tell apart: TÚ and TU, SÍ and SI.
_SHORT = 3


def accepts(pattern: str, glosses: Sequence[str]) -> bool:
    """Whether glosses are a translation that a pattern stands for, by their `plain_gloss`.

    Raises:
        TranslationError: "invalid_data" as `accepted`.
    """
    return tuple(map(plain_gloss, glosses)) in accepted(pattern)


def accepted(pattern: str) -> frozenset[tuple[str, ...]]:
    """All translations that a pattern stands for, each as its glosses' `plain_gloss`.

    Raises:
        TranslationError: "invalid_data" if the pattern is empty or a bracket is not closed in its own word.
    """
    return frozenset(glosses for each in pattern.split("||") for glosses in _readings(each.split(), pattern))


def _readings(words: Sequence[str], pattern: str) -> set[tuple[str, ...]]:
    """The translations of one side of `||`."""
    if not words:
        raise TranslationError("invalid_data", f"expected glosses on both sides of ||, got '{pattern}'")
    # What is said so far, and which choices in brackets have been taken.
    reached: set[tuple[tuple[str, ...], frozenset[frozenset[str]]]] = {((), frozenset())}
    for word in words:
        choices, optional = _place(word, pattern)
        said = {
            ((*before, gloss), taken | {choices} if optional else taken)
            for before, taken in reached
            for gloss in choices
            if not (optional and choices in taken)
        }
        reached = said | reached if optional else said
    return {glosses for glosses, _ in reached}


def plain_gloss(gloss: str) -> str:
    """A gloss as it is compared: a spelled word is what it spells, and POR_FAVOR may be written POR-FAVOR.

    LSE spells without accents, so longer words are compared without; Ñ stays.
    """
    word = gloss.replace("-", "").replace("_", "").upper()
    return word if len(word) <= _SHORT else without_accents(word)


def _place(word: str, pattern: str) -> tuple[frozenset[str], bool]:
    """What may stand in one place, and whether nothing may."""
    optional = word.startswith("(") and word.endswith(")")
    glosses = word.strip("()").split("/")
    brackets = word.count("(") + word.count(")")
    if brackets != 2 * optional or not all(glosses):
        raise TranslationError(
            "invalid_data", f"expected a gloss like (A/B) or A/B, got '{word}' in '{pattern}'"
        )
    return frozenset(map(plain_gloss, glosses)), optional
