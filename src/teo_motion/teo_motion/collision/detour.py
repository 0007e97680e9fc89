# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detours: postures to pass through so that the arms go around the robot's own body."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from teo_common.arrays import Array
from teo_description import COMMANDED_JOINTS
from teo_motion.sentence.composition import ARMS, LIMBS
from teo_motion.sentence.rest_posture import HANGING
from teo_motion.sentence.route import Route
from teo_motion.trajectory.limits import MotionLimits

# What lifts the upper arms sideways, brings them forward, opens the elbows; half way, to pass the body.
_SIDEWAYS = {"SagittalLeftShoulder": 1.0, "SagittalRightShoulder": -1.0}
_FORWARD = {"FrontalLeftShoulder": -1.0, "FrontalRightShoulder": -1.0}
_OPEN = {"FrontalLeftElbow": 1.0, "FrontalRightElbow": 1.0}
# Changes of posture to try, the smallest first [rad].
_CHANGES = (
    (0.25, (_SIDEWAYS,)),
    (0.3, (_FORWARD,)),
    (0.3, (_OPEN,)),
    (0.5, (_SIDEWAYS,)),
    (0.6, (_OPEN,)),
    (0.4, (_SIDEWAYS, _FORWARD)),
    (0.5, (_FORWARD, _OPEN)),
    (0.8, (_SIDEWAYS, _OPEN)),
    (0.9, (_OPEN, _FORWARD, _SIDEWAYS)),
)

# Both hands well in front of the shoulders, out of the way of everything [rad].
_APART = {
    "FrontalLeftShoulder": -0.7,
    "FrontalRightShoulder": -0.7,
    "SagittalLeftShoulder": 0.4,
    "SagittalRightShoulder": -0.4,
    "FrontalLeftElbow": -0.8,
    "FrontalRightElbow": -0.8,
}


def detours(first: Array, middle: Array, second: Array, limits: MotionLimits) -> Iterator[tuple[Array, ...]]:
    """Postures to pass through between two others, the least far out of the way first.

    Arms wider, further in front, hands away from the body; then one arm before the other; then hands apart,
    and from there one arm before the other, which takes any two hands out of each other's way; last the same
    with hanging arms, a posture from which every sign can be reached.

    Args:
        first: Positions at the waypoint before [rad]. Shape (28,).
        middle: Positions half way in time without a detour [rad]. Shape (28,).
        second: Positions at the waypoint after [rad]. Shape (28,).
        limits: Limits of the joints, which the postures keep.
    """
    for angle, directions in _CHANGES:
        yield (_changed(middle, angle, directions, limits),)
    for arm in ARMS:
        yield (_with_arm(first, arm, second),)
    apart, hanging = middle.copy(), middle.copy()
    for arm in ARMS:
        apart[list(LIMBS[arm])] = 0.0
        hanging[list(LIMBS[arm])] = HANGING[list(LIMBS[arm])]
    for name, angle in _APART.items():
        apart[COMMANDED_JOINTS.index(name)] = angle
    for away in (apart, hanging):
        yield (away,)
        for arm in ARMS:
            yield away, _with_arm(away, arm, second)
        for arm in ARMS:
            yield _with_arm(first, arm, away), away
            for later in ARMS:
                yield _with_arm(first, arm, away), away, _with_arm(away, later, second)


def _with_arm(posture: Array, arm: int, other: Array) -> Array:
    """A posture with one arm of another."""
    columns = list(LIMBS[arm])
    mixed = posture.copy()
    mixed[columns] = other[columns]
    return mixed


def _changed(
    posture: Array, angle: float, directions: tuple[dict[str, float], ...], limits: MotionLimits
) -> Array:
    changed = posture.copy()
    for direction in directions:
        for name, sign in direction.items():
            changed[COMMANDED_JOINTS.index(name)] += sign * angle
    kept: Array = np.clip(changed, limits.lower, limits.upper)
    return kept


def with_detour(route: Route, step: int, posture: Array) -> Route:
    """Pass through another posture of the arms half way between two waypoints.

    Args:
        route: The waypoints.
        step: The waypoint before the detour.
        posture: Positions to pass through [rad]; those of the arms are used. Shape (28,).
    """
    row = np.full(len(posture), np.nan)
    columns = [column for arm in ARMS for column in LIMBS[arm]]
    row[columns] = posture[columns]
    return route.with_waypoint(step, row)
