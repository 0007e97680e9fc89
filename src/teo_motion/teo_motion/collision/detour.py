# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detours: postures to pass through so that the arms go around the robot's own body."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from teo_common.arrays import Array
from teo_motion.sentence.composition import ARMS
from teo_motion.sentence.route import Route
from teo_motion.trajectory.limits import MotionLimits

# Changes of posture to try, the smallest first [rad]: upper arms that are lifted sideways or come forward,
# elbows that open.
_CHANGES: tuple[tuple[float, tuple[str, ...]], ...] = (
    (0.25, ("sideways",)),
    (0.3, ("forward",)),
    (0.3, ("open",)),
    (0.5, ("sideways",)),
    (0.6, ("open",)),
    (0.4, ("sideways", "forward")),
    (0.5, ("forward", "open")),
)
_WIDE_CHANGES: tuple[tuple[float, tuple[str, ...]], ...] = (
    (0.8, ("sideways", "open")),
    (0.9, ("open", "forward", "sideways")),
)

# Shares of the way to hands wide apart, which costs time and looks like flying.
_PARTLY = (0.3, 0.5, 0.75)


def detours(first: Array, middle: Array, second: Array, limits: MotionLimits) -> Iterator[tuple[Array, ...]]:
    """Postures to pass through between two others, the least far out of the way first.

    Arms wider, further in front, hands away from the body; hands somewhat apart; arms wide; one arm before
    the other; then hands wide apart, and from there one arm before the other, which takes any two hands out
    of each other's way; last the same with hanging arms, a posture from which every sign can be reached.

    Args:
        first: Positions at the waypoint before [rad]. Shape (joints,).
        middle: Positions half way in time without a detour [rad]. Shape (joints,).
        second: Positions at the waypoint after [rad]. Shape (joints,).
        limits: Limits of the joints, which the postures keep.
    """
    humanoid = limits.humanoid
    left, right = (humanoid.limb_columns[arm] for arm in ARMS)
    for angle, directions in _CHANGES:
        yield (_changed(middle, angle, directions, limits),)
    apart = middle.copy()
    apart[left + right] = 0.0
    apart = humanoid.with_both_arms(apart, humanoid.file.detour.apart_deg)
    partly = [_kept(middle + share * (apart - middle), limits) for share in _PARTLY]
    for away in partly:
        yield (away,)
    for angle, directions in _WIDE_CHANGES:
        yield (_changed(middle, angle, directions, limits),)
    for arm in (left, right):
        yield (_with_columns(first, arm, second),)
    for away in partly:
        yield from _one_arm_first(first, away, second, (left, right))
    for away in (_kept(apart, limits), _with_columns(middle, left + right, humanoid.hanging)):
        yield (away,)
        yield from _one_arm_first(first, away, second, (left, right))
        for arm in (left, right):
            for later in (left, right):
                yield _with_columns(first, arm, away), away, _with_columns(away, later, second)


def _one_arm_first(
    first: Array, away: Array, second: Array, arms: tuple[list[int], list[int]]
) -> Iterator[tuple[Array, ...]]:
    """By way of a posture, to which or from which one arm goes before the other."""
    for arm in arms:
        yield away, _with_columns(away, arm, second)
    for arm in arms:
        yield _with_columns(first, arm, away), away


def _with_columns(posture: Array, columns: list[int], other: Array) -> Array:
    """A posture with some joints of another."""
    mixed = posture.copy()
    mixed[columns] = other[columns]
    return mixed


def _changed(posture: Array, angle: float, directions: tuple[str, ...], limits: MotionLimits) -> Array:
    """A posture with both arms moved in directions of the robot's `Detour`."""
    humanoid, changed = limits.humanoid, posture.copy()
    for direction in directions:
        shares: dict[str, float] = getattr(humanoid.file.detour, direction)
        for name, share in shares.items():
            sides = (name, 1.0), (humanoid.mirrored_name(name), humanoid.mirror_signs((name,))[0])
            for joint, sign in sides:
                changed[limits.names.index(joint)] += sign * share * angle
    return _kept(changed, limits)


def _kept(posture: Array, limits: MotionLimits) -> Array:
    kept: Array = np.clip(posture, limits.lower, limits.upper)
    return kept


def with_detour(route: Route, step: int, posture: Array, arms: list[int]) -> Route:
    """Pass through another posture of the arms half way between two waypoints.

    Args:
        route: The waypoints.
        step: The waypoint before the detour.
        posture: Positions to pass through [rad]. Shape (joints,).
        arms: Columns of the arms, which alone pass through it.
    """
    row = np.full(len(posture), np.nan)
    row[arms] = posture[arms]
    return route.with_waypoint(step, row)
