# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A motion that was sent to the driver: whether the robot follows it, and how another one continues it.

What a driver is sent passes a motion at a small distance (see `driver_points`), by where the motion is a
period before and after. A continuation that began with points of its own would thus begin a little beside
the points in force, and a driver makes that good within one period, at several times the limit of jerk.
Instead both motions, one up to the seam and the other from there on, are made points of together. In the
period before the seam these depend already on what comes after it, and before that they are those in force:
the continuation is sent to begin there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from teo_lut_executor.execution.interface import QueueSettings
from teo_lut_executor.execution.situation import RobotState
from teo_motion.sentence.plan import Plan, sample_at
from teo_motion.trajectory.driver_points import Samples, spline_points
from teo_signs.errors import PlanError

# With less time than this the driver might get a continuation too late [s]: a period of points, and the
# message's way.
LEAST_AHEAD = 0.07

# Times of points are products, those of signs are sums: so much apart they are the same [s].
_ROUNDING = 1e-9

# The driver's own path time is taken where it differs from ours by less than this [s]: more, and it speaks of
# another trajectory, the one before ours or one of somebody else.
_SAME_TRAJECTORY = 0.5

# A motion that begins when the driver has it is expected to have begun after this long [s]: a message was
# 0.6 s on its way on two cores with a load of twenty.
_DEPARTURE = 2.0


@dataclass(kw_only=True, eq=False)
class SentMotion:
    """A motion that was sent, compared with the joint states.

    Times along the motion are the driver's path time: it runs slower than the clock, or stands still, while
    the driver is told to go slowly or to pause.

    Attributes:
        number: Names the motion.
        plan: What was sent.
        elapsed: Path time since its first sample [s]; negative before it.
        settings: What counts as followed and reached.
        awaited: Whether it begins as soon as the driver has it, and the driver has not told yet that it has.
    """

    number: int
    plan: Plan
    elapsed: float
    settings: QueueSettings
    awaited: bool = False
    _leapt: float = 0.0  # see `leap`
    _away_for: float = 0.0
    _was_away: bool = False

    def advance(self, duration: float) -> None:
        """Let path time pass [s]."""
        self.elapsed += duration
        if self._was_away:
            self._away_for += duration

    def leap(self, duration: float) -> None:
        """So much path time has passed [s] if this process was held up, and none if the clock was set.

        The driver's next word tells which.
        """
        self._leapt += duration

    def end_leap(self) -> None:
        """The driver executes nothing: if it had this motion, it is over."""
        if not self.awaited:
            self.elapsed = max(self.elapsed, min(self.elapsed + self._leapt, self.plan.duration))
            self._leapt = 0.0

    def synchronise(self, remaining: float) -> None:
        """Take the driver's word for the path time that is left to the end [s]."""
        elapsed = self.plan.duration - remaining
        longest = math.inf if self.awaited else _SAME_TRAJECTORY
        for ours in (self.elapsed, self.elapsed + self._leapt):
            if -_SAME_TRAJECTORY < ours - elapsed < longest:
                self.elapsed, self.awaited, self._leapt = elapsed, False, 0.0
                return

    def is_reached(self, robot: RobotState, age: float) -> bool:
        """Whether joint states of after the end show the robot there, at rest.

        Args:
            robot: The joint states.
            age: Of the oldest of them, in path time [s].
        """
        # A robot a little late is within the tolerance, but still moving: no start for the next motion.
        if self.elapsed - age < self.plan.duration or not robot.is_still:
            return False
        return robot.farthest(self.plan.positions[-1])[0] <= self.settings.goal_tolerance

    def problem(self, robot: RobotState, age: float) -> PlanError | None:
        """What is wrong ("not_followed" or "not_reached"); None while all may still be well."""
        if self.elapsed < self.plan.duration:
            return self._path_problem(robot, self.elapsed - age)
        if self.elapsed <= self.plan.duration + self.settings.goal_time:
            return None
        found = "no joint states since"
        if self.elapsed - age >= self.plan.duration:
            distance, joint = robot.farthest(self.plan.positions[-1])
            found = f"{joint} {distance:.3f} rad away from it" + ("" if robot.is_still else ", moving")
        patience = self.settings.goal_time
        message = f"expected every joint at rest {patience:g} s after the end, got {found}"
        return PlanError("not_reached", message)

    def _path_problem(self, robot: RobotState, seen: float) -> PlanError | None:
        if seen < 0.0 or (self.awaited and self.elapsed < _DEPARTURE):
            return None  # nothing was heard of the robot since
        # A driver that waits for a processor is late on its path, and follows it.
        late = seen - self.settings.path_time
        first, last = np.searchsorted(self.plan.times, (late, seen))
        distance, joint = min(robot.farthest(where) for where in self.plan.positions[first : last + 1])
        self._was_away = distance > self.settings.path_tolerance
        if not self._was_away:
            self._away_for = 0.0
        if self._away_for <= self.settings.path_time:
            return None
        return PlanError(
            "not_followed",
            f"expected the robot within {self.settings.path_tolerance:g} rad of the plan, got {joint} "
            f"{distance:.3f} rad away for {self.settings.path_time:g} s: see what the driver says",
        )

    def last_seam(self, time: float) -> float:
        """The last time up to another at which the motion may be continued: that of a point of it [s]."""
        return float(self.plan.times[np.searchsorted(self.plan.times, time + _ROUNDING) - 1])

    def continued(self, seam: float, continuation: Plan) -> Samples:
        """What the driver is sent of a motion that continues this one.

        Args:
            seam: When the continuation takes over [s], as `last_seam` found it.
            continuation: The motion from there on, planned with the same period from the state there.

        Returns:
            The continuation's samples behind one more, a period before the seam; times count from that one.
        """
        period = float(continuation.times[1])
        before = sample_at(self.plan.motions, np.array([seam - 2.0 * period, seam - period])).positions
        after = sample_at(continuation.motions, np.array([0.0, period])).positions
        seams = spline_points(np.concatenate((before, after)), np.array([0.0, period]))
        later = continuation.samples._replace(times=continuation.times + period)
        parts = zip(seams, later, strict=True)
        return Samples(*(np.concatenate((first, then[1:])) for first, then in parts))
