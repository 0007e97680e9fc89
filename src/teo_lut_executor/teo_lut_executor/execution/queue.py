# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences in their order, and the robot that signs them. Knows neither ROS nor how they are planned.

Every call takes the time and returns what is to be done, in order. Planning takes its time elsewhere: a
`PlanWanted` or `ReturnWanted` is answered by a later call with its number. `step` is to be called some times
a second.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Sequence

from teo_lut_executor.execution.announcements import Announcements
from teo_lut_executor.execution.events import (
    DriverReport,
    Event,
    Outcome,
    Preemption,
    Progress,
    QueueSettings,
    Sentence,
)
from teo_lut_executor.execution.interruption import Interruption
from teo_lut_executor.execution.job import Job
from teo_lut_executor.execution.signing import Signing
from teo_lut_executor.execution.situation import Situation
from teo_lut_executor.execution.work import Work
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.errors import PlanError


class ExecutionQueue:
    """Signs sentences in the order in which they come: admits, lists, cancels and clears those that wait."""

    def __init__(self, limits: MotionLimits, settings: QueueSettings | None = None) -> None:
        """Begin with nothing queued."""
        self._situation = Situation(limits, QueueSettings() if settings is None else settings)
        self._waiting: deque[Job] = deque()
        self._numbers = itertools.count(1)
        self._announcements = Announcements(self._situation, self._waiting)
        self._work = Work(self._situation, self._waiting, self._announcements, self._numbers)
        self._interruption = Interruption(self._work)
        self._signing = Signing(self._work, self._interruption)

    def configure(self, limits: MotionLimits, settings: QueueSettings) -> None:
        """Take other limits and settings, for what begins from now on."""
        self._situation.limits, self._situation.settings = limits, settings

    @property
    def limits(self) -> MotionLimits:
        """Of every joint."""
        return self._situation.limits

    @property
    def settings(self) -> QueueSettings:
        """How patient it is."""
        return self._situation.settings

    @property
    def queued(self) -> int:
        """Sentences that wait."""
        return len(self._waiting)

    def sentences(self) -> tuple[tuple[Sentence, ...], int]:
        """Sentences not signed to the end, in order, and which is being signed; -1 if none is."""
        jobs = [job for job in (self._work.current,) if job is not None]
        return tuple(job.sentence for job in (*jobs, *self._waiting)), len(jobs) - 1

    def submit(self, sentence: Sentence, now: float, *, attempts: int = 0) -> tuple[int, list[Event]]:
        """Take a sentence; one of the next steps tells of it, and begins with it if nothing is before it.

        Args:
            sentence: What to sign.
            now: [s].
            attempts: How often it was begun already, by an executor before this one.

        Returns:
            A ticket for `cancel` and `Finished`, and what is to be done.
        """
        self._tick(now)
        job = Job(ticket=next(self._numbers), sentence=sentence, attempts=attempts)
        events: list[Event] = []
        if self.settings.preemption == Preemption.REPLACE:
            events += self._replace_all_but(sentence.utterance_id)
        if self.queued >= self.settings.capacity:
            most = self.settings.capacity
            error = PlanError("queue_full", f"expected at most {most} sentences to wait: send this one later")
            return job.ticket, events + self._announcements.refuse(job, Outcome.REFUSED, error)
        self._waiting.append(job)
        return job.ticket, events

    def refuse(self, sentence: Sentence, error: PlanError, now: float) -> list[Event]:
        """Name a sentence that is not taken."""
        self._tick(now)
        return self._announcements.name(sentence, error)

    def cancel(self, ticket: int, now: float) -> list[Event]:
        """End a sentence: one that waits is forgotten, the current one stops and goes back to rest."""
        self._tick(now)
        for job in self._waiting:
            if job.ticket == ticket:
                why = f"canceled before it began{' again' if job.again else ''}"
                return self._interruption.forget(job, why) + self._work.tell()
        current = self._work.current
        if current is None or current.ticket != ticket:
            return []
        return self._interruption.cancel("stopped on request, at rest again")

    def clear(self, now: float) -> list[Event]:
        """Forget every sentence that waits, and name it; the current one is signed to its end."""
        self._tick(now)
        cleared = PlanError("cleared", "the queue was cleared")
        events: list[Event] = []
        for job in tuple(self._waiting):
            events += self._forget(job, cleared)
        return events + self._work.tell()

    def deactivate(self, now: float) -> list[Event]:
        """Stop the robot and name the current sentence; what waits is kept."""
        self._tick(now)
        error = PlanError("inactive", "the executor was deactivated: activate it to go on")
        return self._interruption.interrupt(error)

    def step(self, now: float, *, obstacle: str = "") -> list[Event]:
        """Notice what time has brought.

        Args:
            now: [s].
            obstacle: Why no motion may begin, as far as the caller knows; empty if it may.
        """
        self._tick(now)
        self._situation.obstacle = obstacle
        return self._signing.step() + self._work.tell()

    def progress(self, now: float) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        self._tick(now)
        return self._work.progress()

    def joint_states(
        self, names: Sequence[str], positions: Sequence[float], velocities: Sequence[float], now: float
    ) -> str:
        """Take a joint state; see `RobotState.update`."""
        self._tick(now)
        return self._situation.robot.update(names, positions, velocities, now)

    def driver_state(self, report: DriverReport, now: float) -> list[Event]:
        """Take what the driver says of itself."""
        self._tick(now)
        self._situation.hear_driver(report)
        if report.remaining is not None:
            since = max(now - report.stamp, 0.0)  # the message's way here
            self._work.motions.synchronise(report.remaining - since * report.speed_scaling)
        return self._interruption.end_if_blocked() + self._work.tell()

    def driver_refused(self, number: int, reason: str, now: float) -> list[Event]:
        """The driver did not take a motion; whatever it was doing goes on.

        Args:
            number: Of the motion.
            reason: What the driver says.
            now: [s].
        """
        self._tick(now)
        return self._signing.driver_refused(number, reason)

    def opened(self, number: int, plan: Plan, now: float) -> list[Event]:
        """Answer `PlanWanted` with the first motion; the whole follows."""
        self._tick(now)
        return self._signing.opened(number, plan)

    def planned(self, number: int, plan: Plan, now: float, *, after: float = 0.0) -> list[Event]:
        """Answer `PlanWanted` or `ReturnWanted`.

        Args:
            number: Of the request.
            plan: The motion.
            now: [s].
            after: Time from the start of the opening at which the plan takes over [s].
        """
        self._tick(now)
        return self._signing.planned(number, plan, after)

    def not_planned(self, number: int, error: PlanError, now: float) -> list[Event]:
        """Answer `PlanWanted` or `ReturnWanted` with why not."""
        self._tick(now)
        return self._signing.not_planned(number, error)

    def _tick(self, now: float) -> None:
        path_time, clock_set = self._situation.tick(now)
        self._work.tick(path_time, clock_set)

    def _forget(self, job: Job, error: PlanError) -> list[Event]:
        """End a sentence that waits, and name it."""
        ended = self._interruption.forget(job, f"{error.code}: {error}")
        return [*ended, *self._announcements.name(job.sentence, error)]

    def _replace_all_but(self, utterance: str) -> list[Event]:
        """End every sentence of other texts, the current one as soon as the next can take over."""
        replaced = PlanError("replaced", "a newer text took its place")
        events: list[Event] = []
        for job in tuple(self._waiting):
            if not utterance or job.sentence.utterance_id != utterance:
                events += self._forget(job, replaced)
        current = self._work.current
        if current is None or current.canceled or (utterance and current.sentence.utterance_id == utterance):
            return events
        return events + self._interruption.supersede(current, replaced)
