# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detours of the arms around the robot's own body: ways between two postures on which nothing touches.

They are found by RRT-Connect (J. J. Kuffner and S. M. LaValle, RRT-Connect: an efficient approach to
single-query path planning, ICRA 2000) in OMPL, and shortened. The same postures give the same ways.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import permutations

import numpy as np
import ompl.base
import ompl.geometric
import ompl.util

from teo_common.arrays import Array
from teo_motion.sentence.composition import ARMS
from teo_motion.trajectory.limits import MotionLimits

# A way stays within so much of its two ends in every joint [rad]: 30 deg, what hands need to pass each other;
# then the double, for elbows that have to come round the body.
_NEAR, _FAR = 0.5, 1.0

# Postures that a search may look at [1]: a way that exists is mostly found in a quarter of them, a third of a
# second on one core.
_LOOKS = 6_000

# The trees grow by so much at once, in all joints together, and are looked at so often on the way [rad].
_GROWTH, _LOOK = 0.3, 0.05

# OMPL says on standard output what it does, which is not for the log of a node.
ompl.util.setLogLevel(ompl.util.LOG_NONE)


def arm_detours(
    first: Array, second: Array, limits: MotionLimits, touches: Callable[[Array], bool]
) -> Iterator[tuple[Array, ...]]:
    """Postures to pass through between two others, of the arms that move at once or one by one, or of both.

    What else moves is at the share of its way at which the arms are.

    Args:
        first: Positions before [rad]. Shape (joints,).
        second: Positions after [rad]. Shape (joints,).
        limits: Limits of the joints, which the postures keep.
        touches: Whether parts of the robot are too near in a posture; they are not in these two.
    """
    left, right = (limits.humanoid.limb_columns[arm] for arm in ARMS)
    moving = [arm for arm in (left, right) if not np.allclose(first[arm], second[arm])]
    for room in (_NEAR, _FAR):
        if len(moving) == 1:
            yield from _way(first, second, moving[0], limits, touches, room)
        yield from _way(first, second, left + right, limits, touches, room)
        for one, other in permutations(moving) if len(moving) == 2 else ():
            between = (first + second) / 2.0
            between[one], between[other] = second[one], first[other]
            for before in _way(first, between, one, limits, touches, room):
                for after in _way(between, second, other, limits, touches, room):
                    yield *before, between, *after


def _way(
    first: Array,
    second: Array,
    arms: Sequence[int],
    limits: MotionLimits,
    touches: Callable[[Array], bool],
    room: float,
) -> Iterator[tuple[Array, ...]]:
    """The postures of a way on which the joints of some arms move; nothing if none was found."""
    columns, whole = list(arms), second - first
    span = whole[columns]
    length, looks = float(span @ span), 0

    def posture(state: Sequence[float] | ompl.base.State) -> Array:
        at = np.array([state[index] for index in range(len(columns))])
        share = np.clip((at - first[columns]) @ span / length, 0.0, 1.0) if length > 0.0 else 1.0
        row: Array = first + share * whole
        row[columns] = at
        return row

    def is_valid(state: ompl.base.State) -> bool:
        nonlocal looks
        looks += 1
        return not touches(posture(state))

    ends = np.stack((first[columns], second[columns]))
    if any(touches(posture(end)) for end in ends):  # the search would wait for others
        return
    least, most = ends.min(axis=0), ends.max(axis=0)
    bounds = ompl.base.RealVectorBounds(len(columns))
    for index, column in enumerate(columns):
        # An end may be a hair beyond a limit.
        bounds.setLow(index, float(min(least[index], max(least[index] - room, limits.lower[column]))))
        bounds.setHigh(index, float(max(most[index], min(most[index] + room, limits.upper[column]))))
    space = ompl.base.RealVectorStateSpace(len(columns))
    space.setBounds(bounds)
    ompl.util.RNG.setSeed(1)
    setup = ompl.geometric.SimpleSetup(space)
    setup.setStateValidityChecker(is_valid)
    setup.getSpaceInformation().setStateValidityCheckingResolution(_LOOK / space.getMaximumExtent())
    begin, end = space.allocState(), space.allocState()
    for index, (start, goal) in enumerate(ends.T.tolist()):
        begin[index], end[index] = start, goal
    setup.setStartAndGoalStates(begin, end)
    planner = ompl.geometric.RRTConnect(setup.getSpaceInformation())
    planner.setRange(_GROWTH)
    setup.setPlanner(planner)
    setup.solve(ompl.base.PlannerTerminationCondition(lambda: looks > _LOOKS))
    if not setup.haveExactSolutionPath():
        return
    path, simplifier = setup.getSolutionPath(), setup.getPathSimplifier()
    simplifier.reduceVertices(path)
    simplifier.partialShortcutPath(path)
    simplifier.reduceVertices(path)
    yield tuple(map(posture, path.getStates()[1:-1]))
