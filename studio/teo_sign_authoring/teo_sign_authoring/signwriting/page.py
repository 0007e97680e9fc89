# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the page to the space before the signer.

Vectors of the page are right and up; those of the space are front, left, up, as base_link has them. Signs
are drawn as the signer sees them. What moves parallel to the wall in front (double lines) is seen from
behind, what moves parallel to the floor (single lines) from above: there, up on the page is to the front.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from teo_common.arrays import Array

Plane = Literal["wall", "floor"]
Side = Literal["right", "left"]
SIDES: tuple[Side, Side] = ("right", "left")

# A head is 36 px wide and high; TEO's, from chin to crown, is 0.18 m.
CM_PER_PIXEL = 0.5

_EIGHTH = np.pi / 4.0


def turned(vector: Array, rotation: int) -> Array:
    """A vector of the page, drawn with rotation 0, as it is with another: 45 deg a step, from 8 on mirrored.

    Args:
        vector: Right and up. Shape (2,).
        rotation: 0 to 15.
    """
    right, up = float(vector[0]), float(vector[1])
    angle = rotation % 8 * _EIGHTH
    cos, sin = np.cos(angle), np.sin(angle)
    if rotation < 8:
        return np.array([right * cos - up * sin, right * sin + up * cos])
    return np.array([-right * cos + up * sin, right * sin + up * cos])


def in_space(vector: Array, plane: Plane) -> Array:
    """A vector of the page (right, up) as front, left, up. Shape (3,)."""
    right, up = float(vector[0]), float(vector[1])
    return np.array([0.0, -right, up]) if plane == "wall" else np.array([up, -right, 0.0])


def for_hand(vector: Array, side: Side) -> Array:
    """A vector of the space as that hand's score writes it: the left hand's is mirrored. Shape (3,)."""
    return vector if side == "right" else np.asarray(vector * np.array([1.0, -1.0, 1.0]))


_WORDS = (("front", "back"), ("in", "out"), ("up", "down"))
# Shares of the largest component: below the first a component is left out, below the second it counts half.
_LEAST_SHARE, _HALF_SHARE = 0.3, 0.7


def direction_words(vector: Array) -> str:
    """A direction of a hand's score in words: "2 up in". Shape (3,)."""
    share = np.abs(vector) / np.abs(vector).max()
    halves = bool(np.any((share >= _LEAST_SHARE) & (share < _HALF_SHARE)))
    words = []
    for index in np.argsort(-share, kind="stable").tolist():
        if share[index] >= _LEAST_SHARE:
            factor = "2 " if halves and share[index] >= _HALF_SHARE else ""
            words.append(factor + _WORDS[index][int(vector[index] < 0.0)])
    return " ".join(words)


def displacement_words(vector: Array) -> str:
    """A displacement in words and whole centimetres: "3 up 2 out"; empty for none.

    Args:
        vector: In the axes of a hand's score [cm]. Shape (3,).
    """
    words = []
    for index, size in enumerate(vector.tolist()):
        if round(abs(size)):
            words.append(f"{round(abs(size))} {_WORDS[index][int(size < 0.0)]}")
    return " ".join(words)
