# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Everything that the queue remembers, and what it tells of it.

It remembers the state it is in, its sentences, and the motions that were sent. It tells how sentences end,
which are refused and why, how far the current one is, and what is going on.
"""

from __future__ import annotations

import enum
import itertools
from collections import deque
from dataclasses import dataclass, replace

from teo_lut_executor.execution.braking import Halt
from teo_lut_executor.execution.interface import (
    Activity,
    DriverMode,
    Effect,
    Finished,
    Outcome,
    Progress,
    QueueSettings,
    Sentence,
    Status,
    TrajectoryReady,
)
from teo_lut_executor.execution.sent_motion import SentMotion
from teo_lut_executor.execution.situation import Situation
from teo_motion.sentence.plan import Plan
from teo_motion.trajectory.driver_points import Samples
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.errors import PlanError


class State(enum.Enum):
    """What the robot does, as far as the executor has a hand in it; the value says it to people."""

    STANDING = "no motion is in force"
    PLANNING = "the robot stands, a sentence is being planned"
    PLANNING_REST = "the robot stands, its way to rest is being planned"
    OPENING = "the robot moves towards the first sign, the sentence is not in force yet"
    SIGNING = "the plan of a sentence is in force"
    STOPPING = "the robot was told to stop, and does not stand yet"
    RETURNING = "the robot moves to rest"


# Time that planning a sentence is given at first when it is to continue a motion [s]: three times the median
# on two loaded cores. Where it was too little, the next try gets twice as much.
_PLANNING_TIME = 0.4


@dataclass(kw_only=True, eq=False)
class Job:
    """A sentence that was accepted.

    Attributes:
        ticket: Names the sentence to the caller.
        sentence: What to sign.
        attempts: How often it was begun.
        again: Whether it was interrupted, and is to be signed again.
        canceled: Why it is to end early; empty if it is not.
        plan: Its motion, once there is one.
        planning_time: Time to give its planning when it is to continue another sentence [s].
        joins: Whether it may continue another motion.
    """

    ticket: int
    sentence: Sentence
    attempts: int = 0
    again: bool = False
    canceled: str = ""
    plan: Plan | None = None
    planning_time: float = _PLANNING_TIME
    joins: bool = True


@dataclass(kw_only=True, eq=False)
class Join:
    """The next sentence, in preparation to continue the current one.

    Attributes:
        number: Of the plan that is wanted.
        job: The sentence.
        splice: Path time of the motion in force at which it takes over [s].
        plan: The plan, once it is there.
    """

    number: int
    job: Job
    splice: float
    plan: Plan | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanAnswer:
    """The planner's answer to a request.

    Attributes:
        plan: The motion.
        after: Time from the start of the opening at which it takes over [s]; 0 for its end, or without one.
    """

    plan: Plan
    after: float


class Work:
    """What the queue remembers; the actions of the table change it.

    Attributes:
        situation: What is known of the robot and its driver.
        waiting: Sentences that wait; the first is taken when its time comes.
        numbers: For tickets, motions and plans that are wanted.
        halt: Brings the robot to a standstill.
        state: Row of the table.
        current: The sentence at hand, if any.
        motion: The motion in force, if any.
        continuation: The motion that was sent to take over from it, if any.
        join: The next sentence, in preparation to continue the current one.
        asked: Number of the plan that is awaited while standing or opening; 0 if none is.
        early: A plan that is kept until the driver has told of the opening.
        astray: Whether the robot was left somewhere, and is to be brought to rest.
        returns: How often the way to rest has failed since the robot was there.
        told: What the last status said.
    """

    def __init__(self, limits: MotionLimits, settings: QueueSettings) -> None:
        """Begin at a standstill, with nothing to sign."""
        self.situation = Situation(limits, settings)
        self.waiting: deque[Job] = deque()
        self.numbers = itertools.count(1)
        self.halt = Halt(self.situation)
        self.state = State.STANDING
        self.current: Job | None = None
        self.motion: SentMotion | None = None
        self.continuation: SentMotion | None = None
        self.join: Join | None = None
        self.asked = 0
        self.early: PlanAnswer | None = None
        self.astray = False
        self.returns = 0
        self.told: tuple[object, ...] = ()

    @property
    def interrupted(self) -> Job | None:
        """The sentence that waits to be signed again, if any."""
        return self.waiting[0] if self.waiting and self.waiting[0].again else None

    @property
    def sent(self) -> tuple[SentMotion, ...]:
        """The motion in force and its continuation, as far as there are any."""
        return tuple(motion for motion in (self.motion, self.continuation) if motion is not None)

    def tick(self, now: float) -> None:
        """Let time pass until now [s]."""
        path_time, clock_set = self.situation.tick(now)
        self.halt.shift_clock(clock_set)
        for motion in self.sent:
            if clock_set and self.situation.driver is not None:
                motion.leap(path_time)
            else:
                motion.advance(path_time)

    def send(
        self, plan: Plan, samples: Samples, start: float | None = None, *, elapsed: float = 0.0
    ) -> TrajectoryReady:
        """Have the robot execute a plan: at once if nothing is in force, else as a continuation.

        Args:
            plan: The motion.
            samples: What the driver is sent of it.
            start: When the robot is to be at the first sample [s]; None for as soon as the driver has it.
            elapsed: Path time since the plan's beginning [s]; negative before it.
        """
        number, situation = next(self.numbers), self.situation
        sent = SentMotion(
            number=number,
            plan=plan,
            elapsed=elapsed,
            settings=situation.settings,
            awaited=start is None and situation.driver is not None,
        )
        if self.motion is None:
            self.motion = sent
        else:
            self.continuation = sent
        return TrajectoryReady(number=number, plan=plan, samples=samples, start=start)

    def progress(self) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        current = self.current
        if self.state not in (State.OPENING, State.SIGNING) or current is None or current.canceled:
            return None
        motion = next((motion for motion in self.sent if motion.plan is current.plan), None)
        if motion is None:  # there is no plan yet, or it waits for the end of its opening
            return None
        plan, elapsed = motion.plan, motion.elapsed
        signed = plan.token_at(elapsed)
        following = next((i for i, timing in enumerate(plan.timings) if timing.start > elapsed), None)
        return Progress(
            ticket=current.ticket,
            token=next(i for i in (signed, following, len(plan.timings) - 1) if i is not None),
            gloss="" if signed is None else plan.timings[signed].token.gloss,
            fraction=min(max(elapsed / plan.duration, 0.0), 1.0),
            stretch=plan.stretch,
        )


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
    if situation.driver is not None and situation.mode is DriverMode.PAUSED:
        message = situation.driver.message or "paused: it goes on at `resume`"
        return replace(status, activity=Activity.PAUSED, message=message)
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
