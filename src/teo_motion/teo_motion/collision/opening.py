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
from teo_motion.sentence.plan import Plan, Samples, sample_at
from teo_motion.trajectory.driver_points import driver_points, point_times
from teo_motion.trajectory.joint_motion import JointMotion, JointMotionBuilder, take
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.relaxed_limits import relaxed_bounds
from teo_motion.trajectory.ruckig_segment import ROUNDING, Bounds, RuckigSegment, RuckigSolver, State
from teo_motion.trajectory.stopping import stop

# Parts of the robot keep so much more than their least distance during an opening [m]: postures are looked at
# every `_LOOK` seconds, between which a hand of a robot that only begins to move goes about so far.
_MARGIN = 0.01
_LOOK = 0.04

# As in `waypoint_timing`: factors on the least-jerk quintic's acceleration and jerk.
_EASES = (1.3, 2.0, 4.0)

# A segment fits its time when it needs no more than this beyond it [s]: rounding of sums of times.
_FITS = 1e-9

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
    still = np.zeros_like(first)
    solver = RuckigSolver(len(first))
    way = _eased(solver, start, State(position=first, velocity=still, acceleration=still), bounds, 0.0)
    if way is None:
        return None
    lasting = min(lasting, _MOST_OF_THE_WAY * way.duration)
    leaves = _state(_motions([(0.0, way)], way.duration), lasting)
    end, time = stop(leaves, limits)
    halt = _eased(solver, leaves, end, bounds, time)
    if halt is None:
        return None
    # The robot stands still for a period more, as before any motion: see `driver_points`.
    taken_over = period + lasting
    times = point_times(taken_over + halt.duration, period)
    motions = _motions([(period, way), (taken_over, halt)], float(times[-1]))
    looks = np.arange(0.0, times[-1] + _LOOK, _LOOK)
    if not _keeps_limits(motions, bounds) or _touches(
        sample_at(motions, looks).positions, motion_clearance, least_clearance + _MARGIN
    ):
        return None
    samples = Samples(times=times, **driver_points(motions, times)._asdict())
    return Plan(names=limits.names, motions=motions, samples=samples, timings=(), stretch=1.0), taken_over


def _eased(
    solver: RuckigSolver, begin: State, end: State, bounds: Bounds, duration: float
) -> RuckigSegment | None:
    """The smoothest segment that takes the shortest time, or a given longer one [s]."""
    fastest = solver.segment(begin, end, bounds, duration=duration)
    if fastest is None:
        return None
    for ease in _EASES:
        eased = relaxed_bounds(begin, end, fastest.duration, bounds, ease=ease)
        segment = solver.segment(begin, end, eased, duration=fastest.duration)
        if segment is not None and segment.duration <= fastest.duration + _FITS:
            return segment
    return fastest


def _motions(parts: list[tuple[float, RuckigSegment]], duration: float) -> tuple[JointMotion, ...]:
    """Segments, each from a time on [s], as the motion of every joint, still before and after."""
    joints = len(parts[0][1].pieces.lengths)
    builders = [JointMotionBuilder() for _ in range(joints)]
    for index, (begin, segment) in enumerate(parts):
        until = parts[index + 1][0] if index + 1 < len(parts) else begin + segment.duration
        for joint, builder in enumerate(builders):
            pieces = take(segment.pieces, joint)
            starts = np.cumsum(pieces.lengths) - pieces.lengths
            if index == 0 and begin > 0.0:
                builder.hold(0.0, float(pieces.positions[0]))
            builder.add(begin, take(pieces, np.flatnonzero(starts < until - begin)))
            if index == len(parts) - 1:
                builder.hold(until, float(pieces.after(pieces.lengths)[0][-1]))
    return tuple(builder.build(duration) for builder in builders)


def _state(motions: tuple[JointMotion, ...], time: float) -> State:
    found = sample_at(motions, np.array([time]))
    return State(
        position=found.positions[0].copy(),
        velocity=found.velocities[0].copy(),
        acceleration=found.accelerations[0].copy(),
    )


def _keeps_limits(motions: tuple[JointMotion, ...], bounds: Bounds) -> bool:
    more = 1.0 + ROUNDING
    return all(
        reached.least >= bounds.lower[joint] - ROUNDING
        and reached.greatest <= bounds.upper[joint] + ROUNDING
        and reached.velocity <= bounds.velocity[joint] * more
        and reached.acceleration <= bounds.acceleration[joint] * more
        and reached.jerk <= bounds.jerk[joint] * more
        for joint, reached in enumerate(motion.extremes() for motion in motions)
    )


def _touches(postures: Array, motion_clearance: MotionClearance | None, distance: float) -> bool:
    return motion_clearance is not None and any(
        motion_clearance.is_nearer(posture, distance) for posture in postures
    )
