# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences in their order, one at a time, from rest to rest. Knows neither ROS nor how they are planned.

Every call takes the time and returns what is to be done, in order; `PlanWanted` and `ReturnWanted` are
answered by another call. `step` is to be called some times a second.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace

from teo_lut_executor.execution.events import (
    Activity,
    Event,
    Finished,
    Outcome,
    PlanWanted,
    Progress,
    QueueSettings,
    ReturnWanted,
    Sentence,
    Status,
    TrajectoryReady,
)
from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.robot_state import RobotState
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.stopping import stop
from teo_signs.errors import PlanError

# How often a way back to rest is sent when the robot does not take it up: a driver may refuse one from a
# robot in motion, when a joint is about to reach a limit say, and take the next.
_MOST_RETURNS = 5

# How far from its way back the robot may be before the next is sent [rad], and for how long [s]: it stands
# still at its start, so that it lags behind by little.
_RETURN_TOLERANCE = 0.05
_RETURN_TIME = 0.1


@dataclass(kw_only=True, eq=False)
class _Current:
    """The sentence at hand."""

    ticket: int
    sentence: Sentence
    plan: Plan | None = None
    monitor: PathMonitor | None = None  # of the plan, or of the way back to rest
    canceled: bool = False
    returns: int = 0  # ways back that were asked for
    lead: float = 0.0  # time in which the robot is to reach the start of its way back [s]


