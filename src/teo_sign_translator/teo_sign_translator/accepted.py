"""Notation for the translations that are accepted for a sentence.

`YO (PASADO) PAN/BOLLO COMPRAR || PAN YO COMPRAR`: glosses in order; `/` between glosses of which any one may
stand; brackets round what may be left out; `||` between whole translations.
"""

from __future__ import annotations

from itertools import product
from math import prod

from teo_sign_translator.errors import TranslationError

# A line that stands for more translations than this is a slip of the pen; the longest of ours has 56.
_MOST = 1000


def accepted(pattern: str) -> frozenset[tuple[str, ...]]:
    """All translations that a pattern stands for, each as its glosses.

    Raises:
        TranslationError: "invalid_data" if the pattern is empty, a bracket is not closed in its own word, or
            it stands for too many translations.
    """
    translations: set[tuple[str, ...]] = set()
    for alternative in pattern.split("||"):
        choices = [_choices(word, pattern) for word in alternative.split()]
        if not choices:
            raise TranslationError("invalid_data", f"expected glosses on both sides of ||, got '{pattern}'")
        if prod(map(len, choices)) > _MOST:
            raise TranslationError("invalid_data", f"expected at most {_MOST} translations, got '{pattern}'")
        translations |= {tuple(filter(None, picked)) for picked in product(*choices)}
    return frozenset(translations)


def _choices(word: str, pattern: str) -> list[str]:
    """What may stand in one place; the empty string for nothing."""
    optional = word.startswith("(") and word.endswith(")")
    glosses = word.strip("()").split("/")
    brackets = word.count("(") + word.count(")")
    if brackets != 2 * optional or not all(glosses):
        raise TranslationError(
            "invalid_data", f"expected a gloss like (A/B) or A/B, got '{word}' in '{pattern}'"
        )
    return [*glosses, ""] if optional else glosses
