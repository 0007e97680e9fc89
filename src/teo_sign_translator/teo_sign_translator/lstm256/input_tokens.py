"""Sentences as the model's input tokens."""

from __future__ import annotations

import re

from teo_common.text_folding import fold
from teo_sign_translator.corpus.paper_pairs import SLOTS
from teo_sign_translator.text.cleaning import clean

#: Marks that are tokens of their own.
MARKS = ("?", "!")

_TOKEN = re.compile("|".join([*map(re.escape, SLOTS), r"\w+", "[?!]"]))


def published_tokens(sentence: str) -> tuple[str, ...]:
    """Tokens as in the paper: words in lower case with their accents, `!` and `?` tokens of their own.

    Opening marks, commas and points are left out: `"¿Qué tal?"` is `qué tal ?`.
    """
    return tuple(_TOKEN.findall(clean(sentence).text.lower()))


def folded_tokens(sentence: str) -> tuple[str, ...]:
    """The same without accents (`ñ` stays), which makes one token of all ways of typing a word."""
    return tuple(token if token in SLOTS else fold(token) for token in published_tokens(sentence))


def mark_variants(tokens: tuple[str, ...]) -> list[tuple[str, ...]]:
    """The same sentence with its marks typed in every likely way: as given, left out, or others."""
    inner = tokens[:-1] if tokens[-1:] and tokens[-1] in MARKS else tokens
    bare = tuple(token for token in inner if token not in MARKS)
    return list(
        dict.fromkeys([tokens, *((*body, *end) for body in (bare, inner) for end in ((), ("?",), ("!",)))])
    )
