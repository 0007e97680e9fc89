# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Detours of a thumb around its fingers, between two waypoints.

On the straight way from one handshape to the next the thumb may be inside a finger that folds or opens
meanwhile. Such a hand passes through another shape half way: fingers first, thumb first, or the thumb out of
the way, whichever takes the least time; or through two, between which either the fingers move or the thumb
does.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.hand_geometry import TOUCH, HandTable, thumb_gaps
from teo_motion.sentence.composition import HANDS, Route
from teo_motion.sentence.timing import TimedRoute
from teo_motion.trajectory.limits import MotionLimits

_THUMB = 2  # axes of the thumb, the first of a hand

# Shares of the way of the thumb's axes and of the fingers' that may be done at a shape passed through [1].
_SHARES = (0.0, 0.5, 1.0)

# Handshapes that are looked at on a straight way [1]: every 7 deg of a finger's fold.
_LOOKS = 13

# A thumb that is so much deeper than it may be counts as no deeper [m]: what a table of places is off by.
_SEEN = 1e-4

# Ways that are looked at together [1], the quickest first: one of the first few is mostly clear.
_AT_ONCE = 16

# How far a way is bent away from the straight one, over what is known to be clear [1].
_BENDS = tuple(np.linspace(0.125, 1.0, 8).tolist())


