# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether an arm can bring its hand to a point, whichever way the hand is turned."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from teo_common.arrays import Array
from teo_description.humanoid import Side
from teo_description.robot import Robot

# So near a point counts as reached [m].
_NEAR = 0.01

# So deep a finger tip that is put on the body may be in its shapes [m]: as much as the point is off them.
_TOUCH = 0.02

# Starts of the search beside the ready posture, among them one near enough for each of TEO's places.
_STARTS = 8


class Reached(NamedTuple):
    """How near a hand came."""

    distance: float
    """From the point, of the best posture that touches nothing else [m]; infinite without one."""
    why: str
    """What stands in the way; empty where it was reached."""
    positions: dict[str, float]
    """The posture [rad]."""

    @property
    def ok(self) -> bool:
        """Whether the point is reached."""
        return not self.why


class ArmReach:
    """Inverse kinematics of one arm for a point, with straight fingers and the body at home."""

    def __init__(self, robot: Robot, side: Side) -> None:
        """Look at one side."""
        humanoid = robot.humanoid
        self._robot, self.side = robot, side
        self._arm = humanoid.arm(side)
        frames = humanoid.file.hand.palm, next(iter(humanoid.file.hand.fingers.values()))[3]
        self.palm, self.tip = (
            frame if side == "right" else humanoid.mirrored_name(frame) for frame in frames
        )
        limits, natural = humanoid.limits(self._arm), humanoid.file.natural_arm
        bounds = np.radians([natural.lower_deg, natural.upper_deg])
        if side == "left":
            bounds = np.sort(bounds * humanoid.mirror_signs(self._arm), axis=0)
        self._lower, self._upper = np.maximum(limits.lower, bounds[0]), np.minimum(limits.upper, bounds[1])
        ready = humanoid.ready[humanoid.columns(self._arm)]
        dice = np.random.default_rng(3)
        inside = np.clip(ready, self._lower, self._upper)
        self._starts = [inside, *dice.uniform(self._lower, self._upper, (_STARTS, len(self._arm)))]

    def to(self, point: Array, frame: str, *, body: bool) -> Reached:
        """Bring a frame to a point.

        Args:
            point: In ``base_link`` [m]. Shape (3,).
            frame: Of the hand.
            body: Whether the point is on the body, which may then be touched there.
        """
        best = Reached(math.inf, "out of reach", {})
        allowed = -_TOUCH if body else 0.0
        for start in self._starts:
            found = least_squares(
                lambda x: self._off(x, frame, point),
                np.clip(start, self._lower + 1e-6, self._upper - 1e-6),
                jac=lambda x: self._robot.jacobian(self._q(x), frame, self._arm)[:3],
                bounds=(self._lower, self._upper),
                max_nfev=60,
            )
            distance = float(np.linalg.norm(found.fun))
            positions = dict(zip(self._arm, found.x.tolist(), strict=True))
            if distance > _NEAR:
                if distance < best.distance and best.why.startswith("out"):
                    best = Reached(distance, f"out of reach by {distance * 1e3:.0f} mm", positions)
                continue
            nearest = self._robot.clearance(self._robot.configuration(positions))
            if nearest.distance >= allowed:
                return Reached(distance, "", positions)
            best = Reached(distance, f"{nearest.first} is in {nearest.second}", positions)
        return best

    def _q(self, x: Array) -> Array:
        return self._robot.configuration(dict(zip(self._arm, x.tolist(), strict=True)))

    def _off(self, x: Array, frame: str, point: Array) -> Array:
        off: Array = self._robot.placement(self._q(x), frame)[:3, 3] - point
        return off
