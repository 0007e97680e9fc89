# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Replaces one joint's motion between two times, within the joint's limits."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from teo_motion.trajectory.joint_motion import JointMotion, JointMotionBuilder, Pieces, take
from teo_motion.trajectory.ruckig_segment import ROUNDING, Bounds, RuckigSolver, State, relaxed_bounds

# A segment fits its time when it needs no more than this beyond it [s]: rounding of sums of times.
_FITS = 1e-9

# A joint with less velocity [rad/s] and acceleration [rad/s^2] stands still: rounding.
_STILL = 1e-9

# As in `waypoint_timing`: factors on the least-jerk quintic's acceleration and jerk; None is the limits.
_EASES = (1.3, 2.0, 4.0, None)


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
        still = np.zeros(1)
        states = [
            _state(motion, begin, side="left"),
            *(
                State(position=np.array([point.position]), velocity=still, acceleration=still)
                for point in points
            ),
            _state(motion, end, side="right"),
        ]
        times = [begin, *(point.time for point in points), end]
        inside = JointMotionBuilder()
        for (state, after), (time, later) in zip(pairwise(states), pairwise(times), strict=True):
            pieces = self._move(state, after, later - time)
            if pieces is None:
                return None
            inside.add(time, pieces)
        path = inside.build(end)
        if not self._keeps_limits(path):
            return None
        whole = JointMotionBuilder()
        _copy(motion, 0.0, begin, whole)
        whole.add(begin, path.pieces)
        _copy(motion, end, motion.duration, whole)
        return whole.build(motion.duration)

    def _move(self, begin: State, end: State, duration: float) -> Pieces | None:
        for ease in _EASES:
            bounds = self._bounds
            if ease is not None:
                bounds = relaxed_bounds(begin, end, duration, bounds, ease=ease)
            segment = self._solver.segment(begin, end, bounds, duration=duration)
            if segment is not None and segment.duration <= duration + _FITS:
                return take(segment.pieces, 0)
        return None

    def _keeps_limits(self, path: JointMotion) -> bool:
        reached, bounds = path.extremes(), self._bounds
        more = 1.0 + ROUNDING
        return bool(
            reached.least >= bounds.lower[0] - ROUNDING
            and reached.greatest <= bounds.upper[0] + ROUNDING
            and reached.velocity <= bounds.velocity[0] * more
            and reached.acceleration <= bounds.acceleration[0] * more
            and reached.jerk <= bounds.jerk[0] * more
        )


def shifted(motion: JointMotion, begin: float, end: float, angle: float) -> JointMotion:
    """The motion with an angle [rad] added between two times [s]: its position jumps at both."""
    whole = JointMotionBuilder()
    _copy(motion, 0.0, begin, whole)
    _copy(motion, begin, end, whole, angle)
    _copy(motion, end, motion.duration, whole)
    return whole.build(motion.duration)


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
    state = take(motion.pieces, np.array([index])).after(np.array([elapsed]))
    return State(position=state[0], velocity=state[1], acceleration=state[2])


def _piece_at(motion: JointMotion, time: float, *, side: Literal["left", "right"]) -> int:
    """Index of the piece that ends ("left") or begins ("right") at a time, or contains it, up to rounding."""
    nearly = time - _FITS if side == "left" else time + _FITS
    return max(int(np.searchsorted(motion.starts, nearly, side=side)) - 1, 0)


def _copy(
    motion: JointMotion, begin: float, end: float, builder: JointMotionBuilder, angle: float = 0.0
) -> None:
    """Add the part of a motion between two times, with an angle added to its positions [rad]."""
    if end <= begin:
        return
    first = _piece_at(motion, begin, side="right")
    last = max(_piece_at(motion, end, side="left"), first)
    starts = np.concatenate(([begin], motion.starts[first + 1 : last + 1]))
    pieces = take(motion.pieces, np.arange(first, last + 1))
    elapsed = np.zeros(len(starts))
    elapsed[0] = max(begin - motion.starts[first], 0.0)
    entered = pieces.after(elapsed)
    builder.add(
        begin,
        Pieces(
            lengths=np.diff(starts, append=end),
            positions=entered[0] + angle,
            velocities=entered[1],
            accelerations=entered[2],
            jerks=pieces.jerks,
        ),
    )
