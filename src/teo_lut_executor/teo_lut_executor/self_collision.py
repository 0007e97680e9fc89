"""How near parts of the robot come to each other along a motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_description import COMMANDED_JOINTS
from teo_description.robot import Robot
from teo_lut_executor.plan import Nearness, Samples

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

# Two looks are at least this far apart, as a bound of how far parts can have moved meanwhile [m]. The bound
# adds up all joints as if each moved the farthest point in one direction; the real motion is about a third.
_STEP = 0.06


class SelfCollision:
    """Looks along a motion at the distances between parts of the robot."""

    def __init__(self, robot: Robot) -> None:
        """Use a robot, which is not shared with another thread."""
        self._robot = robot
        self._reach = np.array([_reach(name) for name in COMMANDED_JOINTS])

    def nearest(self, samples: Samples) -> Nearness:
        """The closest that parts come along a motion.

        The next look is taken where the parts can have moved by the distance that the last one found, and at
        least by a step: far from contact the robot is looked at seldom, near to it at every few millimetres.
        """
        moved = np.abs(np.diff(samples.positions, axis=0)) @ self._reach
        path = np.concatenate(([0.0], np.cumsum(moved)))
        found: Nearness | None = None
        index, last = 0, len(path) - 1
        while True:
            distance, first, second = self._robot.clearance(self._configuration(samples.positions[index]))
            if found is None or distance < found.distance:
                time = float(samples.times[index])
                found = Nearness(distance=float(distance), time=time, first=first, second=second)
            if index == last:
                return found
            following = int(np.searchsorted(path, path[index] + max(distance, _STEP)))
            index = min(max(following, index + 1), last)

    def _configuration(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._robot.configuration(dict(zip(COMMANDED_JOINTS, positions.tolist(), strict=True)))


def _reach(name: str) -> float:
    return next(reach for part, reach in _REACH.items() if part in name)
