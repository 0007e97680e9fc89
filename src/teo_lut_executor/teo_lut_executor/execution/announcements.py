# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is told: how sentences end, which are refused and why, and what is going on."""

from __future__ import annotations

from dataclasses import replace

from teo_lut_executor.execution.events import (
    Activity,
    DriverMode,
    Effect,
    Finished,
    Outcome,
    Sentence,
    Status,
)
from teo_lut_executor.execution.states import State
from teo_lut_executor.execution.work import Job, Work
from teo_signs.errors import PlanError


def finished(job: Job, outcome: Outcome, *, message: str = "") -> list[Effect]:
    """Say that a sentence has ended."""
    timings = () if job.plan is None else job.plan.timings
    return [Finished(ticket=job.ticket, outcome=outcome, message=message, timings=timings)]


def completed(job: Job) -> list[Effect]:
    """Say that a sentence has ended where it was to end: at its last sign, or early if it was canceled."""
    outcome = Outcome.CANCELED if job.canceled else Outcome.SUCCESS
    return finished(job, outcome, message=job.canceled)


def refused(work: Work, job: Job, outcome: Outcome, error: PlanError) -> list[Effect]:
    """Say that a sentence has ended, and what is wrong."""
    ended = finished(job, outcome, message=f"{error.code}: {error}")
    return [*ended, *named(work, job.sentence, error)]


def named(
    work: Work, sentence: Sentence | None, error: PlanError, activity: Activity = Activity.REFUSED
) -> list[Effect]:
    """Say what is wrong, and with which sentence; the present status is told again after it."""
    work.told = ()
    return [
        Status(
            activity=activity,
            stamp=work.situation.now,
            sentence=sentence,
            queued=len(work.waiting),
            code=error.code,
            message=str(error),
        )
    ]


def news(work: Work) -> list[Effect]:
    """The present status, if it is not what was told last."""
    status = _status(work)
    told = (status.activity, status.code, status.message, status.sentence, status.queued, status.plan)
    if told == work.told:
        return []
    work.told = told
    return [status]


def _status(work: Work) -> Status:
    """What is going on, from the driver's word, the joint states and the motion in force."""
    situation, current, queued = work.situation, work.current, len(work.waiting)
    status = Status(activity=Activity.WAITING, stamp=situation.now, queued=queued)
    if current is not None:
        status = replace(status, sentence=current.sentence)
    elif work.waiting:
        status = replace(status, sentence=work.waiting[0].sentence, queued=queued - 1)
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
    signs = work.state in (State.OPENING, State.SIGNING)
    if signs and current is not None and current.plan is not None:
        plan = current.plan
        message = f"signing for {plan.duration:.1f} s"
        return replace(status, activity=Activity.SIGNING, plan=plan, message=message)
    if work.state in (State.STOPPING, State.RETURNING) or (work.astray and current is None):
        return replace(status, message=situation.hindrance or "going to rest")
    if work.state is not State.STANDING:
        return replace(status, message="planning")
    hindrance = situation.hindrance or ("planning" if work.waiting else "")
    if hindrance:
        return replace(status, message=hindrance)
    message = f"{'at rest' if situation.at_rest else 'standing still'}, nothing queued"
    return replace(status, activity=Activity.IDLE, message=message)
