"""Bounds that an arm keeps, and arms seen in a mirror: both arms are solved for as right arms."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_description import LEFT_ARM, RIGHT_ARM, joint_limits

Array = NDArray[np.float64]

MARGIN = np.radians(1.0)
"""[rad] Distance kept from every limit, so that a planner may overshoot by its rounding."""

# Beyond these bounds, in the order of RIGHT_ARM [deg], the arm looks like no person's: shoulder and elbow as
# TEO's makers call "human-inspired" (developer manual, motores-motores.csv); a hand that hangs, as a
# person's, at a right angle with the forearm and no farther. Turns about the length of an arm are bound by
# its limits alone: nobody sees where they end.
_LIKE_A_PERSON_LOWER = np.radians([-98.1, -75.5, -180.0, -99.6, -180.0, -90.0])
_LIKE_A_PERSON_UPPER = np.radians([45.0, 22.4, 180.0, -5.0, 180.0, 44.7])


def arm_bounds(side: str) -> tuple[Array, Array]:
    """Bounds kept by an arm, seen as a right arm [rad]. Shapes (6,)."""
    limits = joint_limits(RIGHT_ARM if side == "right" else LEFT_ARM)
    lower, upper = limits.lower, limits.upper
    if side == "left":
        lower, upper = mirrored(upper), mirrored(lower)
        lower, upper = np.minimum(lower, upper), np.maximum(lower, upper)
    return np.maximum(lower, _LIKE_A_PERSON_LOWER) + MARGIN, np.minimum(upper, _LIKE_A_PERSON_UPPER) - MARGIN


def mirrored(arm: Array) -> Array:
    """The arm that mirrors another: only frontal axes turn the same way on both sides [rad]. Shape (6,)."""
    same = np.array([1.0 if joint.startswith("Frontal") else -1.0 for joint in RIGHT_ARM])
    swapped: Array = same * arm
    return swapped
