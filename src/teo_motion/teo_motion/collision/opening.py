# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The first motion of a sentence, known at once: some way towards its first sign, from which it can stop.

Planning a whole sentence takes many times as long as it takes to see that the arms may begin to rise. The
plan of the sentence takes over while they do.
"""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_motion.collision.motion_clearance import MotionClearance
from teo_motion.sentence.composition import Composition
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.driver_points import point_times, spline_points
from teo_motion.trajectory.joint_motion import JointMotion, Pieces, begins, in_a_row, standing, take
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import Bounds, RuckigSegment, RuckigSolver, State
from teo_motion.trajectory.stopping import stop

# Parts of the robot keep so much more than their least distance during an opening [m]: postures are looked at
# every `_LOOK` seconds, between which a hand of a robot that only begins to move goes about so far.
_MARGIN = 0.01
_LOOK = 0.04

# Where the whole plan is to take over, at most this share of the way to the first sign has passed [1]: the
# robot still speeds up, and a detour has room.
_MOST_OF_THE_WAY = 0.4

# A first sign nearer than this needs no opening [rad]: it is reached in a quarter of a second.
_LEAST_WAY = 0.05


def opening(
    composition: Composition,
    *,
    limits: MotionLimits,
    period: float,
    lasting: float,
    motion_clearance: MotionClearance | None,
    least_clearance: float,
) -> tuple[Plan, float] | None:
    """Go towards the first sign for a while, and stop.

    Args:
        composition: The sentence, from a robot that stands still.
        limits: Limits of the joints.
        period: Time between two samples [s].
        lasting: Time before it slows down [s]; less where the first sign is near.
        motion_clearance: Distances between parts of the robot; None looks at none.
        least_clearance: Distance that parts of the robot keep [m].

    Returns:
        The motion, and the time until which it goes on at full pace [s]; None if there is no such motion that
        is safe, or none is needed.
    """
    bounds = limits.bounds
    start = composition.start
    first = np.where(np.isnan(composition.targets[1]), start.position, composition.targets[1])
    if np.abs(first - start.position).max() < _LEAST_WAY:
        return None
    solver = RuckigSolver(len(first))
    way = _eased(solver, start, State.still(first), bounds, 0.0)
    if way is None:
        return None
    # A whole number of periods: a motion is continued at one of its points.
    lasting = period * np.floor(min(lasting, _MOST_OF_THE_WAY * way.duration) / period)
    leaves = _state_after(way.pieces, lasting)
    end, time = stop(leaves, limits)
    # All joints stop at one time: those that would pass the first sign meanwhile stop at it.
    low, high = np.minimum(start.position, first), np.maximum(start.position, first)
    end = end._replace(position=np.clip(end.position, low, high))
    halt = _eased(solver, leaves, end, bounds, time)
    if halt is None:
        return None
    # The robot stands still for a period more, as before any motion: see `driver_points`.
    taken_over = period + lasting
    times = point_times(taken_over + halt.duration, period)
    motion = in_a_row(
        (
            _standing(start.position, period),
            _first_part(way.pieces, lasting),
            halt.pieces,
            _standing(end.position, float(times[-1]) - taken_over - halt.duration),
        )
    )
    looks = np.arange(0.0, times[-1] + _LOOK, _LOOK)
    if not bounds.allow(motion.extremes()) or _touches(
        _positions(motion, looks), motion_clearance, least_clearance + _MARGIN
    ):
        return None
    # Before its beginning and after its end it stands still.
    controls = _positions(motion, np.concatenate((times[:1] - period, times, times[-1:] + period)))
    samples = spline_points(controls, times)
    plan = Plan(names=limits.names, motions=_of_each(motion), samples=samples, timings=(), stretch=1.0)
    return plan, taken_over


def _eased(
    solver: RuckigSolver, begin: State, end: State, bounds: Bounds, duration: float
) -> RuckigSegment | None:
    """The smoothest segment that takes the shortest time, or a given longer one [s]."""
    fastest = solver.segment(begin, end, bounds, duration=duration)
    if fastest is None:
        return None
    return next(solver.smooth_segments(begin, end, bounds, duration=fastest.duration), fastest)


def _standing(position: Array, duration: float) -> Pieces:
    """All joints stand still for a time [s]. Shape (m, 1)."""
    return standing(position)._replace(lengths=np.full((len(position), 1), duration))


def _first_part(pieces: Pieces, duration: float) -> Pieces:
    """What of the pieces lies within a first time [s]; the others have no length any more."""
    return pieces._replace(lengths=np.clip(duration - begins(0.0, pieces), 0.0, pieces.lengths))


def _after(pieces: Pieces, times: Array) -> tuple[Array, Array, Array]:
    """Position, velocity and acceleration of all joints at given times, of the ends beyond. Shape (m, n)."""
    ends = np.cumsum(pieces.lengths, axis=1)
    index = (times[:, None] >= ends[:, None, :-1]).sum(axis=2)
    row = np.arange(len(ends))[:, None]
    at = take(pieces, (row, index))
    return at.after(np.clip(times - (ends[row, index] - at.lengths), 0.0, at.lengths))


def _positions(pieces: Pieces, times: Array) -> Array:
    """Positions at given times. Shape (n, m)."""
    return np.ascontiguousarray(_after(pieces, times)[0].T)


def _state_after(pieces: Pieces, time: float) -> State:
    return State(*(values[:, 0] for values in _after(pieces, np.array([time]))))


def _of_each(pieces: Pieces) -> tuple[JointMotion, ...]:
    """The motion of each joint."""
    starts = begins(0.0, pieces)
    return tuple(
        JointMotion(starts=starts[joint, lasting], pieces=take(pieces, (joint, lasting)))
        for joint, lasting in enumerate(pieces.lengths > 0.0)
    )


def _touches(postures: Array, motion_clearance: MotionClearance | None, distance: float) -> bool:
    return motion_clearance is not None and any(
        motion_clearance.is_nearer(posture, distance) for posture in postures
    )
