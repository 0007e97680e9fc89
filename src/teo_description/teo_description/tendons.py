# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The edge to the real Dextra hand: from joint angles to what its motors are told.

Inside the project the axis of a finger or thumb is the flexion of its proximal phalanx [rad]. The device
(RoboticsLab UC3M, repository dextra-yarp-devices) takes for a finger the tendon wound on its spool, 0..20 mm,
for the thumb 0..10 mm, and for the thumb's abductor the angle of its servo, 0..90 deg. No measured map from
tendon to angle is public: this one is the straight line between the ends of both ranges, with a slack tendon
and with all of it wound: 7 to 85 deg for a finger, -90 (standing out) to 90 deg for the thumb.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_description.errors import DescriptionError
from teo_description.joints import LEFT_HAND, RIGHT_HAND

# Flexion of a finger's phalanges with a slack tendon [deg].
EXTENDED_DEG = 7.0

# Flexion of a finger's phalanges with the tendon wound up [deg].
FLEXED_DEG = 85.0

# Flexion of the thumb's proximal phalanx with a slack tendon and with the tendon wound up [deg].
THUMB_EXTENDED_DEG, THUMB_FLEXED_DEG = -90.0, 90.0

# Tendon travel of a finger [mm].
FINGER_TENDON_MM = 20.0

# Tendon travel of the thumb [mm].
THUMB_TENDON_MM = 10.0

# Greatest angle of the thumb's abductor [deg].
ABDUCTOR_DEG = 90.0

# A thousandth of a degree: more than the driver's position tolerance, less than the servo's step.
_TOLERANCE_DEG = 1e-3


class HandAxis(NamedTuple):
    """One axis of a hand as the device counts it."""

    joint: str
    unit: str
    """What a set-point is in: "mm" of tendon or "deg" of the servo."""
    travel: float
    """Greatest set-point, in that unit; the least is 0."""
    low: float
    """Joint angle at set-point 0 [deg]."""
    high: float
    """Joint angle at the greatest set-point [deg]."""

    def setpoint(self, angle: float) -> float:
        """Set-point for a joint angle [rad], in the axis's unit.

        Raises:
            DescriptionError: ``outside_hand_range``.
        """
        degrees = math.degrees(angle)
        if not self.low - _TOLERANCE_DEG <= degrees <= self.high + _TOLERANCE_DEG:
            raise DescriptionError(
                "outside_hand_range",
                f"expected {self.joint} within {self.low:g} .. {self.high:g} deg, got {degrees:.4g} deg",
            )
        return (degrees - self.low) / (self.high - self.low) * self.travel

    def angle(self, setpoint: float) -> float:
        """Joint angle [rad] at a set-point in the axis's unit.

        Raises:
            DescriptionError: ``outside_hand_range``.
        """
        tolerance = _TOLERANCE_DEG / (self.high - self.low) * self.travel
        if not -tolerance <= setpoint <= self.travel + tolerance:
            raise DescriptionError(
                "outside_hand_range",
                f"expected {self.joint} within 0 .. {self.travel:g} {self.unit}, got {setpoint:.4g}",
            )
        return math.radians(self.low + setpoint / self.travel * (self.high - self.low))


def _axis(joint: str) -> HandAxis:
    if joint.endswith("HandAbductor"):
        return HandAxis(joint, "deg", ABDUCTOR_DEG, 0.0, ABDUCTOR_DEG)
    if joint.endswith("ThumbFinger"):
        return HandAxis(joint, "mm", THUMB_TENDON_MM, THUMB_EXTENDED_DEG, THUMB_FLEXED_DEG)
    return HandAxis(joint, "mm", FINGER_TENDON_MM, EXTENDED_DEG, FLEXED_DEG)


# The left device's axes, in its order: abductor, thumb, index, middle, ring, pinky.
LEFT_AXES = tuple(_axis(joint) for joint in LEFT_HAND)

# The right device's axes, in the same order.
RIGHT_AXES = tuple(_axis(joint) for joint in RIGHT_HAND)

# Both devices' axes, in the order of `hand_setpoints`.
HAND_AXES = LEFT_AXES + RIGHT_AXES


def hand_setpoints(names: Sequence[str], positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """What both hands' devices are told for these joint positions.

    Args:
        names: Joint names, the twelve hand axes among them.
        positions: Of the joints [rad]. Shape (joints,).

    Returns:
        Set-points [deg] and [mm], in the order of `HAND_AXES`. Shape (12,).

    Raises:
        DescriptionError: ``outside_hand_range``, or ``missing_hand_joint``.
    """
    index = {name: i for i, name in enumerate(names)}
    missing = [axis.joint for axis in HAND_AXES if axis.joint not in index]
    if missing:
        raise DescriptionError(
            "missing_hand_joint", f"expected all twelve hand axes, missing: {', '.join(missing)}"
        )
    return np.array([axis.setpoint(float(positions[index[axis.joint]])) for axis in HAND_AXES])
