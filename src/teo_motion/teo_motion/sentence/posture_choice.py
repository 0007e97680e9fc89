# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which of its postures each sign of a sentence takes: those with the least time between the signs.

A sign may be read as well in several postures (`Sign.alternatives`). What the one before leaves and the one
after wants decides which is the quickest, so that the choice is made over the whole sentence: a shortest path
(Viterbi, IEEE Trans. Inf. Theory 1967) whose steps cost the least time of their slowest joint.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.lexicon import SignedToken
from teo_signs.sign import Sign


def choose_postures(
    signed: Sequence[SignedToken], *, start: Array, end: Array, limits: MotionLimits
) -> tuple[SignedToken, ...]:
    """Give each sign that has alternatives the posture with which the sentence takes least time.

    Args:
        signed: Signs and pauses, in order.
        start: Positions of the commanded joints at the beginning [rad]. Shape (joints,).
        end: The same at the end [rad].
        limits: Limits of the joints, of which velocity, acceleration and jerk count here.

    Returns:
        The same signs; those that had a choice have none left.
    """
    at = [index for index, item in enumerate(signed) if item.sign is not None]
    signs = [sign for item in signed if (sign := item.sign) is not None]
    if not any(sign.alternatives for sign in signs):
        return tuple(signed)
    chosen = list(signed)
    for index, sign, posture in zip(at, signs, shortest_postures(signs, start, end, limits), strict=True):
        if sign.alternatives:
            one = dataclasses.replace(sign, knots=postures_of(sign)[posture], alternatives=())
            chosen[index] = dataclasses.replace(signed[index], sign=one)
    return tuple(chosen)


def shortest_postures(signs: Sequence[Sign], start: Array, end: Array, limits: MotionLimits) -> list[int]:
    """Index in `postures_of` of the posture of each sign with which all together take least time.

    Args:
        signs: In order.
        start: Positions of the commanded joints at the beginning [rad]. Shape (joints,).
        end: The same at the end [rad].
        limits: Limits of the joints.
    """
    if not signs:
        return []
    total = np.zeros(1)
    ends, joints = start[None], limits.names
    origins: list[NDArray[np.intp]] = []
    before: Sign | None = None
    for sign in signs:
        paths = np.stack(postures_of(sign))
        cost = total[:, None] + _least_times(ends, joints, paths[:, 0], sign.joints, limits)
        if before is sign:
            # A doubled letter keeps its posture: another one would be read as a slip between two letters.
            cost[~np.eye(len(paths), dtype=bool)] = np.inf
        origins.append(cost.argmin(axis=0))
        total = cost.min(axis=0) + _strokes(paths, sign, limits)
        ends, joints, before = paths[:, -1], sign.joints, sign
    total = total + _least_times(ends, joints, end[None], limits.names, limits)[:, 0]
    chosen = [int(total.argmin())]
    for origin in reversed(origins[1:]):
        chosen.append(int(origin[chosen[-1]]))
    return chosen[::-1]


def postures_of(sign: Sign) -> tuple[NDArray[np.float64], ...]:
    """All postures in which a sign may be made, its own first. Shape (n, m) each."""
    return (sign.knots, *sign.alternatives)


def _least_times(
    ends: Array, from_joints: Sequence[str], begins: Array, to_joints: Sequence[str], limits: MotionLimits
) -> Array:
    """Least time of the slowest joint that both fix, from each of a postures to each of b [s]. Shape (a, b).

    A joint that one of two signs leaves free waits where nobody knows yet, and counts for nothing.
    """
    where = {name: index for index, name in enumerate(from_joints)}
    both = [(where[name], index) for index, name in enumerate(to_joints) if name in where]
    if not both:
        return np.zeros((len(ends), len(begins)))
    first, second = (list(part) for part in zip(*both, strict=True))
    columns = limits.humanoid.columns(to_joints[index] for index in second)
    between = begins[None][:, :, second] - ends[:, None][:, :, first]
    times: Array = limits.least_times(between, columns).max(axis=2)
    return times


def _strokes(paths: Array, sign: Sign, limits: MotionLimits) -> Array:
    """Least time of the sign itself in each posture, at its joints' greatest speed [s]. Shape (a,)."""
    columns = limits.humanoid.columns(sign.joints)
    needed = (np.abs(np.diff(paths, axis=1)) / limits.velocity[columns]).max(axis=2)
    times: Array = np.maximum(needed, np.diff(sign.times)).sum(axis=1)
    return times
