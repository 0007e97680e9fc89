# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Points of a hand: those that go to a place, and those that the other hand goes to."""

from __future__ import annotations

import math

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.hand import Hand
from teo_synthetic_signer.body.hand_shapes import HandShape
from teo_synthetic_signer.errors import unknown_name

# `palm` is the middle of the hand, between wrist and middle knuckle; `back` is on its back; `index_side` and
# `little_side` are its edges; `fingertips` is the middle of the tips of the fingers that are stretched most.
POINTS = (
    *("wrist", "palm", "back", "index_side", "little_side"),
    *("index_tip", "middle_tip", "thumb_tip", "fingertips", "knuckles"),
)

# Places on the other hand, and which of its points they are.
OTHER_HAND = {
    "other_palm": "palm",
    "other_back": "back",
    "other_wrist": "wrist",
    "other_index_side": "index_side",
    "other_little_side": "little_side",
    "other_fingertips": "fingertips",
}

# Half of a hand's thickness at the knuckles, of its length from wrist to fingertip: 27 mm of 180 mm, a middle
# between both sexes (NASA-STD-3000, hand thickness at the third metacarpal).
_HALF_THICK = 0.075
# Fingers that are bent by so much more than the straightest one are stretched too.
_AS_STRETCHED = math.radians(30.0)


def hand_point(hand: Hand, shape: HandShape, name: str) -> FloatArray:
    """Give a point of `POINTS` with the wrist at rest [m]. Shape (3,).

    Raises:
        SyntheticError: No point has that name.
    """
    joints = hand.joints(shape)
    middle = (joints[0] + joints[9]) / 2.0
    _, palm, thumbwards = hand.axes.T
    half = _HALF_THICK * float(np.linalg.norm(hand.joints_straight[12] - joints[0]))
    bent = shape.flexion.sum(axis=1)
    stretched = np.flatnonzero(bent <= bent.min() + _AS_STRETCHED)
    points = {
        "wrist": joints[0],
        "palm": middle,
        "back": middle - half * palm,
        "index_side": joints[5] + half * thumbwards,
        "little_side": (joints[0] + 2.0 * joints[17]) / 3.0 - half * thumbwards,
        "index_tip": joints[8],
        "middle_tip": joints[12],
        "thumb_tip": joints[4],
        "fingertips": joints[8 + 4 * stretched].mean(axis=0),
        "knuckles": (joints[6] + joints[10]) / 2.0,
    }
    if name not in points:
        raise unknown_name("point", name, POINTS)
    point: FloatArray = points[name]
    return point
