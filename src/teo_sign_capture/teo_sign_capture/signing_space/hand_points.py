# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Points of a hand that can be where a sign is made: a person's, and what they are on a robot's hand."""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandGeometry, HandTable
from teo_description.robot_schema import FINGERS

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


def finger_rows(hand: HandGeometry) -> list[int]:
    """Which of a person's four fingers a hand has, index 0."""
    return [FINGERS.index(name) for name in hand.fingers]


def robot_hand_points(table: HandTable, axes: Array) -> Array:
    """The same points of a robot's right hand, in the axes of its palm.

    Where it lacks a finger, those of the finger beside it.

    Args:
        table: The hand.
        axes: Of `HandGeometry.joints` [rad]. Shape (T, axes).

    Returns:
        Shape (T, COUNT, 3).
    """
    count, rows = len(axes), finger_rows(table.hand)
    fixed = np.broadcast_to(np.array([table.hand.palm_middle, table.hand.heel]), (count, 2, 3))
    nearest = [int(np.argmin(np.abs(np.array(rows) - finger))) for finger in range(len(FINGERS))]
    fingers = table.finger_points(axes[:, 2:])[:, nearest]
    thumb = table.thumb_points(axes[:, 0], axes[:, 1])
    return np.concatenate([fixed, fingers[:, :, 0], fingers[:, :, 1], fingers[:, :, 3], thumb[:, 1:]], axis=1)
