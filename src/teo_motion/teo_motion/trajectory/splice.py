# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Replaces one joint's motion between two times, within the joint's limits."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from teo_motion.trajectory.joint_motion import JointMotion, Pieces, motion_of, take
from teo_motion.trajectory.ruckig_segment import FITS, Bounds, RuckigSolver, State

# A joint with less velocity [rad/s] and acceleration [rad/s^2] stands still: rounding.
_STILL = 1e-9


class StandPoint(NamedTuple):
    """A time at which a joint is at a position with velocity and acceleration zero."""

    time: float
    """[s]."""
    position: float
    """[rad]."""


class Splicer:
    """Changes motions of one joint within its limits."""

    def __init__(self, bounds: Bounds) -> None:
        """Keep to the limits of one joint, of shape (1,)."""
        self._bounds = bounds
        self._solver = RuckigSolver(1)

    def spliced(
        self, motion: JointMotion, begin: float, points: Sequence[StandPoint], end: float
    ) -> JointMotion | None:
        """The motion with another path between two times; position, velocity and acceleration are continuous.

        Args:
            motion: Motion of the joint; it may jump where it is left and where it is met.
            begin: When to leave it [s].
            points: Where to go instead, in order of time, after `begin` and before `end`.
            end: When to be back on it [s].

        Returns:
            The motion; None if the limits leave too little time.
        """
        states = [
            _state(motion, begin, side="left"),
            *(State.still(np.array([point.position])) for point in points),
            _state(motion, end, side="right"),
        ]
        times = [begin, *(point.time for point in points), end]
        inside: list[tuple[float, Pieces]] = []
        for (state, after), (time, later) in zip(pairwise(states), pairwise(times), strict=True):
            pieces = self._move(state, after, later - time)
            if pieces is None:
                return None
            inside.append((time, pieces))
        path = motion_of(inside, end)
        if not self._bounds.allow(path.extremes()):
            return None
        first, last = _part(motion, 0.0, begin), _part(motion, end, motion.duration)
        return motion_of([*first, (begin, path.pieces), *last], motion.duration)

    def _move(self, begin: State, end: State, duration: float) -> Pieces | None:
        segments = self._solver.smooth_segments(begin, end, self._bounds, duration=duration)
        return next((take(segment.pieces, 0) for segment in segments), None)


def shifted(motion: JointMotion, begin: float, end: float, angle: float) -> JointMotion:
    """The motion with an angle [rad] added between two times [s]: its position jumps at both."""
    first, last = _part(motion, 0.0, begin), _part(motion, end, motion.duration)
    return motion_of([*first, *_part(motion, begin, end, angle), *last], motion.duration)


def position_at(motion: JointMotion, time: float, *, side: Literal["left", "right"]) -> float:
    """Position just before ("left") or just after ("right") a time, at which the motion may jump [rad]."""
    return float(_state(motion, time, side=side).position[0])


def rest_after(motion: JointMotion, time: float) -> float:
    """First time at or after `time` with zero velocity, acceleration and jerk [s]; else the motion's end."""
    pieces = motion.pieces
    still = (np.abs(pieces.velocities) < _STILL) & (np.abs(pieces.accelerations) < _STILL)
    begins = motion.starts[still & (pieces.jerks == 0.0)]
    ends = np.append(motion.starts[1:], motion.duration)[still & (pieces.jerks == 0.0)]
    later = ends > time
    return max(float(begins[later][0]), time) if later.any() else motion.duration


def _state(motion: JointMotion, time: float, *, side: Literal["left", "right"]) -> State:
    index = _piece_at(motion, time, side=side)
    # Not beyond the piece: the next one may be turned by an angle.
    elapsed = np.clip(time - motion.starts[index], 0.0, motion.pieces.lengths[index])
    return State(*take(motion.pieces, np.array([index])).after(np.array([elapsed])))


def _piece_at(motion: JointMotion, time: float, *, side: Literal["left", "right"]) -> int:
    """Index of the piece that ends ("left") or begins ("right") at a time, or contains it, up to rounding."""
    nearly = time - FITS if side == "left" else time + FITS
    return max(int(np.searchsorted(motion.starts, nearly, side=side)) - 1, 0)


def _part(motion: JointMotion, begin: float, end: float, angle: float = 0.0) -> list[tuple[float, Pieces]]:
    """What of a motion lies between two times, with an angle added to its positions [rad]; may be nothing."""
    if end <= begin:
        return []
    first = _piece_at(motion, begin, side="right")
    last = max(_piece_at(motion, end, side="left"), first)
    starts = np.concatenate(([begin], motion.starts[first + 1 : last + 1]))
    pieces = take(motion.pieces, np.arange(first, last + 1))
    elapsed = np.zeros(len(starts))
    elapsed[0] = max(begin - motion.starts[first], 0.0)
    positions, velocities, accelerations = pieces.after(elapsed)
    lengths = np.diff(starts, append=end)
    return [(begin, Pieces(lengths, positions + angle, velocities, accelerations, pieces.jerks))]
