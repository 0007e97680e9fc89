# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The shapes a hand takes in signing, as angles of its joints.

Angles follow from looking at hands, not from a source: they make a shape that a signer would recognise, and
truth comes from the pose, not from them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.errors import unknown_name

FINGERS = ("index", "middle", "ring", "little")


@dataclass(frozen=True)
class HandShape:
    """A hand as numbers that can be blended.

    Attributes:
        flexion: Of the knuckle, middle and last joint of index, middle, ring and little finger; 0 is
            straight [rad]. Shape (4, 3).
        spread: Of these fingers towards the thumb, in the plane of the palm [rad]. Shape (4,).
        thumb: Directions in the hand's own axes (along the fingers, out of the palm, towards the thumb's
            side): where the thumb's metacarpal points, and towards where the thumb bends. Shape (2, 3).
        thumb_flexion: Of the thumb's two outer joints [rad]. Shape (2,).
    """

    flexion: FloatArray
    spread: FloatArray
    thumb: FloatArray
    thumb_flexion: FloatArray

    def blend(self, other: HandShape, share: float) -> HandShape:
        """Give the shape on the way to another; a share of 0 is this one, 1 the other."""
        pairs = [
            (self.flexion, other.flexion),
            (self.spread, other.spread),
            (self.thumb, other.thumb),
            (self.thumb_flexion, other.thumb_flexion),
        ]
        return HandShape(*((1.0 - share) * mine + share * its for mine, its in pairs))


_STRAIGHT = (2.0, 4.0, 3.0)
_RELAXED = (22.0, 28.0, 15.0)
_FOLDED = (82.0, 95.0, 60.0)
_HOOK = (8.0, 80.0, 50.0)
_BENT = (75.0, 8.0, 5.0)
_ROUND = (45.0, 48.0, 30.0)
_CLAW = (25.0, 50.0, 35.0)
_PINCH = (55.0, 50.0, 25.0)

# Where the thumb's metacarpal points, towards where it bends, and how far in its two outer joints [deg].
THUMBS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float]]] = {
    "out": ((0.70, 0.30, 0.65), (0.75, 0.15, -0.65), (0.0, 0.0)),
    "beside": ((0.90, 0.30, 0.32), (0.35, 0.35, -0.87), (8.0, 5.0)),
    "relaxed": ((0.80, 0.45, 0.40), (0.30, 0.45, -0.84), (18.0, 15.0)),
    "across": ((0.72, 0.62, 0.30), (0.10, 0.30, -0.95), (42.0, 38.0)),
    "over": ((0.70, 0.66, 0.28), (0.15, 0.25, -0.95), (45.0, 50.0)),
    "up": ((0.35, 0.25, 0.90), (0.80, 0.20, -0.50), (-5.0, -10.0)),
    "opposed": ((0.68, 0.72, 0.15), (0.45, 0.20, -0.87), (22.0, 25.0)),
}


def hand_thumb(name: str) -> tuple[FloatArray, FloatArray]:
    """Give a thumb of `THUMBS`: `HandShape.thumb` and `HandShape.thumb_flexion`."""
    points, bends, angles = THUMBS[name]
    return np.array([points, bends]), np.radians(np.array(angles))


def _shape(
    fingers: tuple[tuple[float, float, float], ...],
    thumb: str,
    spread: tuple[float, float, float, float] = (2.0, 0.0, -2.0, -5.0),
) -> HandShape:
    return HandShape(np.radians(np.array(fingers)), np.radians(np.array(spread)), *hand_thumb(thumb))


_FAN = (12.0, 2.0, -9.0, -20.0)  # spread of an open hand [deg]

HAND_SHAPES: dict[str, HandShape] = {
    "relaxed": _shape((_RELAXED, (26.0, 32.0, 18.0), (30.0, 34.0, 18.0), (32.0, 34.0, 18.0)), "relaxed"),
    "open": _shape((_STRAIGHT,) * 4, "out", _FAN),
    "flat": _shape((_STRAIGHT,) * 4, "beside"),
    "fist": _shape((_FOLDED,) * 4, "over"),
    "index": _shape((_STRAIGHT, _FOLDED, _FOLDED, _FOLDED), "over"),
    "middle": _shape((_FOLDED, _STRAIGHT, _FOLDED, _FOLDED), "over"),
    "little": _shape((_FOLDED, _FOLDED, _FOLDED, _STRAIGHT), "over"),
    "v": _shape((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "across", (13.0, -10.0, -4.0, -6.0)),
    "u": _shape((_STRAIGHT, _STRAIGHT, _FOLDED, _FOLDED), "across"),
    "w": _shape((_STRAIGHT, _STRAIGHT, _STRAIGHT, _FOLDED), "across", (13.0, 0.0, -13.0, -8.0)),
    "b": _shape((_STRAIGHT,) * 4, "across"),
    "l": _shape((_STRAIGHT, _FOLDED, _FOLDED, _FOLDED), "up"),
    "y": _shape((_FOLDED, _FOLDED, _FOLDED, _STRAIGHT), "up", (2.0, 0.0, -2.0, -14.0)),
    "horns": _shape((_STRAIGHT, _FOLDED, _FOLDED, _STRAIGHT), "over", (6.0, 0.0, -2.0, -12.0)),
    "thumb_up": _shape((_FOLDED,) * 4, "up"),
    "c": _shape((_ROUND,) * 4, "opposed"),
    "o": _shape(((58.0, 56.0, 35.0), (58.0, 58.0, 36.0), (60.0, 58.0, 36.0), (62.0, 58.0, 36.0)), "opposed"),
    "claw": _shape((_CLAW,) * 4, "out", _FAN),
    "hook": _shape((_HOOK, _FOLDED, _FOLDED, _FOLDED), "over"),
    "bent": _shape((_BENT,) * 4, "beside"),
    "f": _shape((_PINCH, _STRAIGHT, _STRAIGHT, _STRAIGHT), "opposed", (0.0, 4.0, -7.0, -18.0)),
}


def hand_shape(name: str) -> HandShape:
    """Give a hand shape by name.

    Raises:
        SyntheticError: No shape has that name.
    """
    if name not in HAND_SHAPES:
        raise unknown_name("hand_shape", name, HAND_SHAPES)
    return HAND_SHAPES[name]
