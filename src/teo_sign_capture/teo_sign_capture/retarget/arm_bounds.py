# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bounds that an arm keeps, and arms seen in a mirror: both arms are solved for as right arms."""

from __future__ import annotations

from typing import Literal

import numpy as np

from teo_common.arrays import Array
from teo_description import LEFT_ARM, RIGHT_ARM, joint_limits
from teo_signs.mirroring import mirrored_positions

Bounds = tuple[Array, Array]
Side = Literal["right", "left"]

# Distance kept from every limit, so that a planner may overshoot by its rounding [rad].
MARGIN = np.radians(1.0)

# Beyond these bounds, in the order of RIGHT_ARM [deg], the arm looks like no person's: shoulder and elbow as
# TEO's makers call "human-inspired" (developer manual, motores-motores.csv); a hand that hangs, as a
# person's, at a right angle with the forearm and no farther. Turns about the length of an arm are bound by
# its limits alone: nobody sees where they end.
_LIKE_A_PERSON_LOWER = np.radians([-98.1, -75.5, -180.0, -99.6, -180.0, -90.0])
_LIKE_A_PERSON_UPPER = np.radians([45.0, 22.4, 180.0, -5.0, 180.0, 44.7])
# Signs of a right arm's joints in its mirror image. Shape (6,).
_SIGNS = mirrored_positions(RIGHT_ARM, np.ones(len(RIGHT_ARM)))


def arm_bounds(side: Side | Literal["both"]) -> Bounds:
    """Lower and upper bounds kept by an arm, seen as a right arm [rad]. Shapes (6,).

    Args:
        side: Which arm; "both" for a right arm that the left one can mirror.
    """
    if side == "both":
        (right_lower, right_upper), (left_lower, left_upper) = arm_bounds("right"), arm_bounds("left")
        return np.maximum(right_lower, left_lower), np.minimum(right_upper, left_upper)
    limits = joint_limits(RIGHT_ARM if side == "right" else LEFT_ARM)
    lower, upper = limits.lower, limits.upper
    if side == "left":
        ends = np.stack([mirrored(lower), mirrored(upper)])
        lower, upper = ends.min(axis=0), ends.max(axis=0)
    return np.maximum(lower, _LIKE_A_PERSON_LOWER) + MARGIN, np.minimum(upper, _LIKE_A_PERSON_UPPER) - MARGIN


def mirrored(arm: Array) -> Array:
    """The arm, or arms, of the other side that mirror some [rad]. Shape (6,) or (n, 6)."""
    swapped: Array = _SIGNS * arm
    return swapped
