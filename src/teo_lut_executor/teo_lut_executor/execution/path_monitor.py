# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether the robot does what it was sent."""

from __future__ import annotations

from dataclasses import dataclass

from teo_lut_executor.execution.events import QueueSettings
from teo_lut_executor.execution.robot_state import RobotState
from teo_motion.sentence.plan import Plan
from teo_signs.errors import PlanError


@dataclass(kw_only=True, eq=False)
class PathMonitor:
    """Compares a motion that was sent with the joint states.

    Attributes:
        motion: What was sent.
        started: When the robot is to be at its first sample [s].
        settings: What counts as followed and reached.
    """

    motion: Plan
    started: float
    settings: QueueSettings
    _away_since: float | None = None

    def elapsed(self, now: float) -> float:
        """Time since the start [s]; negative before it."""
        return now - self.started

    def shift_clock(self, by: float) -> None:
        """Follow a clock that was set by so much [s]."""
        self.started += by
        if self._away_since is not None:
            self._away_since += by

    def is_reached(self, robot: RobotState) -> bool:
        """Whether joint states of after the end show the robot there, at rest."""
        # A robot a little late is within the tolerance, but still moving: no start for the next motion.
        if self.elapsed(robot.oldest) < self.motion.duration or not robot.is_still:
            return False
        return robot.farthest(self.motion.positions[-1])[0] <= self.settings.goal_tolerance

    def problem(self, robot: RobotState, now: float) -> PlanError | None:
        """What is wrong ("not_followed" or "not_reached"); None while all may still be well."""
        if self.elapsed(now) < self.motion.duration:
            return self._path_problem(robot, now)
        if self.elapsed(now) <= self.motion.duration + self.settings.goal_time:
            return None
        found = "no joint states since"
        if self.elapsed(robot.oldest) >= self.motion.duration:
            distance, joint = robot.farthest(self.motion.positions[-1])
            found = f"{joint} {distance:.3f} rad away from it" + ("" if robot.is_still else ", moving")
        patience = self.settings.goal_time
        message = f"expected every joint at rest {patience:g} s after the end, got {found}"
        return PlanError("not_reached", message)

    def _path_problem(self, robot: RobotState, now: float) -> PlanError | None:
        seen = self.elapsed(robot.oldest)
        if seen < 0.0:
            return None  # nothing was heard of the robot since
        distance, joint = robot.farthest(self.motion.at(seen)[0])
        if distance <= self.settings.path_tolerance:
            self._away_since = None
            return None
        if self._away_since is None:
            self._away_since = now
        if now - self._away_since <= self.settings.path_time:
            return None
        return PlanError(
            "not_followed",
            f"expected the robot within {self.settings.path_tolerance:g} rad of the plan, got {joint} "
            f"{distance:.3f} rad away for {self.settings.path_time:g} s: see what the driver says",
        )
