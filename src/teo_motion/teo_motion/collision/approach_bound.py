# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How much nearer two parts of the robot can have come to each other while its joints turned.

Two parts approach by at most what the joints between them move the farthest points of both. How far a point
of a rigid part is displaced between two postures is a convex function of the point, so it is greatest at a
corner of a box that holds the part. Between two rows the joints turn evenly: a corner leaves the straight
line from one to the other by at most (angle turned)^2 * reach / 8, which is added. So the distance of a
watched pair in one row bounds it in another.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from teo_common.arrays import Array
from teo_description import COMMANDED_JOINTS, HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, TRUNK

# Shoulder to elbow and elbow to wrist [m]: lengths l6 and l7 of the robot description.
UPPER_ARM, FOREARM = 0.32901, 0.215

# Boxes [m] that hold the upper arm, in its frame at the shoulder; the forearm, at the elbow; the hand of
# either side with all that its fingers and thumb reach, at the wrist.
UPPER_ARM_BOX = ((-0.06, 0.06), (-0.06, 0.06), (-0.34, 0.07))
FOREARM_BOX = ((-0.06, 0.06), (-0.06, 0.06), (-0.30, 0.06))
HAND_BOX = ((-0.06, 0.16), (-0.13, 0.13), (-0.33, 0.06))

# From the shoulder to the farthest corner of the hand [m].
ARM_REACH = 0.95

# How far a point of abductor and thumb, of the thumb, of a finger goes for each radian of its axis [m]: what
# lies beyond each joint that the axis turns, added up.
ABDUCTOR, THUMB, FINGER = 0.14, 0.11, 0.21

# From the neck's axes to the farthest point of the head; from the trunk's to that of a stretched arm [m].
NECK, TRUNK_REACH = 0.25, 1.5


def approaches(positions: Array) -> Array:
    """Bounds of how much any watched pair of parts approaches between one row and the next [m].

    Args:
        positions: Of the 28 commanded joints, on straight lines between rows [rad]. Shape (n, 28).

    Returns:
        Shape (n - 1,).
    """
    turned = np.abs(np.diff(positions, axis=0))
    right, left = (
        _arm(positions[:, _columns(arm)]) + _digits(turned[:, _columns(hand)])
        for arm, hand in ((RIGHT_ARM, RIGHT_HAND), (LEFT_ARM, LEFT_HAND))
    )
    head = NECK * turned[:, _columns(HEAD)].sum(axis=1)
    # The trunk carries head and arms alike: they approach pelvis and legs.
    trunk = TRUNK_REACH * turned[:, _columns(TRUNK)].sum(axis=1)
    bounds: Array = np.maximum(right + left, np.maximum(right, left) + np.maximum(head, trunk))
    return bounds


def _arm(positions: Array) -> Array:
    """How far a point of an arm or its hand goes from row to row, fingers still [m]."""
    first, second, third, elbow_turn, roll, wrist_turn = positions.T
    upper = _turn(1, first) @ _turn(0, second) @ _turn(2, third)
    fore = upper @ _turn(1, elbow_turn)
    hand = fore @ _turn(2, roll) @ _turn(1, wrist_turn)
    elbow = -UPPER_ARM * upper[:, :, 2]
    wrist = elbow - FOREARM * fore[:, :, 2]
    corners = np.concatenate(
        [
            place[:, None] + np.array(list(product(*box))) @ turn.transpose(0, 2, 1)
            for turn, place, box in (
                (upper, np.zeros_like(elbow), UPPER_ARM_BOX),
                (fore, elbow, FOREARM_BOX),
                (hand, wrist, HAND_BOX),
            )
        ],
        axis=1,
    )
    way = np.diff(corners, axis=0)
    straight = np.sqrt(np.einsum("ijk,ijk->ij", way, way).max(axis=1))
    beside = np.abs(np.diff(positions, axis=0)).sum(axis=1) ** 2 * ARM_REACH / 8.0
    displaced: Array = straight + beside
    return displaced


def _turn(axis: int, angles: Array) -> Array:
    """Rotations about x, y or z (0, 1, 2) by angles [rad]. Shape (n, 3, 3)."""
    turns = np.zeros((len(angles), 3, 3))
    one, other = (axis + 1) % 3, (axis + 2) % 3
    turns[:, axis, axis] = 1.0
    turns[:, one, one] = turns[:, other, other] = np.cos(angles)
    turns[:, other, one] = np.sin(angles)
    turns[:, one, other] = -turns[:, other, one]
    return turns


def _digits(turned: Array) -> Array:
    """How far a point of a finger or thumb goes in the hand [m]."""
    thumb = ABDUCTOR * turned[:, 0] + THUMB * turned[:, 1]
    farthest: Array = np.maximum(thumb, FINGER * turned[:, 2:].max(axis=1))
    return farthest


def _columns(names: tuple[str, ...]) -> list[int]:
    return [COMMANDED_JOINTS.index(name) for name in names]
