# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a robot that follows its motion is stopped: the motion goes on to a point a little ahead, and ends."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.seam import LEAST_AHEAD, continued, last_seam
from teo_motion.sentence.plan import Plan, Samples
from teo_motion.trajectory.driver_points import driver_points, point_times
from teo_motion.trajectory.joint_motion import JointMotion, JointMotionBuilder, Pieces, take
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import RuckigSolver

# Points of a motion before the seam that depend on nothing before the motion: see `continued`.
_POINTS_BEFORE_SEAM = 2


class Brake(NamedTuple):
    """A way to a standstill that continues the motion in force within every limit."""

    plan: Plan
    """From the seam to the standstill."""
    samples: Samples
    """What the driver is sent; times count from a period before the seam [s]."""
    ahead: float
    """Path time from now until the robot is to be at the first sample [s]."""


def brake(motion: PathMonitor, following: PathMonitor | None, limits: MotionLimits) -> Brake | None:
    """The way to a standstill of a robot that follows what it was sent.

    Each joint comes to a stand as soon as it can. It leaves its path, but goes no farther than the path,
    which keeps the same limits of acceleration and jerk, and so stays within those of position too.

    Args:
        motion: In force, in path time of now.
        following: What was sent to take over from it, if anything was.
        limits: Of the joints.

    Returns:
        None if the motion comes to its end before it could be changed.
    """
    period = float(motion.motion.times[1])
    ready = LEAST_AHEAD + period
    earliest = motion.elapsed + ready
    if following is not None:
        left = min(-following.elapsed, motion.motion.duration - motion.elapsed)
        if left <= ready + period:  # the motion in force is over before the robot could be told
            motion = following
            earliest = max(motion.elapsed + ready, _POINTS_BEFORE_SEAM * period)
    seam = last_seam(motion.motion, earliest + period)
    if seam >= motion.motion.duration:
        return None
    start = motion.state_at(seam)
    pieces = RuckigSolver(len(limits.names)).brake(start, limits.bounds)
    times = point_times(float(pieces.lengths.sum(axis=1).max()), period)
    braking = [
        _then_still(take(pieces, joint), start.position[joint], float(times[-1]))
        for joint in range(len(limits.names))
    ]
    plan = Plan(
        names=limits.names,
        motions=tuple(braking),
        samples=Samples(times=times, **driver_points(braking, times)._asdict()),
        timings=(),
        stretch=1.0,
    )
    samples = continued(motion.motion, seam, plan)
    return Brake(plan, samples, seam - float(samples.times[1]) - motion.elapsed)


def _then_still(pieces: Pieces, position: float, duration: float) -> JointMotion:
    """One joint's pieces, if any last, from a position [rad] on, and a standstill up to a time [s]."""
    lasting = take(pieces, np.flatnonzero(pieces.lengths > 0.0))
    builder = JointMotionBuilder()
    builder.add(0.0, lasting)
    end = lasting.after(lasting.lengths)[0][-1] if len(lasting.lengths) else position
    builder.hold(float(lasting.lengths.sum()), float(end))
    return builder.build(duration)