class ExecutionQueue:
    """Signs sentences in the order in which they come, and follows the robot meanwhile."""

    def __init__(self, limits: MotionLimits, settings: QueueSettings | None = None) -> None:
        """Begin with nothing queued."""
        self.settings = QueueSettings() if settings is None else settings
        self.limits = limits
        self._robot = RobotState(limits.names)
        self._waiting: deque[tuple[int, Sentence]] = deque()
        self._current: _Current | None = None
        self._told: tuple[Activity, str] | None = None  # activity and message of the last status
        self._tickets = 0
        self._now = -math.inf
        self._listening = False

    @property
    def queued(self) -> int:
        """Sentences that wait."""
        return len(self._waiting)

    def submit(self, sentence: Sentence, now: float) -> tuple[int, list[Event]]:
        """Take a sentence; it begins with the next `step` if nothing is before it.

        Returns:
            A ticket for `cancel` and `Finished`, and what is to be done.
        """
        self._tick(now)
        self._tickets += 1
        if self.queued >= self.settings.capacity:
            most = self.settings.capacity
            error = PlanError("queue_full", f"expected at most {most} sentences to wait: send this one later")
            return self._tickets, self._refuse(self._tickets, sentence, error, now)
        self._waiting.append((self._tickets, sentence))
        return self._tickets, []

    def joint_states(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float], now: float
    ) -> str:
        """Take a joint state; see `RobotState.update`."""
        self._tick(now)
        return self._robot.update(names, positions, velocities, now)

    def step(self, now: float, *, listening: bool) -> list[Event]:
        """Notice what time has brought.

        Args:
            now: [s].
            listening: Whether anybody takes trajectories.
        """
        self._tick(now)
        self._listening = listening
        events = [] if self._current is None else self._follow(self._current, now)
        return events + self._start_next(now)

    def cancel(self, ticket: int, now: float) -> list[Event]:
        """End a sentence: one that waits is forgotten, the current one stops and goes back to rest."""
        self._tick(now)
        for item in self._waiting:
            if item[0] == ticket:
                self._waiting.remove(item)
                return [Finished(ticket=ticket, outcome=Outcome.CANCELED, message="canceled before it began")]
        current = self._current
        if current is None or current.ticket != ticket or current.canceled:
            return []
        current.canceled = True
        return self._turn_back(current, now)

    def planned(self, plan: Plan, now: float) -> list[Event]:
        """Answer `PlanWanted`."""
        self._tick(now)
        current = self._current
        if current is None:
            return []
        if current.canceled:
            return self._finish(current, Outcome.CANCELED, now, message="canceled before it began")
        current.plan = plan
        current.monitor = PathMonitor(motion=plan, started=now, settings=self.settings)
        signing = Status(
            activity=Activity.SIGNING,
            stamp=now,
            sentence=current.sentence,
            queued=self.queued,
            plan=plan,
            message=f"signing for {plan.duration:.1f} s",
        )
        return [TrajectoryReady(plan=plan), *self._tell(signing)]

    def not_planned(self, error: PlanError, now: float) -> list[Event]:
        """Answer `PlanWanted` with why not."""
        self._tick(now)
        current, self._current = self._current, None
        if current is None:
            return []
        return self._refuse(current.ticket, current.sentence, error, now) + self._start_next(now)

    def return_planned(self, plan: Plan, now: float) -> list[Event]:
        """Answer `ReturnWanted`."""
        self._tick(now)
        current = self._current
        if current is None:
            return []
        settings = self.settings
        if current.returns < _MOST_RETURNS:
            settings = replace(settings, path_tolerance=_RETURN_TOLERANCE, path_time=_RETURN_TIME)
        current.monitor = PathMonitor(motion=plan, started=now + current.lead, settings=settings)
        return [TrajectoryReady(plan=plan, lead=current.lead)]

    def progress(self, now: float) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        current = self._current
        if current is None or current.plan is None or current.monitor is None or current.canceled:
            return None
        plan, elapsed = current.plan, current.monitor.elapsed(now)
        signed = plan.token_at(elapsed)
        following = next((i for i, timing in enumerate(plan.timings) if timing.start > elapsed), None)
        return Progress(
            ticket=current.ticket,
            token=next(i for i in (signed, following, len(plan.timings) - 1) if i is not None),
            gloss="" if signed is None else plan.timings[signed].token.gloss,
            fraction=min(max(elapsed / plan.duration, 0.0), 1.0),
            stretch=plan.stretch,
        )

    def _tick(self, now: float) -> None:
        """Carry on where we are if the clock was set back, as at the start of a recording played again."""
        back = now - self._now
        if back < 0.0:
            self._robot.shift_clock(back)
            if self._current is not None and self._current.monitor is not None:
                self._current.monitor.shift_clock(back)
        self._now = now

    def _start_next(self, now: float) -> list[Event]:
        events: list[Event] = []
        while self._current is None and self._waiting:
            ticket, sentence = self._waiting[0]
            missing = self._missing()
            if missing:
                waiting = Status(
                    activity=Activity.WAITING,
                    stamp=now,
                    sentence=sentence,
                    queued=self.queued - 1,
                    message=missing,
                )
                return events + self._tell(waiting)
            self._waiting.popleft()
            age = now - self._robot.oldest
            if age > self.settings.joint_state_timeout:
                error = PlanError(
                    "stale_joint_states",
                    f"expected joint states of the last {self.settings.joint_state_timeout:g} s to start "
                    f"from, got some {age:.1f} s old: see that the driver runs, then send the sentence again",
                )
                events += self._refuse(ticket, sentence, error, now)
                continue
            self._current = _Current(ticket=ticket, sentence=sentence)
            events.append(PlanWanted(sentence=sentence, start=self._robot.state()))
        if self._current is None:
            events += self._tell(Status(activity=Activity.IDLE, stamp=now, message="at rest, nothing queued"))
        return events

    def _missing(self) -> str:
        """What must be there before a sentence can begin; empty if all is."""
        if not self._robot.complete:
            names = self._robot.missing
            more = f" and {len(names) - 3} more" if len(names) > 3 else ""
            return f"waiting for joint_states of {', '.join(names[:3])}{more}"
        return "" if self._listening else "waiting for a driver to take joint_trajectory"

    def _follow(self, current: _Current, now: float) -> list[Event]:
        """See whether the robot follows, and whether it is at the end."""
        if current.monitor is None:
            return []
        if current.monitor.is_reached(self._robot):
            if current.canceled:
                message = "stopped on request, at rest again"
                return self._finish(current, Outcome.CANCELED, now, message=message)
            return self._finish(current, Outcome.SUCCESS, now)
        problem = current.monitor.problem(self._robot, now)
        if problem is None:
            return []
        if problem.code == "not_followed" and 0 < current.returns < _MOST_RETURNS:
            return self._turn_back(current, now)
        return self._finish(current, Outcome.NOT_REACHED, now, error=problem)

    def _turn_back(self, current: _Current, now: float) -> list[Event]:
        """Ask for a way back to rest, unless there is nothing to turn back from."""
        plan, monitor = current.plan, current.monitor
        if plan is None or monitor is None:
            return []  # `planned` will see that it was canceled
        elapsed = monitor.elapsed(now)
        last = plan.timings[-1]
        if not current.returns and elapsed >= last.start + last.duration:
            return []  # on its way to rest already
        current.returns += 1
        moving = replace(self._robot.state(), acceleration=monitor.motion.at(elapsed)[2])
        end, current.lead = stop(moving, self.limits)
        return [ReturnWanted(start=end)]

    def _finish(
        self,
        current: _Current,
        outcome: Outcome,
        now: float,
        *,
        message: str = "",
        error: PlanError | None = None,
    ) -> list[Event]:
        self._current = None
        timings = () if current.plan is None else current.plan.timings
        said = message if error is None else f"{error.code}: {error}"
        finished = Finished(ticket=current.ticket, outcome=outcome, message=said, timings=timings)
        if error is None:
            return [finished]
        return [finished, *self._tell_refused(current.sentence, error, now)]

    def _refuse(self, ticket: int, sentence: Sentence, error: PlanError, now: float) -> list[Event]:
        finished = Finished(ticket=ticket, outcome=Outcome.REFUSED, message=f"{error.code}: {error}")
        return [finished, *self._tell_refused(sentence, error, now)]

    def _tell_refused(self, sentence: Sentence, error: PlanError, now: float) -> list[Event]:
        refused = Status(
            activity=Activity.REFUSED,
            stamp=now,
            sentence=sentence,
            queued=self.queued,
            code=error.code,
            message=str(error),
        )
        self._told = None
        return self._tell(refused)

    def _tell(self, status: Status) -> list[Event]:
        """A status, if it is not what was told last."""
        told = (status.activity, status.message)
        if told == self._told and status.activity != Activity.SIGNING:
            return []
        self._told = told
        return [status]
