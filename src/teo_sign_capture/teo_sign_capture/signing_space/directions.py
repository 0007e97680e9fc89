# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Directions in words, as a signer would say them: `front`, `up in`, `2 down back`."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array

# Seen from the right hand, in ``base_link`` (REP-103: x front, y left, z up). The left hand mirrors them, so
# that `in` is always towards the other side of the body and `out` away from it.
WORDS: dict[str, tuple[float, float, float]] = {
    "front": (1.0, 0.0, 0.0),
    "back": (-1.0, 0.0, 0.0),
    "in": (0.0, 1.0, 0.0),
    "out": (0.0, -1.0, 0.0),
    "up": (0.0, 0.0, 1.0),
    "down": (0.0, 0.0, -1.0),
}


def displacement(text: str) -> Array:
    """The sum of words, each times the number before it or 1. Shape (3,).

    Raises:
        ValueError: A word is none of `WORDS`, or a number stands without one.
    """
    total = np.zeros(3)
    factor: float | None = None
    for word in text.split():
        if word in WORDS:
            total += (1.0 if factor is None else factor) * np.array(WORDS[word])
            factor = None
        elif factor is None and _is_number(word):
            factor = float(word)
        else:
            raise ValueError(
                f"expected words among {', '.join(WORDS)}, each after a number or not; got {word!r}"
            )
    if factor is not None:
        raise ValueError(f"expected a word after {factor:g} in {text!r}")
    return total


def direction(text: str) -> Array:
    """The unit vector of a sum of words. Shape (3,).

    Raises:
        ValueError: As `displacement`, or the words cancel each other or are none.
    """
    total = displacement(text)
    length = float(np.linalg.norm(total))
    if length < 1e-9:
        raise ValueError(f"expected a direction such as 'front' or '2 up in', got {text!r}")
    unit: Array = total / length
    return unit


def _is_number(word: str) -> bool:
    try:
        return bool(np.isfinite(float(word)))
    except ValueError:
        return False
