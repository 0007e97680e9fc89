# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Points of a hand that can be where a sign is made: a person's, and what they are on TEO's hand."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import DextraTable

WRIST, KNUCKLES = 0, (5, 9, 13, 17)
_MIDDLES, _TIPS = (6, 10, 14, 18), (8, 12, 16, 20)
# Rows of the 21 keypoints.
_THUMB_JOINT, _THUMB_TIP = 3, 4

# Rows of the points below: the middle of the palm, and the end of the hand at the wrist.
PALM, HEEL = 0, 1

# Makes a left hand a right one.
MIRROR = np.array([1.0, -1.0, 1.0])

# Palm, heel, knuckles, middle joints and tips of the fingers, joint and tip of the thumb.
COUNT = 2 + 3 * 4 + 2

# The middle of the palm lies so far from the wrist to the knuckles, as on TEO.
_PALM_SHARE = 0.55

# In the axes of TEO's palm [m]: the middle of the palm's box, whose face carries the frame, and the plate on
# which the hand is mounted. The wrist's joint is 9 cm farther up the arm, where no hand of a person is.
_TEO_PALM, _TEO_HEEL = (0.0, 0.0, -0.018), (-0.07, 0.01, -0.016)


def person_hand_points(hand: Array) -> Array:
    """The points of a person's hand.

    Args:
        hand: Its 21 keypoints. Shape (T, 21, 3).

    Returns:
        Shape (T, COUNT, 3).
    """
    wrist, knuckles = hand[:, [WRIST]], hand[:, KNUCKLES].mean(axis=1, keepdims=True)
    palm = wrist + _PALM_SHARE * (knuckles - wrist)
    rows = [WRIST, *KNUCKLES, *_MIDDLES, *_TIPS, _THUMB_JOINT, _THUMB_TIP]
    return np.concatenate([palm, hand[:, rows]], axis=1)


def teo_hand_points(table: DextraTable, axes: Array) -> Array:
    """The same points of TEO's right hand, in the axes of its palm.

    Args:
        table: The hand.
        axes: Of `RIGHT_HAND` [rad]. Shape (T, 6).

    Returns:
        Shape (T, COUNT, 3).
    """
    count = len(axes)
    fixed = np.broadcast_to(np.array([_TEO_PALM, _TEO_HEEL]), (count, 2, 3))
    fingers = table.finger_points(axes[:, 2:])
    thumb = table.thumb_points(axes[:, 0], axes[:, 1])
    return np.concatenate([fixed, fingers[:, :, 0], fingers[:, :, 1], fingers[:, :, 3], thumb[:, 1:]], axis=1)
