# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the planned motion must stay within."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_description import DescriptionError
from teo_description.humanoid import Humanoid, load_humanoid
from teo_motion.trajectory.ruckig_segment import Bounds
from teo_signs.errors import PlanError

# Acceleration of the body's joints [rad/s^2], 401 deg/s^2: one is at 50 deg/s, its greatest velocity, after
# 0.19 s and 4.8 deg. TEO's drives default to 10 deg/s^2, with which 10 deg take 2 s: no sign would be known
# again; TEO's own gestures were played at 25 deg/s^2 and 25 deg/s. By the masses of the robot description one
# arm joint that accelerates so needs at most 12 N m (3.2 at the elbow, 0.8 at the wrist) beside the at most
# 27 N m with which it carries the arm. Signers reach several times as much, but letters that shake gain
# little from more: they are short of velocity.
DEFAULT_ACCELERATION = 7.0

# Jerk of the body's joints [rad/s^3], 6016 deg/s^3: acceleration builds up in 0.07 s, more than three of the
# 0.02 s at which TEO's drives are sent set-points, so that it reaches them as a ramp and not as a step.
DEFAULT_JERK = 105.0

# Share of the limits that segments are given [1]: positions are rounded to 2e-16 rad, which a driver's period
# to the third power divides to 1e-10 rad/s^3.
_HAIR = 1.0 - 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionLimits:
    """Limits of every commanded joint.

    Attributes:
        humanoid: Whose they are.
        lower: Least position [rad]. Shape (n,), as all below.
        upper: Greatest position [rad].
        velocity: Greatest speed [rad/s].
        acceleration: Greatest acceleration, either way [rad/s^2].
        jerk: Greatest jerk, either way [rad/s^3].
    """

    humanoid: Humanoid
    lower: NDArray[np.float64]
    upper: NDArray[np.float64]
    velocity: NDArray[np.float64]
    acceleration: NDArray[np.float64]
    jerk: NDArray[np.float64]

    @classmethod
    def of_robot(
        cls,
        humanoid: Humanoid | None = None,
        *,
        acceleration: float = DEFAULT_ACCELERATION,
        jerk: float = DEFAULT_JERK,
        hand_drive: str = "",
    ) -> MotionLimits:
        """Limits of the robot description, with one acceleration and jerk for all joints of the body.

        Args:
            humanoid: The robot; None: the default one.
            acceleration: [rad/s^2], above 0; hands have as much more as their drive is quicker.
            jerk: [rad/s^3], above 0; hands likewise.
            hand_drive: Gearmotors of the hands, one of the robot's `hand_drives`; empty: its default.

        Raises:
            PlanError: Not finite or not above 0, or no such drive ("bad_limits").
        """
        for name, value in (("acceleration", acceleration), ("jerk", jerk)):
            if not (math.isfinite(value) and value > 0.0):
                message = f"{name}: expected a finite number above 0, got {value}"
                raise PlanError("bad_limits", message)
        try:
            humanoid = load_humanoid() if humanoid is None else humanoid
            limits = humanoid.limits(hand_drive=hand_drive)
            quickness = humanoid.quickness(hand_drive)
        except DescriptionError as error:
            raise PlanError("bad_limits", str(error)) from error
        return cls(
            humanoid=humanoid,
            lower=limits.lower,
            upper=limits.upper,
            velocity=limits.velocity,
            acceleration=acceleration * quickness,
            jerk=jerk * quickness,
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Joints, in the order of the arrays: all that are commanded."""
        return self.humanoid.commanded_joints

    @property
    def bounds(self) -> Bounds:
        """The same for segments, a hair less: the points of a motion are differences, which are rounded."""
        return Bounds(
            lower=self.lower,
            upper=self.upper,
            velocity=self.velocity * _HAIR,
            acceleration=self.acceleration * _HAIR,
            jerk=self.jerk * _HAIR,
        )

    def least_times(self, distances: NDArray[np.float64], columns: list[int]) -> NDArray[np.float64]:
        """Least times in which joints move from rest to rest.

        Symmetric S-curve: L. Biagiotti, C. Melchiorri, "Trajectory Planning for Automatic Machines and
        Robots" (2008), 3.4.

        Args:
            distances: Distances to move, of either sign [rad]. Shape (m,).
            columns: Indices of the joints that move them, in `names`.

        Returns:
            Durations [s]. Shape (m,).
        """
        distance = np.abs(distances)
        speed, acceleration, jerk = (
            values[columns] for values in (self.velocity, self.acceleration, self.jerk)
        )
        # With a phase of constant velocity; then with one of constant acceleration; then with neither.
        ramp = np.where(
            speed * jerk >= acceleration**2,
            speed / acceleration + acceleration / jerk,
            2.0 * np.sqrt(speed / jerk),
        )
        without_cruise = np.where(
            distance >= 2.0 * acceleration**3 / jerk**2,
            acceleration / jerk + np.sqrt((acceleration / jerk) ** 2 + 4.0 * distance / acceleration),
            np.cbrt(32.0 * distance / jerk),
        )
        return np.where(distance >= speed * ramp, ramp + distance / speed, without_cruise)
