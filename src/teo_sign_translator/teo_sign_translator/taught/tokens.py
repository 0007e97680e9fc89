# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Tokens of taught sentences: words in lower case, and marks."""

from __future__ import annotations

import re

from teo_common.text_folding import fold
from teo_sign_translator.taught.aligned_pairs import SLOTS
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
