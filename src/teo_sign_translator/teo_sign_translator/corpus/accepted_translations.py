"""Notation for the translations that are accepted for a sentence.

`YO (PASADO) PAN/BOLLO COMPRAR || PAN YO COMPRAR`: glosses in order; `/` between glosses of which any one may
stand; brackets round what may be left out; `||` between whole translations.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

from teo_sign_translator.errors import TranslationError

#: Letters of words that accents tell apart: TÚ and TU, SÍ and SI.
_SHORT = 3


def accepts(pattern: str, glosses: Sequence[str]) -> bool:
    """Whether glosses are a translation that a pattern stands for, by their `plain_gloss`.

    Raises:
        TranslationError: "invalid_data" if the pattern is empty or a bracket is not closed in its own word.
    """
    alternatives = [[_place(word, pattern) for word in each.split()] for each in pattern.split("||")]
    if not all(alternatives):
        raise TranslationError("invalid_data", f"expected glosses on both sides of ||, got '{pattern}'")
    said = [plain_gloss(gloss) for gloss in glosses]
    return any(_fits(places, said) for places in alternatives)


def plain_gloss(gloss: str) -> str:
    """A gloss as it is compared: a spelled word is what it spells, and POR_FAVOR may be written POR-FAVOR.

    LSE spells without accents, so longer words are compared without; Ñ stays.
    """
    word = gloss.replace("-", "").replace("_", "").upper()
    return word if len(word) <= _SHORT else _unaccented(word)


def _place(word: str, pattern: str) -> frozenset[str]:
    """What may stand in one place; the empty string among it if nothing may."""
    optional = word.startswith("(") and word.endswith(")")
    glosses = word.strip("()").split("/")
    brackets = word.count("(") + word.count(")")
    if brackets != 2 * optional or not all(glosses):
        raise TranslationError(
            "invalid_data", f"expected a gloss like (A/B) or A/B, got '{word}' in '{pattern}'"
        )
    return frozenset([*map(plain_gloss, glosses), *([""] if optional else [])])


def _fits(places: Sequence[frozenset[str]], glosses: Sequence[str]) -> bool:
    """Whether glosses fill places one after the other."""
    reached = {0}
    for choices in places:
        filled = {count + 1 for count in reached if count < len(glosses) and glosses[count] in choices}
        reached = filled | (reached if "" in choices else set())
    return len(glosses) in reached


def _unaccented(word: str) -> str:
    decomposed = unicodedata.normalize("NFD", word)
    kept = (c for c in decomposed if not unicodedata.combining(c) or c == "\N{COMBINING TILDE}")
    return unicodedata.normalize("NFC", "".join(kept))
