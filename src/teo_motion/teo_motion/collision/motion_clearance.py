# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How near parts of the robot come to each other along a motion, between its samples too."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.clearance import Clearance
from teo_description.robot import Robot
from teo_motion.collision.approach_bound import ApproachBound
from teo_motion.sentence.plan import NearestApproach
from teo_motion.trajectory.driver_points import Samples

# Overlaps between two looks are found to within this [m]: parts that are at least so far apart at their
# nearest overlap nowhere.
RESOLUTION = 0.002

# Looks of the first round are this far apart, over what parts at one distance need to meet [1]: at 2 they
# could just meet half way and come back; a little less, so that parts a little nearer need no third look.
_AHEAD = 1.8

# Two looks of the first round are at least this far apart, by that bound [m].
_STEP = 0.1


class MotionClearance:
    """Measures the distances between parts of the robot along a motion."""

    def __init__(self, robot: Robot) -> None:
        """Use a robot, which is not shared with another thread."""
        self._robot = robot
        self._bound = ApproachBound(robot)

    def nearest(self, samples: Samples, *, head_alone: bool = False) -> NearestApproach:
        """The nearest approach of parts along a motion that was found, and no overlap unseen.

        In a first round the distance is measured as seldom as parts need that stay as far apart as they are.
        Then stretches between two looks are halved, each time the one in which
        parts can have come nearest (S. A. Piyavskii's minimum of a function of bounded slope, 1972), until
        none can hold an overlap that is deeper by `RESOLUTION` than what was found.

        Args:
            samples: The motion of the commanded joints.
            head_alone: Whether only pairs with a part of the head are measured.
        """
        motion = _Motion(samples, self._bound.approaches(samples.positions))
        clearance = self._robot.head_clearance if head_alone else self._robot.clearance
        last = float(motion.path[-1])
        looks = [self._look(motion, 0.0, clearance)]
        while looks[-1][0] < last:
            path, near = looks[-1]
            ahead = min(path + max(_AHEAD * near.distance, _STEP), last)
            looks.append(self._look(motion, ahead, clearance))
        closest = min((near for _, near in looks), key=lambda near: near.distance)
        stretches = [(_least(*pair), *pair) for pair in pairwise(looks) if pair[0][0] < pair[1][0]]
        order = [(least, index) for index, (least, _, _) in enumerate(stretches)]
        heapq.heapify(order)
        while order and order[0][0] < min(closest.distance - RESOLUTION, 0.0):
            _, first, second = stretches[heapq.heappop(order)[1]]
            middle = self._look(motion, (first[0] + second[0]) / 2.0, clearance)
            closest = min(closest, middle[1], key=lambda near: near.distance)
            for pair in ((first, middle), (middle, second)):
                heapq.heappush(order, (_least(*pair), len(stretches)))
                stretches.append((_least(*pair), *pair))
        return closest

    def is_nearer(self, positions: NDArray[np.float64], distance: float) -> bool:
        """Whether parts are nearer than a distance [m] in a posture; much faster than `nearest`.

        Args:
            positions: Positions of the commanded joints [rad]. Shape (joints,).
            distance: Distance to compare with [m].
        """
        return bool(self._robot.contacts(self._robot.configurations(positions), distance))

    def distance(self, positions: NDArray[np.float64]) -> float:
        """Least distance between parts in a posture [m].

        Args:
            positions: Positions of the commanded joints [rad]. Shape (joints,).
        """
        return self._robot.clearance(self._robot.configurations(positions)).distance

    @property
    def head_links(self) -> tuple[str, ...]:
        """Links that the head's joints move."""
        return self._robot.humanoid.file.collision.head

    def _look(self, motion: _Motion, path: float, clearance: Callable[[Array], Clearance]) -> _Look:
        time, positions = motion.at(path)
        distance, first, second = clearance(self._robot.configurations(positions))
        return path, NearestApproach(distance=distance, time=time, first=first, second=second)


# How far along its path a motion was looked at [m], and what was found there.
_Look = tuple[float, NearestApproach]


class _Motion:
    """A motion by how far two parts can have approached each other since its beginning."""

    def __init__(self, samples: Samples, approaches: Array) -> None:
        self._samples = samples
        self.path: Array = np.concatenate(([0.0], np.cumsum(approaches)))

    def at(self, path: float) -> tuple[float, Array]:
        """Time [s] and positions [rad] on straight lines between samples, which are a period apart."""
        samples = self._samples
        after = min(max(int(np.searchsorted(self.path, path)), 1), len(self.path) - 1)
        length = self.path[after] - self.path[after - 1]
        share = (path - self.path[after - 1]) / length if length > 0.0 else 1.0
        time = samples.times[after - 1] + share * (samples.times[after] - samples.times[after - 1])
        before = samples.positions[after - 1]
        return float(time), before + share * (samples.positions[after] - before)


def _least(first: _Look, second: _Look) -> float:
    """What the distance between two looks is not below [m]."""
    return (first[1].distance + second[1].distance - (second[0] - first[0])) / 2.0
