# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences in their order, and the robot that signs them. Knows neither ROS nor how they are planned.

Every call takes the time and returns what is to be done, in order. Planning takes its time elsewhere: a
`PlanWanted` or `ReturnWanted` is answered by a later call with its number. `step` is to be called some times
a second. What a call does to the sentence at hand, and to the robot, is said by the table in `table`; the
sentences that wait are listed, canceled and cleared in every state alike.
"""

from __future__ import annotations

from collections.abc import Sequence

from teo_lut_executor.execution.interface import (
    DriverReport,
    Effect,
    Outcome,
    Preemption,
    Progress,
    QueueSettings,
    Sentence,
)
from teo_lut_executor.execution.table import (
    NOTICES,
    Event,
    Notice,
    cancellation_event,
    failure_event,
    happen,
    notice_block,
    notice_pause,
)
from teo_lut_executor.execution.work import Job, PlanAnswer, State, Work, finished, named, news, refused
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.errors import PlanError

# Errors of planning that lie in where the robot is, not in the sentence: from a standstill it may go well.
_OF_THE_START = ("self_collision", "outside_limits", "start_outside_limits", "bad_start", "no_timing")


class ExecutionQueue:
    """Signs sentences in the order in which they come: admits, lists, cancels and clears those that wait."""

    def __init__(self, limits: MotionLimits, settings: QueueSettings | None = None) -> None:
        """Begin with nothing queued."""
        self._work = Work(limits, QueueSettings() if settings is None else settings)

    def configure(self, limits: MotionLimits, settings: QueueSettings) -> None:
        """Take other limits and settings, for what begins from now on."""
        self._work.situation.limits, self._work.situation.settings = limits, settings

    @property
    def limits(self) -> MotionLimits:
        """Of every joint."""
        return self._work.situation.limits

    @property
    def settings(self) -> QueueSettings:
        """How patient it is."""
        return self._work.situation.settings

    @property
    def state(self) -> State:
        """What the robot does, as far as the queue has a hand in it."""
        return self._work.state

    @property
    def queued(self) -> int:
        """Sentences that wait."""
        return len(self._work.waiting)

    def sentences(self) -> tuple[tuple[Sentence, ...], int]:
        """Sentences not signed to the end, in order, and which is being signed; -1 if none is."""
        jobs = [job for job in (self._work.current,) if job is not None]
        return tuple(job.sentence for job in (*jobs, *self._work.waiting)), len(jobs) - 1

    def submit(self, sentence: Sentence, now: float, *, attempts: int = 0) -> tuple[int, list[Effect]]:
        """Take a sentence; one of the next steps tells of it, and begins with it if nothing is before it.

        Args:
            sentence: What to sign.
            now: [s].
            attempts: How often it was begun already, by an executor before this one.

        Returns:
            A ticket for `cancel` and `Finished`, and what is to be done.
        """
        self._work.tick(now)
        job = Job(ticket=next(self._work.numbers), sentence=sentence, attempts=attempts)
        effects: list[Effect] = []
        if self.settings.preemption == Preemption.REPLACE:
            effects += self._replace_all_but(sentence.utterance_id)
        if self.queued >= self.settings.capacity:
            most = self.settings.capacity
            error = PlanError("queue_full", f"expected at most {most} sentences to wait: send this one later")
            return job.ticket, effects + refused(self._work, job, Outcome.REFUSED, error)
        self._work.waiting.append(job)
        return job.ticket, effects

    def refuse(self, sentence: Sentence, error: PlanError, now: float) -> list[Effect]:
        """Name a sentence that is not taken."""
        self._work.tick(now)
        return named(self._work, sentence, error)

    def recover(self) -> None:
        """Bring the robot to rest once nothing waits: it may have been left anywhere."""
        self._work.astray = True

    def cancel(self, ticket: int, now: float) -> list[Effect]:
        """End a sentence: one that waits is forgotten, the current one stops and goes back to rest."""
        self._work.tick(now)
        for job in self._work.waiting:
            if job.ticket == ticket:
                why = f"canceled before it began{' again' if job.again else ''}"
                return self._forget(job, why) + news(self._work)
        current = self._work.current
        if current is None or current.canceled or current.ticket != ticket:
            return []
        return self._cancel_current("stopped on request, at rest again")

    def clear(self, now: float) -> list[Effect]:
        """Forget every sentence that the robot has not begun, and name it; another is signed to its end."""
        self._work.tick(now)
        cleared = PlanError("cleared", "the queue was cleared")
        effects = happen(self._work, Event.CLEARED)
        for job in tuple(self._work.waiting):
            effects += self._forget_and_name(job, cleared)
        return effects + news(self._work)

    def deactivate(self, now: float) -> list[Effect]:
        """Stop the robot and name the current sentence; what waits is kept."""
        self._work.tick(now)
        if self.state is State.STANDING and self._work.interrupted is None:
            return []
        error = PlanError("inactive", "the executor was deactivated: activate it to go on")
        return happen(self._work, Event.DEACTIVATED, error)

    def step(self, now: float, *, obstacle: str = "") -> list[Effect]:
        """Notice what time has brought.

        Args:
            now: [s].
            obstacle: Why no motion may begin, as far as the caller knows; empty if it may.
        """
        self._work.tick(now)
        self._work.situation.obstacle = obstacle
        effects: list[Effect] = []
        for notice in NOTICES:
            effects += self._react(notice(self._work))
        return effects + news(self._work)

    def progress(self, now: float) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        self._work.tick(now)
        return self._work.progress()

    def joint_states(
        self,
        names: Sequence[str],
        positions: Sequence[float],
        velocities: Sequence[float],
        now: float,
        *,
        stamp: float | None = None,
    ) -> str:
        """Take a joint state; see `RobotState.update`.

        Args:
            names: Its joints.
            positions: [rad], one for each.
            velocities: [rad/s], one for each, or empty.
            now: [s].
            stamp: When the robot was there [s]; None if it does not say.
        """
        self._work.tick(now)
        situation = self._work.situation
        # A stamp that is older than joint states may be, or of the future, is of another clock.
        known = max(situation.clock_set, now - situation.settings.joint_state_timeout)
        then = stamp if stamp is not None and known < stamp <= now else now
        return situation.robot.update(names, positions, velocities, then)

    def driver_state(self, report: DriverReport, now: float) -> list[Effect]:
        """Take what the driver says of itself."""
        self._work.tick(now)
        self._work.situation.hear_driver(report)
        if report.remaining is None:
            for motion in self._work.sent:
                motion.end_leap()
        elif report.stamp >= self._work.situation.clock_set:
            since = max(now - report.stamp, 0.0)  # the message's way here
            for motion in self._work.sent:
                motion.synchronise(report.remaining - since * report.speed_scaling)
        effects = self._react(notice_block(self._work)) + self._react(notice_pause(self._work))
        return effects + news(self._work)

    def driver_refused(self, number: int, reason: str, now: float) -> list[Effect]:
        """The driver did not take a motion; whatever it was doing goes on.

        Args:
            number: Of the motion.
            reason: What the driver says.
            now: [s].
        """
        work = self._work
        work.tick(now)
        error = PlanError("trajectory_refused", f"the driver did not take the motion: {reason}")
        if work.motion is not None and work.motion.number == number:
            return self._react(failure_event(work, Event.MOTION_REFUSED, error))
        if work.continuation is None or work.continuation.number != number:
            return happen(work, Event.STOP_REFUSED, number)
        return happen(work, Event.CONTINUATION_REFUSED)

    def opened(self, number: int, plan: Plan, now: float) -> list[Effect]:
        """Answer `PlanWanted` with the first motion; the whole follows."""
        self._work.tick(now)
        return happen(self._work, Event.OPENED, plan) if number == self._work.asked else []

    def planned(self, number: int, plan: Plan, now: float, *, after: float = 0.0) -> list[Effect]:
        """Answer `PlanWanted` or `ReturnWanted`.

        Args:
            number: Of the request.
            plan: The motion.
            now: [s].
            after: Time from the start of the opening at which the plan takes over [s].
        """
        self._work.tick(now)
        if self._is_next(number):
            return happen(self._work, Event.NEXT_PLANNED, plan)
        if number != self._work.asked:
            return []
        return happen(self._work, Event.PLANNED, PlanAnswer(plan=plan, after=after)) + news(self._work)

    def not_planned(self, number: int, error: PlanError, now: float) -> list[Effect]:
        """Answer `PlanWanted` or `ReturnWanted` with why not."""
        work = self._work
        work.tick(now)
        of_the_start = error.code in _OF_THE_START
        if self._is_next(number):
            if not of_the_start:
                return happen(work, Event.NEXT_NOT_PLANNED, error) + news(work)
            effects = happen(work, Event.NEXT_NOT_PLANNED_HERE)
            canceled = "" if work.current is None else work.current.canceled
            return effects + (self._cancel_current(canceled) if canceled else [])
        if number != work.asked:
            return []
        if self.state is State.PLANNING_REST:
            return happen(work, Event.NO_WAY, error)
        here = of_the_start and work.current is not None and work.current.joins
        event = Event.NOT_PLANNED_HERE if here else Event.NOT_PLANNED
        return happen(work, event, error) + news(work)

    def _react(self, notice: Notice) -> list[Effect]:
        return [] if notice is None else happen(self._work, *notice)

    def _is_next(self, number: int) -> bool:
        """Whether a plan was wanted for the sentence that is to continue the current one."""
        return self._work.join is not None and number == self._work.join.number

    def _cancel_current(self, why: str) -> list[Effect]:
        return happen(self._work, cancellation_event(self._work), why)

    def _forget(self, job: Job, why: str) -> list[Effect]:
        """End a sentence that waits; one that was sent already ends as soon as it has begun."""
        if job.plan is not None:
            job.canceled = why
            return []
        if self._work.join is not None and self._work.join.job is job:
            self._work.join = None
        self._work.waiting.remove(job)
        return finished(job, Outcome.CANCELED, message=why)

    def _forget_and_name(self, job: Job, error: PlanError) -> list[Effect]:
        ended = self._forget(job, f"{error.code}: {error}")
        return [*ended, *named(self._work, job.sentence, error)]

    def _replace_all_but(self, utterance: str) -> list[Effect]:
        """End every sentence of other texts, the current one as soon as the next can take over."""
        replaced = PlanError("replaced", "a newer text took its place")
        effects: list[Effect] = []
        for job in tuple(self._work.waiting):
            if not utterance or job.sentence.utterance_id != utterance:
                effects += self._forget_and_name(job, replaced)
        current = self._work.current
        if current is None or current.canceled or (utterance and current.sentence.utterance_id == utterance):
            return effects
        effects += named(self._work, current.sentence, replaced)
        why = f"{replaced.code}: {replaced}"
        if current.plan is None:  # it has hardly begun
            return effects + self._cancel_current(why)
        return effects + happen(self._work, Event.REPLACED, why)
