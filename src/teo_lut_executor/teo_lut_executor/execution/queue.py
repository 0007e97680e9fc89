# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences in their order, and the robot that signs them. Knows neither ROS nor how they are planned.

Every call takes the time and returns what is to be done, in order. Planning takes its time elsewhere: a
`PlanWanted` or `ReturnWanted` is answered by a later call with its number. `step` is to be called some times
a second.

Sentences in a row are joined: the next is planned from the state in which the one before ends its last sign
(or, if it comes later, from the state on the way down), and is sent to start there.
"""

from __future__ import annotations

import enum
import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace

from teo_lut_executor.execution.events import (
    Activity,
    Begun,
    DriverMode,
    DriverReport,
    Event,
    Finished,
    Outcome,
    PlanWanted,
    Preemption,
    Progress,
    QueueSettings,
    ReturnWanted,
    Sentence,
    Status,
    StopReady,
    TrajectoryReady,
)
from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.robot_state import RobotState
from teo_motion.sentence.composition import REST
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_motion.trajectory.stopping import stop
from teo_signs.errors import PlanError

# A motion from a standstill is sent to start so much later [s]: the message's way to the driver, and its
# check there; on two cores with a load of ten they took more than 0.05 s. A driver that gets it later drops
# the points that have passed, or refuses it.
_START_LEAD = 0.1

# A motion that continues another is sent this long before it is to take over [s]: late enough that plans can
# still change, early enough for a loaded machine.
_SEND_AHEAD = 0.5

# With less time than this the driver might get it too late [s].
_LEAST_AHEAD = 0.05

# Time that planning a sentence is given at first when it is to continue a motion [s]: three times the median
# on two loaded cores. Where it was too little, the next try gets twice as much.
_PLANNING_TIME = 0.4

# On its way to rest a robot is nearly there when so little is left [s]: nothing is won by joining.
_NEARLY_AT_REST = 0.3

# How often a stop is sent to a robot that goes on moving: a driver may refuse one when a joint is about to
# reach a limit, and take the next.
_MOST_STOPS = 5

# How often the way to rest is tried after an interrupted sentence, before the robot is left where it is.
_MOST_RETURNS = 3

# Time after the end of a stop at which the next is sent [s].
_STOP_PATIENCE = 0.1

# The robot stands when joint states have shown no movement for this long [s]: ten of them.
_STANDS = 0.1

# A step of the clock larger than this between two calls is a clock that was set, or a process that was not
# running [s]: joint states that came meanwhile have not been read yet, and do not count as stale.
_CLOCK_STEP = 0.2

# Errors of planning that lie in where the robot is, not in the sentence: from a standstill it may go well.
_OF_THE_START = ("self_collision", "outside_limits", "start_outside_limits", "bad_start", "no_timing")

# What the driver's modes mean for the sentence at hand, by code.
_BLOCKED = {
    DriverMode.STOPPED: ("stopped", "the robot was told to stop: re-arm it to go on"),
    DriverMode.INACTIVE: ("driver_inactive", "the driver is not active: activate it to go on"),
    DriverMode.FAULT: ("driver_fault", "the driver reports a fault: mend it and re-arm it to go on"),
}


class _Phase(enum.Enum):
    """What the robot does, as far as the queue has a hand in it."""

    RESTING = enum.auto()  # nothing is in force
    PLANNING = enum.auto()  # standing, a plan is awaited
    SIGNING = enum.auto()  # a motion of a sentence is in force
    STOPPING = enum.auto()  # given up; the robot is awaited to stand
    RETURNING = enum.auto()  # a way to rest is in force


@dataclass(kw_only=True, eq=False)
class _Job:
    """A sentence that was accepted."""

    ticket: int
    sentence: Sentence
    attempts: int = 0  # how often it was begun
    canceled: str = ""  # why it is to end early; empty if it is not
    plan: Plan | None = None
    planning_time: float = _PLANNING_TIME  # to be given when it is to continue another [s]
    joins: bool = True  # whether it may continue another


@dataclass(kw_only=True, eq=False)
class _Join:
    """The next sentence, in preparation to continue the present one."""

    number: int
    job: _Job
    splice: float  # path time of the present motion at which it takes over [s]
    plan: Plan | None = None


class ExecutionQueue:
    """Signs sentences in the order in which they come, and follows the robot meanwhile."""

    def __init__(self, limits: MotionLimits, settings: QueueSettings | None = None) -> None:
        """Begin with nothing queued."""
        self.settings = QueueSettings() if settings is None else settings
        self.limits = limits
        self._robot = RobotState(limits.names)
        self._driver: DriverReport | None = None
        self._waiting: deque[_Job] = deque()
        self._phase = _Phase.RESTING
        self._current: _Job | None = None
        self._motion: PathMonitor | None = None  # in force
        self._continuation: PathMonitor | None = None  # sent, and takes over later
        self._join: _Join | None = None
        self._asked = 0  # number of the plan that is awaited while standing or opening; 0 if none
        self._astray = False  # whether the robot was left somewhere, and is to be brought to rest
        self._stops = 0
        self._returns = 0
        self._stop_due = -math.inf
        self._told: tuple[object, ...] = ()  # what the last status said
        self._obstacle = ""
        self._numbers = 0
        self._now = -math.inf

    @property
    def queued(self) -> int:
        """Sentences that wait."""
        return len(self._waiting)

    def sentences(self) -> tuple[tuple[Sentence, ...], int]:
        """Sentences not signed to the end, in order, and which is being signed; -1 if none is."""
        jobs = [job for job in (self._current,) if job is not None]
        return tuple(job.sentence for job in (*jobs, *self._waiting)), len(jobs) - 1

    def submit(self, sentence: Sentence, now: float, *, attempts: int = 0) -> tuple[int, list[Event]]:
        """Take a sentence; it begins with one of the next steps if nothing is before it.

        Args:
            sentence: What to sign.
            now: [s].
            attempts: How often it was begun already, by an executor before this one.

        Returns:
            A ticket for `cancel` and `Finished`, and what is to be done.
        """
        self._tick(now)
        job = _Job(ticket=self._number(), sentence=sentence, attempts=attempts)
        events: list[Event] = []
        if self.settings.preemption == Preemption.REPLACE:
            events += self._replace_all_but(sentence.utterance_id)
        if self.queued >= self.settings.capacity:
            most = self.settings.capacity
            error = PlanError("queue_full", f"expected at most {most} sentences to wait: send this one later")
            return job.ticket, events + self._refuse(job, Outcome.REFUSED, error)
        self._waiting.append(job)
        return job.ticket, events + self._tell()

    def refuse(self, sentence: Sentence, error: PlanError, now: float) -> list[Event]:
        """Name a sentence that is not taken."""
        self._tick(now)
        return self._name(sentence, error)

    def joint_states(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float], now: float
    ) -> str:
        """Take a joint state; see `RobotState.update`."""
        self._tick(now)
        return self._robot.update(names, positions, velocities, now)

    def driver_state(self, report: DriverReport, now: float) -> list[Event]:
        """Take what the driver says of itself."""
        self._tick(now)
        self._driver = report
        if report.remaining is not None:
            for motion in (self._motion, self._continuation):
                if motion is not None:
                    motion.synchronise(report.remaining)
        return self._blocked() + self._tell()

    def driver_refused(self, number: int, reason: str, now: float) -> list[Event]:
        """The driver did not take a motion; whatever it was doing goes on.

        Args:
            number: Of the motion.
            reason: What the driver says.
            now: [s].
        """
        self._tick(now)
        error = PlanError("trajectory_refused", f"the driver did not take the motion: {reason}")
        continuation, motion = self._continuation, self._motion
        if continuation is not None and continuation.number == number:
            self._continuation = None
            if self._waiting and self._waiting[0].plan is continuation.motion:
                self._waiting[0].plan, self._waiting[0].joins = None, False
                return []  # the present sentence goes to its end
            current = self._current
            if current is not None and motion is not None and current.joins:
                current.plan = None
                return self._ask_from_end(current, motion)
            return self._give_up(error)
        if motion is not None and motion.number == number:
            return self._give_up(error)
        return []

    def step(self, now: float, *, obstacle: str = "") -> list[Event]:
        """Notice what time has brought.

        Args:
            now: [s].
            obstacle: Why no motion may begin, as far as the caller knows; empty if it may.
        """
        self._tick(now)
        self._obstacle = obstacle
        events = self._blocked() + self._lost() + self._take_over()
        match self._phase:
            case _Phase.SIGNING | _Phase.RETURNING:
                events += self._follow()
            case _Phase.STOPPING:
                events += self._await_standstill()
        if self._phase is _Phase.SIGNING:
            events += self._prepare_join()
        if self._phase is _Phase.RESTING:
            events += self._begin()
        return events + self._tell()

    def cancel(self, ticket: int, now: float) -> list[Event]:
        """End a sentence: one that waits is forgotten, the current one stops and goes back to rest."""
        self._tick(now)
        for job in self._waiting:
            if job.ticket == ticket:
                return self._forget(job, "canceled before it began") + self._tell()
        current = self._current
        if current is None or current.ticket != ticket or current.canceled:
            return []
        current.canceled = "stopped on request, at rest again"
        return self._turn_back()

    def clear(self, now: float) -> list[Event]:
        """Forget every sentence that waits, and name it; the current one is signed to its end."""
        self._tick(now)
        cleared = PlanError("cleared", "the queue was cleared")
        events: list[Event] = []
        for job in tuple(self._waiting):
            events += [*self._forget(job, f"{cleared.code}: {cleared}"), *self._name(job.sentence, cleared)]
        return events + self._tell()

    def deactivate(self, now: float) -> list[Event]:
        """Stop the robot and name the current sentence; what waits is kept."""
        self._tick(now)
        if self._phase is _Phase.RESTING:
            return []
        error = PlanError("inactive", "the executor was deactivated: activate it to go on")
        return self._interrupt(Outcome.CANCELED, error) + self._halt()

    def opened(self, number: int, plan: Plan, now: float) -> list[Event]:
        """Answer `PlanWanted` with the first motion; the whole follows."""
        self._tick(now)
        if number != self._asked or self._current is None or self._current.canceled:
            return []
        return self._send(plan, now + _START_LEAD)

    def planned(self, number: int, plan: Plan, now: float, *, after: float = 0.0) -> list[Event]:
        """Answer `PlanWanted` or `ReturnWanted`.

        Args:
            number: Of the request.
            plan: The motion.
            now: [s].
            after: Time from the start of the opening at which the plan takes over [s].
        """
        self._tick(now)
        if self._join is not None and number == self._join.number:
            self._join.plan = plan
            return self._prepare_join()
        if number != self._asked:
            return []
        current, motion = self._current, self._motion
        if motion is None:
            self._asked = 0
            if current is not None:
                current.plan = None if current.canceled else plan
            signs = current is not None and not current.canceled
            self._phase = _Phase.SIGNING if signs else _Phase.RETURNING
            return self._send(plan, now + _START_LEAD) + self._tell()
        assert current is not None
        ahead = after - motion.elapsed if after > 0.0 else motion.motion.duration - motion.elapsed
        if after > 0.0 and ahead < _LEAST_AHEAD:
            return self._ask_from_end(current, motion)
        self._asked = 0
        current.plan = plan
        return self._send(plan, now + max(ahead, _START_LEAD)) + self._tell()

    def not_planned(self, number: int, error: PlanError, now: float) -> list[Event]:
        """Answer `PlanWanted` or `ReturnWanted` with why not."""
        self._tick(now)
        join = self._join
        if join is not None and number == join.number:
            self._join = None
            join.job.joins = False
            if error.code in _OF_THE_START:  # from a standstill it may be possible
                return self._turn_back() if self._current is not None and self._current.canceled else []
            self._waiting.remove(join.job)
            return self._refuse(join.job, Outcome.REFUSED, error) + self._tell()
        if number != self._asked:
            return []
        self._asked = 0
        if self._current is None or self._current.canceled:
            return self._stay(error)
        if self._motion is not None and self._current.joins and error.code in _OF_THE_START:
            return self._ask_from_end(self._current, self._motion)
        current, self._current = self._current, None
        events = self._refuse(current, Outcome.REFUSED, error)
        if self._motion is not None:  # it was opened
            return events + self._halt()
        self._phase = _Phase.RESTING
        return events + self._begin() + self._tell()

    def progress(self, now: float) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        self._tick(now)
        current = self._current
        if self._phase is not _Phase.SIGNING or current is None or current.plan is None or current.canceled:
            return None
        plan = current.plan
        motion = next(m for m in (self._motion, self._continuation) if m is not None and m.motion is plan)
        elapsed = motion.elapsed
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
        """Let time pass; carry on where we are if the clock was set."""
        passed = now - self._now if math.isfinite(self._now) else 0.0
        self._now = now
        if passed < 0.0 or passed > _CLOCK_STEP:
            self._robot.shift_clock(passed)
            self._stop_due += passed
        for motion in (self._motion, self._continuation):
            if motion is not None:
                motion.advance(max(passed, 0.0) * self._pace)

    @property
    def _pace(self) -> float:
        """Path time per time [1]."""
        return 1.0 if self._driver is None else self._driver.speed_scaling

    @property
    def _age(self) -> float:
        """Of the joint state that is oldest [s]."""
        return self._now - self._robot.oldest

    @property
    def _is_stale(self) -> bool:
        return self._robot.complete and self._age > self.settings.joint_state_timeout

    def _number(self) -> int:
        self._numbers += 1
        return self._numbers

    def _send(self, plan: Plan, start: float) -> list[Event]:
        """Send a motion; it is in force at once, or takes over from the one that is."""
        number = self._number()
        motion = PathMonitor(number=number, motion=plan, elapsed=self._now - start, settings=self.settings)
        events: list[Event] = [TrajectoryReady(number=number, plan=plan, start=start)]
        if self._motion is not None:
            self._continuation = motion
            return events
        self._motion = motion
        if self._current is None or self._current.canceled:
            return events
        self._phase = _Phase.SIGNING
        return [*events, self._begun(self._current)]

    @staticmethod
    def _begun(job: _Job) -> Begun:
        job.attempts += 1
        return Begun(ticket=job.ticket)

    def _ask_from_end(self, current: _Job, opening: PathMonitor) -> list[Event]:
        """It cannot go on in motion: the opening comes to a standstill, and the plan begins there."""
        self._asked = self._number()
        current.joins = False
        end = opening.state_at(opening.motion.duration)
        return [PlanWanted(number=self._asked, sentence=current.sentence, start=end)]

    def _begin(self) -> list[Event]:
        """From a standstill: the next sentence, or the way to rest."""
        current = self._current
        if (not self._waiting and current is None and not self._astray) or self._hindrance():
            return []
        self._asked = self._number()
        self._phase = _Phase.PLANNING
        start = self._robot.state()
        if current is None and self._waiting:
            self._current = self._waiting.popleft()
            sentence = self._current.sentence
            return [PlanWanted(number=self._asked, sentence=sentence, start=start, opening=True)]
        if self._robot.farthest(REST)[0] <= self.settings.goal_tolerance:
            return self._rested()
        return [ReturnWanted(number=self._asked, start=start)]

    def _stay(self, error: PlanError) -> list[Event]:
        """There is no way to rest: say so, and stay."""
        events = self._rested()
        return events + self._name(None, PlanError(error.code, f"the robot does not go to rest: {error}"))

    def _rested(self) -> list[Event]:
        self._asked = self._returns = 0
        self._astray = False
        self._phase = _Phase.RESTING
        self._motion = None
        current, self._current = self._current, None
        return [] if current is None else self._finish(current, Outcome.CANCELED, message=current.canceled)

    def _hindrance(self) -> str:
        """What must be there before a motion can begin; empty if all is."""
        if not self._robot.complete:
            names = self._robot.missing
            more = f" and {len(names) - 3} more" if len(names) > 3 else ""
            return f"waiting for joint_states of {', '.join(names[:3])}{more}"
        if self._is_stale:
            return f"the last joint_states came {self._age:.1f} s ago: see that the driver runs"
        if self._driver is not None and self._driver.mode is DriverMode.PAUSED:
            return "paused"
        if self._driver is not None and self._driver.mode in _BLOCKED:
            return _BLOCKED[self._driver.mode][1]
        if self._obstacle:
            return self._obstacle
        return "" if self._robot.is_still else "waiting for the robot to stand still"

    def _follow(self) -> list[Event]:
        """See whether the robot follows, and whether it is at the end."""
        motion = self._motion
        assert motion is not None
        age = self._age * self._pace
        whole = self._current is None or self._current.canceled or self._current.plan is motion.motion
        if motion.is_reached(self._robot, age) and whole and self._continuation is None:
            if self._phase is _Phase.RETURNING:
                return self._rested()
            current, self._current = self._current, None
            assert current is not None
            self._motion, self._join, self._phase = None, None, _Phase.RESTING
            if current.canceled:
                return self._finish(current, Outcome.CANCELED, message=current.canceled)
            return self._finish(current, Outcome.SUCCESS)
        problem = motion.problem(self._robot, age)
        if problem is None or (problem.code == "not_reached" and not whole):
            return []
        if self._phase is _Phase.RETURNING:
            self._returns += 1
            if self._returns >= _MOST_RETURNS:
                return self._stay(problem)
        return self._give_up(problem)

    def _take_over(self) -> list[Event]:
        """Let the motion that continues the present one be in force when its time has come."""
        following = self._continuation
        if following is None or following.elapsed < 0.0:
            return []
        self._motion, self._continuation = following, None
        current = self._current
        if current is not None and current.plan is following.motion:
            return []
        self._current = self._waiting.popleft()
        events: list[Event] = [self._begun(self._current)]
        if current is not None:
            ended = Outcome.CANCELED if current.canceled else Outcome.SUCCESS
            events = [*self._finish(current, ended, message=current.canceled), *events]
        return events + (self._turn_back() if self._current.canceled else [])

    def _prepare_join(self) -> list[Event]:
        """Have the next sentence planned so that it continues the present one, and send it in time."""
        current, motion, join = self._current, self._motion, self._join
        if motion is None or current is None or current.plan is not motion.motion or self._continuation:
            return []
        if self._pace != 1.0 or self._hindrance_to_join():
            self._join = None
            return []
        if join is None:
            return self._ask_join(current, motion)
        ahead = join.splice - motion.elapsed
        if join.plan is None:
            return []
        if ahead < _LEAST_AHEAD:
            self._join = None
            join.job.planning_time *= 2.0
            return self._ask_join(current, motion)
        if ahead > _SEND_AHEAD:
            return []
        self._join = None
        join.job.plan = join.plan
        return self._send(join.plan, self._now + ahead)

    def _hindrance_to_join(self) -> str:
        return self._obstacle or (_BLOCKED.get(self._driver.mode, ("", ""))[1] if self._driver else "")

    def _ask_join(self, current: _Job, motion: PathMonitor) -> list[Event]:
        if not self._waiting or not self._waiting[0].joins:
            return []
        job, last = self._waiting[0], motion.motion.timings[-1]
        end = last.start + last.duration
        earliest = motion.elapsed + job.planning_time
        splice = earliest if current.canceled else max(end, earliest)
        if splice > motion.motion.duration - _NEARLY_AT_REST:
            return []
        hold = self.settings.sentence_pause if splice == end else 0.0
        self._join = _Join(number=self._number(), job=job, splice=splice)
        start = motion.state_at(splice)
        return [PlanWanted(number=self._join.number, sentence=job.sentence, start=start, hold=hold)]

    def _forget(self, job: _Job, why: str) -> list[Event]:
        """End a sentence that waits; one that was sent already ends as soon as it has begun."""
        if job.plan is not None:
            job.canceled = why
            return []
        if self._join is not None and self._join.job is job:
            self._join = None
        self._waiting.remove(job)
        return self._finish(job, Outcome.CANCELED, message=why)

    def _replace_all_but(self, utterance: str) -> list[Event]:
        """End every sentence of other texts, the current one as soon as the next can take over."""
        replaced = PlanError("replaced", "a newer text took its place")
        why = f"{replaced.code}: {replaced}"
        events: list[Event] = []
        for job in tuple(self._waiting):
            if not utterance or job.sentence.utterance_id != utterance:
                events += [
                    *self._forget(job, f"{replaced.code}: {replaced}"),
                    *self._name(job.sentence, replaced),
                ]
        current = self._current
        if current is None or current.canceled or (utterance and current.sentence.utterance_id == utterance):
            return events
        current.canceled = why
        events += self._name(current.sentence, replaced)
        if current.plan is None:
            return events + self._turn_back()  # it has hardly begun
        return events

    def _turn_back(self) -> list[Event]:
        """End the current sentence early, and go to rest, unless it is on its way there already."""
        current, motion = self._current, self._motion
        assert current is not None
        if self._phase is _Phase.PLANNING and motion is None:
            self._asked, self._current, self._phase = 0, None, _Phase.RESTING
            return self._finish(current, Outcome.CANCELED, message="canceled before it began")
        if self._phase is not _Phase.SIGNING or motion is None:
            return []
        if current.plan is motion.motion and self._continuation is None:
            last = current.plan.timings[-1]
            if motion.elapsed >= last.start + last.duration:
                self._join = None
                return []
        return self._halt()

    def _halt(self, *, send: bool = True) -> list[Event]:
        """Drop every plan, and have the robot stop."""
        if self._continuation is not None and self._waiting:
            self._waiting[0].plan = None
        moving = self._robot.state()
        if self._motion is not None:  # joint states tell no acceleration
            moving = replace(moving, acceleration=self._motion.state_at(self._motion.elapsed).acceleration)
        self._motion = self._continuation = self._join = None
        self._asked, self._stops, self._stop_due = 0, 0, self._now
        self._astray = True
        self._phase = _Phase.STOPPING
        return self._stop(moving) if send else []

    def _stop(self, moving: State) -> list[Event]:
        if self._robot.is_still or self._is_stale or self._stops >= _MOST_STOPS:
            return []
        self._stops += 1
        end, lead = stop(moving, self.limits)
        self._stop_due = self._now + lead
        return [StopReady(number=self._number(), end=end, lead=lead)]

    def _await_standstill(self) -> list[Event]:
        if self._robot.still_for(self._now) >= _STANDS and self._now >= self._stop_due:
            self._phase = _Phase.RESTING
            return []
        mode = None if self._driver is None else self._driver.mode
        if self._now > self._stop_due + _STOP_PATIENCE and mode not in _BLOCKED:
            return self._stop(self._robot.state())
        return []

    def _blocked(self) -> list[Event]:
        """End what is going on when the driver says that it takes nothing more."""
        if self._driver is None or self._driver.mode not in _BLOCKED:
            return []
        if self._phase in (_Phase.RESTING, _Phase.STOPPING) and self._current is None:
            return []
        code, meaning = _BLOCKED[self._driver.mode]
        error = PlanError(code, f"{self._driver.message}: {meaning}" if self._driver.message else meaning)
        stopped = self._driver.mode is DriverMode.STOPPED
        ended = self._interrupt(Outcome.CANCELED if stopped else Outcome.NOT_REACHED, error)
        return ended + self._halt(send=False)

    def _lost(self) -> list[Event]:
        """Give up what is going on when nothing is heard of the robot."""
        if not self._is_stale or self._phase is _Phase.RESTING:
            return []
        events = self._give_up(PlanError("stale_joint_states", self._hindrance()))
        self._phase = _Phase.RESTING  # nothing tells how it moves
        return events

    def _give_up(self, error: PlanError) -> list[Event]:
        """The robot does not do what was sent: stop it, and sign the sentence again, or name it."""
        current = self._current
        again = (
            current is not None
            and not current.canceled
            and error.code != "not_reached"
            and current.attempts < self.settings.attempts
        )
        if current is None or not again:
            return self._interrupt(Outcome.NOT_REACHED, error) + self._halt()
        self._current, current.plan = None, None
        halting = self._halt()
        self._waiting.appendleft(current)
        error = PlanError(error.code, f"{error}; the sentence will be signed again")
        return [*self._name(current.sentence, error, Activity.FAULT), *halting]

    def _interrupt(self, outcome: Outcome, error: PlanError) -> list[Event]:
        """End the current sentence and say why; one that has not begun waits again."""
        current, self._current = self._current, None
        if current is None:
            return []
        if self._phase is _Phase.PLANNING and not current.canceled:
            self._waiting.appendleft(current)
            return []
        return self._refuse(current, outcome, error)

    def _finish(self, job: _Job, outcome: Outcome, *, message: str = "") -> list[Event]:
        timings = () if job.plan is None else job.plan.timings
        return [Finished(ticket=job.ticket, outcome=outcome, message=message, timings=timings)]

    def _refuse(self, job: _Job, outcome: Outcome, error: PlanError) -> list[Event]:
        finished = self._finish(job, outcome, message=f"{error.code}: {error}")
        return [*finished, *self._name(job.sentence, error)]

    def _name(
        self, sentence: Sentence | None, error: PlanError, activity: Activity = Activity.REFUSED
    ) -> list[Event]:
        """Say what is wrong, and with which sentence; the next status is told again."""
        self._told = ()
        return [
            Status(
                activity=activity,
                stamp=self._now,
                sentence=sentence,
                queued=self.queued,
                code=error.code,
                message=str(error),
            )
        ]

    def _tell(self) -> list[Event]:
        """The present status, if it is not what was told last."""
        status = self._status()
        told = (status.activity, status.code, status.message, status.sentence, status.queued, status.plan)
        if told == self._told:
            return []
        self._told = told
        return [status]

    def _status(self) -> Status:
        """What is going on, from the driver's word, the joint states and the motion in force."""
        now, current = self._now, self._current
        status = Status(activity=Activity.WAITING, stamp=now, queued=self.queued)
        if current is not None:
            status = replace(status, sentence=current.sentence)
        elif self._waiting:
            status = replace(status, sentence=self._waiting[0].sentence, queued=self.queued - 1)
        mode = None if self._driver is None else self._driver.mode
        if mode in _BLOCKED:
            code, meaning = _BLOCKED[mode]
            activity = Activity.STOPPED if mode is DriverMode.STOPPED else Activity.FAULT
            return replace(status, activity=activity, code=code, message=meaning)
        if self._is_stale:
            stale = f"no joint_states for {self.settings.joint_state_timeout:g} s: see that the driver runs"
            return replace(status, activity=Activity.FAULT, code="stale_joint_states", message=stale)
        if mode is DriverMode.PAUSED:
            return replace(status, activity=Activity.PAUSED, message="paused: it goes on at `resume`")
        if self._phase is _Phase.SIGNING and current is not None and current.plan is not None:
            plan = current.plan
            message = f"signing for {plan.duration:.1f} s"
            return replace(status, activity=Activity.SIGNING, plan=plan, message=message)
        if self._phase in (_Phase.STOPPING, _Phase.RETURNING) or (self._astray and current is None):
            return replace(status, message=self._hindrance() or "going to rest")
        if self._phase in (_Phase.PLANNING, _Phase.SIGNING):
            return replace(status, message="planning")
        hindrance = self._hindrance() or ("planning" if self._waiting else "")
        if hindrance:
            return replace(status, message=hindrance)
        rests = self._robot.farthest(REST)[0] <= self.settings.goal_tolerance
        message = f"{'at rest' if rests else 'standing still'}, nothing queued"
        return replace(status, activity=Activity.IDLE, message=message)
