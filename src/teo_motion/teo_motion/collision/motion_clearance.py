# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near parts of the robot come to each other along a motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_description import COMMANDED_JOINTS
from teo_description.robot import Robot
from teo_motion.sentence.plan import NearestApproach, Samples

# How far any point of the robot can be from each joint's axis [m], rounded up from the robot description: tip
# of the hand to shoulder, elbow and wrist, finger tip to knuckle.
_REACH = {
    "Neck": 0.25,
    "Trunk": 0.9,
    "Shoulder": 0.85,
    "Elbow": 0.55,
    "FrontalLeftWrist": 0.33,
    "FrontalRightWrist": 0.33,
    "Wrist": 0.12,
    "Hand": 0.12,
    "Finger": 0.12,
}

# How far parts can have moved is bounded by adding up all joints, as if each moved the farthest point, and
# all in one direction. The real motion is about a third of that, and the approach of two parts less.
_REAL_SHARE = 0.5

# Two measured samples are at least this far apart, by that bound [m].
_STEP = 0.12

# The same for the head alone [m]: it is mostly far from the hands, so that looking closely costs little where
# it is not.
_HEAD_STEP = 0.02

# Around the nearest of them samples are this many times denser [1].
_CLOSER = 6


class MotionClearance:
    """Measures the distances between parts of the robot along a motion."""

    def __init__(self, robot: Robot) -> None:
        """Use a robot, which is not shared with another thread."""
        self._robot = robot
        self._reach = np.array([_reach(name) for name in COMMANDED_JOINTS])

    def nearest(self, samples: Samples, *, head_alone: bool = False) -> NearestApproach:
        """The nearest approach of parts along a motion.

        The distance is next measured where the parts can have moved by the distance found last, and at least
        by a step: far from contact it is measured seldom. Between the samples before and after the nearest
        one, it is measured at every sample, if there are not too many.

        Args:
            samples: The motion of the 28 commanded joints.
            head_alone: Whether only pairs with a part of the head are measured.
        """
        clearance = self._robot.head_clearance if head_alone else self._robot.clearance
        step = _HEAD_STEP if head_alone else _STEP

        def measured(index: int) -> NearestApproach:
            distance, first, second = clearance(self._configuration(samples.positions[index]))
            time = float(samples.times[index])
            return NearestApproach(distance=float(distance), time=time, first=first, second=second)

        moved = np.abs(np.diff(samples.positions, axis=0)) @ self._reach
        path = np.concatenate(([0.0], np.cumsum(moved)))
        looked: list[int] = []
        found: list[NearestApproach] = []
        index, last = 0, len(path) - 1
        while True:
            near = measured(index)
            looked.append(index)
            found.append(near)
            if index == last:
                break
            ahead = path[index] + max(near.distance / _REAL_SHARE, step)
            index = min(max(int(np.searchsorted(path, ahead)), index + 1), last)
        closest = min(range(len(found)), key=lambda item: found[item].distance)
        around = range(looked[max(closest - 1, 0)] + 1, looked[min(closest + 1, len(looked) - 1)])
        between = around[:: max(1, len(around) // (2 * _CLOSER))]
        return min((found[closest], *(measured(item) for item in between)), key=lambda near: near.distance)

    def is_nearer(self, positions: NDArray[np.float64], distance: float) -> bool:
        """Whether parts are nearer than a distance [m] in a posture; much faster than `nearest`.

        Args:
            positions: Positions of the commanded joints [rad]. Shape (28,).
            distance: Distance to compare with [m].
        """
        return bool(self._robot.contacts(self._configuration(positions), distance))

    def _configuration(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._robot.configuration(dict(zip(COMMANDED_JOINTS, positions.tolist(), strict=True)))


def _reach(name: str) -> float:
    return next(reach for part, reach in _REACH.items() if part in name)
