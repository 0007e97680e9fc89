# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences drawn at random from a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token


def random_tokens(
    dice: np.random.Generator,
    table: Mapping[str, Sign],
    *,
    most: int,
    scales: Sequence[float],
    words: int | None = None,
) -> list[Token]:
    """Signs of a table, letters and numbers among them, now and then faster or slower.

    Args:
        dice: What draws.
        table: What is drawn from.
        most: Signs of the longest sentence.
        scales: One is drawn for each sign: duration over the usual one [1].
        words: Words to one of which each sign but a number belongs; None: each is a word of its own.
    """
    glosses, tokens = sorted(table), []
    for index in range(dice.integers(1, most + 1)):
        sign = table[str(dice.choice(glosses))]
        scale = float(dice.choice(scales))
        kind = Kind[sign.kind.upper()]
        # A number is a word of its own: two in one word are read as the number that they make together.
        word = most + index if words is None or kind == Kind.NUMBER else int(dice.integers(words))
        tokens.append(Token(gloss=sign.gloss, kind=kind, duration_scale=scale, word_index=word))
    return tokens
