# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The edge to hands whose controllers count in something else than joint angles, as `robot.yaml` says."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_description.errors import DescriptionError
from teo_description.humanoid import SIDES, Humanoid, Side

# A thousandth of a degree: more than the driver's position tolerance, less than the servo's step.
_TOLERANCE_DEG = 1e-3


class HandAxis(NamedTuple):
    """One axis of a hand as its controller counts it."""

    joint: str
    unit: str
    """What a set-point is in: "mm" of tendon or "deg" of a servo."""
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


def setpoint_axes(humanoid: Humanoid, side: Side) -> tuple[HandAxis, ...]:
    """The commanded axes of a hand, in their order; empty where its controller takes joint angles."""
    controllers = humanoid.file.controllers
    if controllers is None:
        return ()
    hands = controllers.hands
    of_axis = (hands.abductor, hands.thumb, *(hands.finger,) * 4)
    return tuple(
        HandAxis(name, axis.unit, axis.travel, axis.low_deg, axis.high_deg)
        for name, axis in zip(humanoid.hand_axes(side), of_axis, strict=True)
        if name is not None
    )


def hand_setpoints(humanoid: Humanoid, positions: Array) -> Array:
    """What both hands' controllers are told, the left one's first.

    Args:
        humanoid: The robot, whose hands have `setpoint_axes`.
        positions: Of all hand axes, left then right [rad]. Shape (axes,).

    Returns:
        Set-points [deg] and [mm]. Shape (axes,).

    Raises:
        DescriptionError: ``outside_hand_range``.
    """
    axes = [axis for side in SIDES for axis in setpoint_axes(humanoid, side)]
    return np.array([axis.setpoint(angle) for axis, angle in zip(axes, positions.tolist(), strict=True)])
