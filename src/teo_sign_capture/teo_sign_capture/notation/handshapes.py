# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The inventory of handshapes: names of a person's, and what TEO's six motors make of them.

TEO bends the three joints of a finger alike and cannot spread the fingers: `open` and `flat` differ by the
thumb, `bent` bends the whole finger a little. What the names mean on a person's hand stands beside each.
"""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array

# [deg] Abductor, thumb, index, middle, ring, little finger. 7 is straight, 85 fully bent; abductor 0 has the
# thumb at the hand's side, 90 opposite the palm; thumb -90 stands out, 90 is folded. Thumbs over folded
# fingers are as far over as they go without touching (`hand_contact`); those that meet a finger are those of
# the letters O, T, S.
_SHAPES: dict[str, tuple[float, float, float, float, float, float]] = {
    "flat": (0, -25, 7, 7, 7, 7),  # fingers straight and together, thumb along
    "open": (0, -70, 7, 7, 7, 7),  # fingers straight and spread, thumb out
    "relaxed": (10, -50, 22, 22, 22, 22),  # open, fingers a little bent
    "bent": (0, -30, 40, 40, 40, 40),  # bent at the knuckles only
    "cupped": (20, -50, 32, 32, 32, 32),  # a little hollow
    "claw": (10, -60, 48, 48, 48, 48),  # spread and bent at the middle joints
    "bunched": (80, -54, 40, 38, 42, 42),  # all tips on the thumb's
    "fist": (21, -12, 80, 80, 80, 80),  # thumb along the index: TEO's cannot lie across folded fingers
    "thumb": (0, -70, 80, 80, 80, 80),  # fist, thumb up
    "index": (45, -15, 7, 80, 80, 80),
    "hook": (33, -25, 45, 80, 80, 80),  # index crooked
    "two": (70, -15, 7, 7, 80, 80),  # index and middle: V and U are one on TEO
    "bent_two": (70, -15, 42, 42, 80, 80),
    "three": (80, -15, 7, 7, 7, 80),  # index, middle, ring
    "four": (80, -15, 7, 7, 7, 7),  # thumb before the palm
    "little": (21, -12, 80, 80, 80, 7),
    "horns": (51, -18, 7, 80, 80, 7),  # index and little finger
    "thumb_little": (0, -70, 80, 80, 80, 7),  # Y
    "l": (0, -70, 7, 80, 80, 80),  # thumb and index at a right angle
    "thumb_two": (0, -70, 7, 7, 80, 80),  # thumb, index, middle
    "pinch": (62, -66, 44, 80, 80, 80),  # thumb on the index, the others folded
    "ring": (62, -66, 44, 14, 8, 7),  # thumb on the index, the others straight
    "middle_flick": (80, -60, 7, 42, 7, 7),  # middle finger on the thumb, the others straight
    "two_flick": (75, -62, 44, 44, 80, 80),  # index and middle on the thumb, the others folded
    "three_flick": (80, -60, 44, 44, 44, 80),  # index, middle, ring finger on the thumb
}

NAMES = tuple(_SHAPES)


def handshape(name: str) -> Array:
    """The six axes of a hand, in the order of `RIGHT_HAND` [rad]. Shape (6,).

    Raises:
        ValueError: There is no such shape.
    """
    if name not in _SHAPES:
        raise ValueError(f"expected a handshape among {', '.join(NAMES)}; got {name!r}")
    axes: Array = np.radians(_SHAPES[name])
    return axes
