# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a robot in motion is brought to a standstill.

One that follows its motion is sent a continuation to a point a little ahead, where it ends. Any other is
told to stop from where joint states show it, several times if need be. A driver that takes none of these
stops is told to stop by itself, on its own path, which it takes whatever the robot does.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from teo_lut_executor.execution.interface import HaltReady, StopReady
from teo_lut_executor.execution.sent_motion import LEAST_AHEAD, SentMotion
from teo_lut_executor.execution.situation import Situation
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.driver_points import Samples, driver_points, point_times
from teo_motion.trajectory.joint_motion import JointMotion, Pieces, motion_of, standing, take
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import RuckigSolver, State
from teo_motion.trajectory.stopping import stop

# How often a stop is sent to a robot that goes on moving: a driver may refuse one when a joint is about to
# reach a limit, and take the next, a third of a second later.
_MOST_STOPS = 5

# Time after the end of a stop at which the next is sent [s].
_STOP_PATIENCE = 0.1

# The robot stands when joint states have shown no movement for this long [s]: ten of them, and as late as a
# stop may come on a busy machine.
_STANDS = 0.1


class Halt:
    """Brings a robot in motion to a standstill, with several stops if one is not taken."""

    def __init__(self, situation: Situation) -> None:
        """Begin with nothing to stop."""
        self._situation = situation
        self._stops = 0
        self._due = self._next = -math.inf  # when it should stand; when it may be told again
        self._owed = False
        self._number = 0  # of the stop that was sent last

    def begin(self) -> None:
        """Expect the robot to stand from now on."""
        self._stops, self._owed = 0, False
        self._due = self._next = self._situation.now

    def owe(self, number: int | None = None) -> None:
        """Stop the robot when it can be told, though it may seem to stand: it has a motion to go on with.

        Args:
            number: Of a stop that the driver did not take; of others' numbers nothing is owed. None: it could
                not be told.
        """
        if number is None or number == self._number:
            self._owed = True

    def shift_clock(self, by: float) -> None:
        """Follow a clock that was set by so much [s]."""
        self._due += by
        self._next += by

    def stop(self, moving: State, number: int) -> list[StopReady | HaltReady]:
        """Stop a robot in this state, if it moves; the motion gets a number."""
        situation = self._situation
        still = situation.robot.is_still and not self._owed
        # A driver that has taken the last stop, and moves the robot, does so for somebody else.
        taken = self._stops == _MOST_STOPS and not self._owed
        if still or taken or not situation.may_be_told:
            return []
        self._stops += 1
        self._owed, self._number = False, number
        end, lead = stop(moving, situation.limits)
        self._due = self._next = situation.now + lead
        if self._stops > _MOST_STOPS:
            return [HaltReady()]
        return [StopReady(number=number, end=end, lead=lead)]

    def expect(self, number: int, duration: float) -> None:
        """Expect the robot to stand in so much time [s], as it was sent a way to that has this number."""
        self._number, self._due = number, self._situation.now + duration

    @property
    def stands(self) -> bool:
        """Whether the robot has come to a standstill."""
        # By joint states of after the stop's end: earlier ones may show it before the stop has reached it.
        still = self._situation.robot.still_since(self._due) >= _STANDS
        return still and not self._situation.is_stale and not self._owed

    @property
    def is_overdue(self) -> bool:
        """Whether the robot should stand, and is to be told again."""
        # Seen after the stop's end, like a standstill: each stop moves a robot that stands already.
        moves = self._situation.robot.oldest > self._due + _STOP_PATIENCE
        return moves or (self._owed and self._situation.now >= self._next)


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


def brake(motion: SentMotion, following: SentMotion | None, limits: MotionLimits) -> Brake | None:
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
    period = float(motion.plan.times[1])
    ready = LEAST_AHEAD + period
    earliest = motion.elapsed + ready
    if following is not None:
        left = min(-following.elapsed, motion.plan.duration - motion.elapsed)
        if left <= ready + period:  # the motion in force is over before the robot could be told
            motion = following
            earliest = max(motion.elapsed + ready, _POINTS_BEFORE_SEAM * period)
    seam = motion.last_seam(earliest + period)
    if seam >= motion.plan.duration:
        return None
    start = motion.plan.at(seam)
    pieces = RuckigSolver(len(limits.names)).brake(start, limits.bounds)
    times = point_times(float(pieces.lengths.sum(axis=1).max()), period)
    braking = [
        _then_still(take(pieces, joint), start.position[joint], float(times[-1]))
        for joint in range(len(limits.names))
    ]
    plan = Plan(
        names=limits.names,
        motions=tuple(braking),
        samples=driver_points(braking, times),
        timings=(),
        stretch=1.0,
    )
    samples = motion.continued(seam, plan)
    return Brake(plan, samples, seam - float(samples.times[1]) - motion.elapsed)


def _then_still(pieces: Pieces, position: float, duration: float) -> JointMotion:
    """One joint's pieces, if any last, from a position [rad] on, and a standstill up to a time [s]."""
    lasting = take(pieces, np.flatnonzero(pieces.lengths > 0.0))
    end = lasting.after(lasting.lengths)[0][-1] if len(lasting.lengths) else position
    stands = (float(lasting.lengths.sum()), standing(np.array(float(end))))
    return motion_of([(0.0, lasting), stands], duration)
