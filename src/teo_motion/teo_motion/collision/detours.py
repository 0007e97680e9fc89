# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detours between two waypoints: around the robot's own body, and of a thumb around its fingers.

Arms that would touch the body pass through a posture out of the way. On the straight way from one handshape
to the next the thumb may be inside a finger that folds or opens meanwhile. Such a hand passes through another
shape half way: fingers first, thumb first, or the thumb out of the way, whichever takes the least time; or
through two, between which either the fingers move or the thumb does.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise, product

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import TOUCH, HandTable, thumb_gaps
from teo_motion.sentence.composition import ARMS, HANDS, Route
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


_THUMB = 2  # axes of the thumb, the first of a hand

# Shares of the way of the thumb's axes and of the fingers' that may be done half way [1].
_SHARES = (0.0, 0.5, 1.0)

# Handshapes that are looked at on a straight way [1]: every 7 deg of a finger's fold.
_LOOKS = 13

# Ways that are looked at together [1], the quickest first: one of the first few is mostly clear.
_AT_ONCE = 8


def with_clear_thumbs(route: Route, table: HandTable, limits: MotionLimits) -> Route:
    """A route whose hands keep their thumbs out of their fingers between two signs, where a way is known.

    Args:
        route: The waypoints.
        table: Of the robot.
        limits: Limits of the joints.
    """
    rows: dict[int, list[Array]] = {}
    rest = limits.humanoid.hanging
    for limb in HANDS:
        columns = limits.humanoid.limb_columns[limb]
        hands = route.targets[:, columns]
        fixed = np.flatnonzero(~np.isnan(hands).any(axis=1)).tolist()
        for first, last in pairwise(fixed):
            signed = any(route.token_at(step) is not None for step in range(first, last))
            if signed or (hands[first] == hands[last]).all():
                continue
            shapes = _passed(table, hands[first], hands[last], limits.velocity[columns], rest[columns])
            here = rows.setdefault((first + last - 1) // 2, [])
            for index, shape in enumerate(shapes):
                if index == len(here):
                    here.append(np.full(route.targets.shape[1], np.nan))
                here[index][columns] = shape
    for step in sorted(rows, reverse=True):
        for row in reversed(rows[step]):
            route = route.with_waypoint(step, row)
    return route


def _passed(table: HandTable, first: Array, second: Array, speed: Array, rest: Array) -> Array:
    """Handshapes to pass through; none if none are needed, or none keep the thumb clear. Shape (k, axes)."""
    # What an entry has is its own matter: on the way the thumb is no deeper than at either end.
    allowed = min(-TOUCH, float(thumb_gaps(table, np.stack([first, second])).min()))
    for shapes in _ways(first, second, rest):
        count = len(shapes)
        ways = np.concatenate(
            [
                np.broadcast_to(first, (count, 1, len(first))),
                shapes,
                np.broadcast_to(second, (count, 1, len(second))),
            ],
            axis=1,
        )
        times = (np.abs(np.diff(ways, axis=1)) / speed).max(axis=2).sum(axis=1)
        quickest = np.argsort(times, kind="stable")
        for some in np.split(quickest, range(_AT_ONCE, count, _AT_ONCE)):
            clear = _least_gaps(table, ways[some]) >= allowed
            if clear.any():
                found: Array = shapes[some[clear.argmax()]]
                return found
    return np.empty((0, len(first)))


def _ways(first: Array, second: Array, rest: Array) -> Iterator[Array]:
    """What may be passed through, by the number of handshapes: none, one, two. Shapes (n, k, axes)."""
    yield np.empty((1, 0, len(first)))
    thumbs = [
        *(first[:_THUMB] + share * (second - first)[:_THUMB] for share in _SHARES),
        *(
            np.array(thumb)
            for thumb in product((first[0], second[0], rest[0]), (first[1], second[1], rest[1]))
        ),
    ]
    folded, straight = np.minimum(first, second)[_THUMB:], rest[_THUMB:]
    index_straight = np.concatenate((straight[:1], folded[1:]))
    fingers = [
        *(first[_THUMB:] + share * (second - first)[_THUMB:] for share in _SHARES),
        *(folded, index_straight, straight),
    ]
    yield np.array([[np.concatenate(parts)] for parts in product(thumbs, fingers)])
    # The thumb goes while the fingers stay, or they go while it stays.
    ends = (thumbs[0], thumbs[len(_SHARES) - 1])
    pairs = [
        *(((ends[0], shape), (ends[1], shape)) for shape in fingers),
        *(((thumb, fingers[0]), (thumb, fingers[len(_SHARES) - 1])) for thumb in thumbs),
    ]
    yield np.array([[np.concatenate(one), np.concatenate(other)] for one, other in pairs])


def _least_gaps(table: HandTable, ways: Array) -> Array:
    """Least gap of thumb and fingers on straight ways from shape to shape [m]. Shape (n, k, axes), (n,)."""
    shares = np.linspace(0.0, 1.0, _LOOKS)[:, None, None, None]
    shapes = ways[:, :-1] + shares * np.diff(ways, axis=1)
    gaps: Array = thumb_gaps(table, shapes.reshape(-1, ways.shape[2])).reshape(_LOOKS, len(ways), -1)
    least: Array = gaps.min(axis=(0, 2))
    return least