def with_clear_thumbs(route: Route, table: HandTable, limits: MotionLimits) -> Route:
    """A route whose hands keep their thumbs out of their fingers between waypoints, where a way is known.

    Args:
        route: The waypoints.
        table: Of the robot.
        limits: Limits of the joints.
    """
    rows: dict[int, list[Array]] = {}
    rest, targets = limits.humanoid.hanging, route.targets.copy()
    for limb in HANDS:
        columns = limits.humanoid.limb_columns[limb]
        hands = targets[:, columns]
        fixed = np.flatnonzero(~np.isnan(hands).any(axis=1))
        released = _passed_deep(route, hands, fixed, table)
        targets[released[:, None], columns] = np.nan
        fixed = np.setdiff1d(fixed, released)
        steps = np.stack((hands[fixed[:-1]], hands[fixed[1:]]), axis=1)
        through = (steps[:, 0] != steps[:, 1]).any(axis=1)
        through[through] = ~_clear(table, steps[through], _allowed(table, steps[through]))
        for index in np.flatnonzero(through).tolist():
            shapes = _passed(table, steps[index], limits.velocity[columns], rest[columns])
            _put(rows, route, (fixed[index] + fixed[index + 1] - 1) // 2, columns, shapes)
    return _with_rows(replace(route, targets=targets), rows)


def _passed_deep(route: Route, hands: Array, fixed: NDArray[np.intp], table: HandTable) -> NDArray[np.intp]:
    """Waypoints in a sign that a hand passes on its way to another shape, the thumb in a finger."""
    changes = (hands[fixed[1:]] != hands[fixed[:-1]]).any(axis=1)
    passed = fixed[1:-1][changes[1:] & changes[:-1]]
    deep = passed[thumb_gaps(table, hands[passed]) < -TOUCH - _SEEN]
    signed = [(route.token_at(row - 1), route.token_at(row)) for row in deep.tolist()]
    within: NDArray[np.intp] = deep[[before == after is not None for before, after in signed]]
    return within


def with_thumbs_led(timed: TimedRoute, table: HandTable, limits: MotionLimits) -> Route:
    """The route of a motion, whose hands pass half way too wherever they leave it with a thumb in a finger.

    Joints are not at the same share of a way at all times: on a way that is clear the motion may not be.

    Args:
        timed: The route with its motion.
        table: Of the robot.
        limits: Limits of the joints.

    Returns:
        The same route if no thumb is in a finger.
    """
    rows: dict[int, list[Array]] = {}
    route, samples = timed.route, timed.plan.samples
    for limb in HANDS:
        columns = limits.humanoid.limb_columns[limb]
        hands, passed = route.targets[:, columns], samples.positions[:, columns]
        fixed = np.flatnonzero(~np.isnan(hands).any(axis=1))
        moves = np.flatnonzero((passed[1:] != passed[:-1]).any(axis=1))
        at = np.searchsorted(timed.times[fixed[1:-1]], samples.times[moves], side="right")
        steps = np.stack((hands[fixed[:-1]], hands[fixed[1:]]), axis=1)
        deep = thumb_gaps(table, passed[moves]) < _allowed(table, steps)[at] - _SEEN
        for index in np.unique(at[deep]).tolist():
            step = (fixed[index] + fixed[index + 1] - 1) // 2
            _put(rows, route, step, columns, steps[index].mean(axis=0, keepdims=True))
    return _with_rows(route, rows)


def _put(rows: dict[int, list[Array]], route: Route, step: int, columns: list[int], shapes: Array) -> None:
    """Have a hand pass through shapes after a waypoint, beside what the other one does there."""
    here = rows.setdefault(step, [])
    for index, shape in enumerate(shapes):
        if index == len(here):
            here.append(np.full(route.targets.shape[1], np.nan))
        here[index][columns] = shape


def _with_rows(route: Route, rows: Mapping[int, Sequence[Array]]) -> Route:
    for step in sorted(rows, reverse=True):
        for row in reversed(rows[step]):
            route = route.with_waypoint(step, row)
    return route


def _passed(table: HandTable, ends: Array, speed: Array, rest: Array) -> Array:
    """Handshapes to pass through; none if none are known that keep the thumb clear. Shape (k, axes)."""
    first, second = ends
    allowed = float(_allowed(table, ends))
    shapes = _shapes(first, second, rest)
    shapes = shapes[thumb_gaps(table, shapes) >= allowed - _SEEN]
    found = _quickest(table, _whole(first, shapes[:, None], second), speed, allowed)
    if not len(found):
        reached, leaves = (
            shapes[_clear(table, np.stack(np.broadcast_arrays(shapes, end), axis=1), allowed)]
            for end in (first, second)
        )
        pairs = np.stack(np.broadcast_arrays(reached[:, None], leaves[None]), axis=2)
        pairs = pairs.reshape(-1, 2, len(first))
        found = _quickest(table, _whole(first, pairs, second), speed, allowed)
    bent = [_bent(table, way, speed, allowed) for way in found]
    return min(bent, key=lambda way: float(_times(way[None], speed).sum()))[1:-1] if bent else ends[:0]


def _quickest(table: HandTable, ways: Array, speed: Array, allowed: float) -> Array:
    """Some clear ones of the ways that take least time. Shapes (n, k, axes), (m, k, axes)."""
    quickest = np.argsort(_times(ways, speed).sum(axis=1), kind="stable")
    for some in np.split(quickest, range(_AT_ONCE, len(ways), _AT_ONCE)):
        clear = some[_clear(table, ways[some], allowed)]
        if clear.size:
            break
    return ways[clear]


def _shapes(first: Array, second: Array, rest: Array) -> Array:
    """Handshapes that may be passed through. Shape (n, axes)."""
    share = np.array(_SHARES)[:, None]
    between = first + share * (second - first)
    thumbs = [
        *between[:, :_THUMB],
        *(
            np.array(thumb)
            for thumb in product((first[0], second[0], rest[0]), (first[1], second[1], rest[1]))
        ),
    ]
    straight = rest[_THUMB:]
    fingers = [*between[:, _THUMB:], straight]
    for bent in (np.minimum(first, second)[_THUMB:], np.maximum(first, second)[_THUMB:]):
        fingers += [bent, np.concatenate((straight[:1], bent[1:]))]
    return np.unique([np.concatenate(parts) for parts in product(thumbs, fingers)], axis=0)


def _bent(table: HandTable, way: Array, speed: Array, allowed: float) -> Array:
    """A clear way, as near the straight one as the thumb allows. Shape (k, axes)."""
    passed = np.cumsum(_times(way[None], speed)[0])
    straight = way[0] + (passed[:-1] / passed[-1])[:, None] * (way[-1] - way[0])
    bends = straight + np.array(_BENDS)[:, None, None] * (way[1:-1] - straight)
    ways = _whole(way[0], bends, way[-1])
    nearest: Array = ways[_clear(table, ways, allowed).argmax()]
    return nearest


def _whole(first: Array, ways: Array, second: Array) -> Array:
    """Ways with their ends. Shapes (axes,), (n, k, axes), (axes,); the result (n, k + 2, axes)."""
    ends = np.broadcast_to(np.stack((first, second))[:, None, None], (2, len(ways), 1, len(first)))
    return np.concatenate((ends[0], ways, ends[1]), axis=1)


def _times(ways: Array, speed: Array) -> Array:
    """Least time from shape to shape [s]. Shapes (n, k, axes), (axes,); the result (n, k - 1)."""
    times: Array = (np.abs(np.diff(ways, axis=1)) / speed).max(axis=2)
    return times


def _allowed(table: HandTable, ends: Array) -> Array:
    """Least gap of thumb and fingers that a way may have: on it they are no deeper than at either end [m].

    What an entry has is its own matter. Shape (..., 2, axes).
    """
    gaps = thumb_gaps(table, ends.reshape(-1, ends.shape[-1])).reshape(ends.shape[:-1])
    allowed: Array = np.minimum(-TOUCH, gaps.min(axis=-1))
    return allowed


def _clear(table: HandTable, ways: Array, allowed: float | Array) -> NDArray[np.bool_]:
    """Whether straight ways from shape to shape keep thumb and fingers apart. Shape (n, k, axes)."""
    shares = np.linspace(0.0, 1.0, _LOOKS)[:, None, None, None]
    shapes = ways[:, :-1] + shares * np.diff(ways, axis=1)
    gaps = thumb_gaps(table, shapes.reshape(-1, ways.shape[2])).reshape(_LOOKS, *ways[:, 1:, 0].shape)
    clear: NDArray[np.bool_] = gaps.min(axis=(0, 2)) >= allowed - _SEEN
    return clear
