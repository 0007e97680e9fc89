"""Puts another way between two instants of one joint's motion."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from teo_motion.trajectory.joint_motion import JointMotion, JointMotionBuilder, Pieces, take
from teo_motion.trajectory.relaxed_limits import gentle_bounds
from teo_motion.trajectory.ruckig_segment import ROUNDING, Bounds, Mover, State

# A move fits its time when it needs no more than this beyond it [s]: rounding of sums of times.
_FITS = 1e-9

# A joint with less velocity [rad/s] and acceleration [rad/s^2] stands still: rounding.
_STILL = 1e-9

# As in `station_timing`: times the least-jerk quintic's acceleration and jerk; at last what the limits allow.
_EASES = (1.3, 2.0, 4.0, None)


class Knot(NamedTuple):
    """Where a joint stands still for an instant."""

    time: float
    """[s]."""
    position: float
    """[rad]."""


class Splicer:
    """Changes motions of one joint within its limits."""

    def __init__(self, bounds: Bounds) -> None:
        """Keep to the limits of one joint, of shape (1,)."""
        self._bounds = bounds
        self._mover = Mover(1)

    def spliced(
        self, motion: JointMotion, begin: float, knots: Sequence[Knot], end: float
    ) -> JointMotion | None:
        """The motion with another way between two instants, where it is left and met again smoothly.

        Args:
            motion: Motion of the joint; it may jump where it is left and where it is met.
            begin: When to leave it [s].
            knots: Where to go instead, in order of time, after `begin` and before `end`.
            end: When to be back on it [s].

        Returns:
            The motion; None if the limits leave too little time.
        """
        still = np.zeros(1)
        states = [
            _state(motion, begin, side="left"),
            *(
                State(position=np.array([knot.position]), velocity=still, acceleration=still)
                for knot in knots
            ),
            _state(motion, end, side="right"),
        ]
        times = [begin, *(knot.time for knot in knots), end]
        inside = JointMotionBuilder()
        for (state, after), (time, later) in zip(pairwise(states), pairwise(times), strict=True):
            pieces = self._move(state, after, later - time)
            if pieces is None:
                return None
            inside.add(time, pieces)
        way = inside.build(end)
        if not self._keeps_limits(way):
            return None
        whole = JointMotionBuilder()
        _copy(motion, 0.0, begin, whole)
        whole.add(begin, way.pieces)
        _copy(motion, end, motion.duration, whole)
        return whole.build(motion.duration)

    def _move(self, begin: State, end: State, duration: float) -> Pieces | None:
        for ease in _EASES:
            bounds = self._bounds
            if ease is not None:
                bounds = gentle_bounds(begin, end, duration, bounds, ease=ease)
            move = self._mover.move(begin, end, bounds, duration=duration)
            if move is not None and move.duration <= duration + _FITS:
                return take(move.pieces, 0)
        return None

    def _keeps_limits(self, way: JointMotion) -> bool:
        reached, bounds = way.extremes(), self._bounds
        more = 1.0 + ROUNDING
        return bool(
            reached.least >= bounds.lower[0] - ROUNDING
            and reached.greatest <= bounds.upper[0] + ROUNDING
            and reached.velocity <= bounds.velocity[0] * more
            and reached.acceleration <= bounds.acceleration[0] * more
            and reached.jerk <= bounds.jerk[0] * more
        )


def shifted(motion: JointMotion, begin: float, end: float, angle: float) -> JointMotion:
    """The motion with everything between two instants turned by an angle [rad]: it jumps at both."""
    whole = JointMotionBuilder()
    _copy(motion, 0.0, begin, whole)
    _copy(motion, begin, end, whole, angle)
    _copy(motion, end, motion.duration, whole)
    return whole.build(motion.duration)


def position_at(motion: JointMotion, time: float, *, side: Literal["left", "right"]) -> float:
    """Where a joint is just before or just after an instant [rad]."""
    return float(_state(motion, time, side=side).position[0])


def rest_after(motion: JointMotion, time: float) -> float:
    """When a joint first stands still from an instant on [s]; the end of its motion, where it does not."""
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
    """Index of the piece before or after an instant; it may begin or end there but for rounding."""
    nearly = time - _FITS if side == "left" else time + _FITS
    return max(int(np.searchsorted(motion.starts, nearly, side=side)) - 1, 0)


def _copy(
    motion: JointMotion, begin: float, end: float, builder: JointMotionBuilder, angle: float = 0.0
) -> None:
    """Add what a motion does between two instants, turned by an angle."""
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
