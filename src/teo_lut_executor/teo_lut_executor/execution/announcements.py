# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is told: how sentences end, which are refused and why, and what is going on."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

from teo_lut_executor.execution.events import Activity, DriverMode, Event, Finished, Outcome, Sentence, Status
from teo_lut_executor.execution.job import Job, Phase
from teo_lut_executor.execution.situation import Situation
from teo_signs.errors import PlanError


def finished(job: Job, outcome: Outcome, *, message: str = "") -> list[Event]:
    """Say that a sentence has ended."""
    timings = () if job.plan is None else job.plan.timings
    return [Finished(ticket=job.ticket, outcome=outcome, message=message, timings=timings)]


class Announcements:
    """Says what is wrong when it happens, and what is going on whenever that changes."""

    def __init__(self, situation: Situation, waiting: deque[Job]) -> None:
        """Begin with nothing said.

        Args:
            situation: What is known at the moment.
            waiting: Sentences that wait.
        """
        self._situation = situation
        self._waiting = waiting
        self._told: tuple[object, ...] = ()  # what the last status said

    def refuse(self, job: Job, outcome: Outcome, error: PlanError) -> list[Event]:
        """Say that a sentence has ended, and what is wrong."""
        ended = finished(job, outcome, message=f"{error.code}: {error}")
        return [*ended, *self.name(job.sentence, error)]

    def name(
        self, sentence: Sentence | None, error: PlanError, activity: Activity = Activity.REFUSED
    ) -> list[Event]:
        """Say what is wrong, and with which sentence; the next status is told again."""
        self._told = ()
        return [
            Status(
                activity=activity,
                stamp=self._situation.now,
                sentence=sentence,
                queued=len(self._waiting),
                code=error.code,
                message=str(error),
            )
        ]

    def tell(self, phase: Phase, current: Job | None, *, astray: bool) -> list[Event]:
        """The present status, if it is not what was told last.

        Args:
            phase: What the robot does.
            current: The sentence at hand.
            astray: Whether the robot is to be brought to rest.
        """
        status = self._status(phase, current, astray=astray)
        told = (status.activity, status.code, status.message, status.sentence, status.queued, status.plan)
        if told == self._told:
            return []
        self._told = told
        return [status]

    def _status(self, phase: Phase, current: Job | None, *, astray: bool) -> Status:
        """What is going on, from the driver's word, the joint states and the motion in force."""
        situation, queued = self._situation, len(self._waiting)
        status = Status(activity=Activity.WAITING, stamp=situation.now, queued=queued)
        if current is not None:
            status = replace(status, sentence=current.sentence)
        elif self._waiting:
            status = replace(status, sentence=self._waiting[0].sentence, queued=queued - 1)
        if situation.block is not None:
            code, meaning = situation.block
            activity = Activity.STOPPED if situation.mode is DriverMode.STOPPED else Activity.FAULT
            return replace(status, activity=activity, code=code, message=meaning)
        if situation.is_stale:
            silent = situation.settings.joint_state_timeout
            stale = f"no joint_states for {silent:g} s: see that the driver runs"
            return replace(status, activity=Activity.FAULT, code="stale_joint_states", message=stale)
        if situation.mode is DriverMode.PAUSED:
            return replace(status, activity=Activity.PAUSED, message="paused: it goes on at `resume`")
        if phase is Phase.SIGNING and current is not None and current.plan is not None:
            plan = current.plan
            message = f"signing for {plan.duration:.1f} s"
            return replace(status, activity=Activity.SIGNING, plan=plan, message=message)
        if phase in (Phase.STOPPING, Phase.RETURNING) or (astray and current is None):
            return replace(status, message=situation.hindrance or "going to rest")
        if phase in (Phase.PLANNING, Phase.SIGNING):
            return replace(status, message="planning")
        hindrance = situation.hindrance or ("planning" if self._waiting else "")
        if hindrance:
            return replace(status, message=hindrance)
        message = f"{'at rest' if situation.at_rest else 'standing still'}, nothing queued"
        return replace(status, activity=Activity.IDLE, message=message)
