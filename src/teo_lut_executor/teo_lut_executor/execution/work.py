# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Everything that the queue remembers: the state it is in, its sentences, and the motions that were sent."""

from __future__ import annotations

import itertools
from collections import deque
from dataclasses import dataclass

from teo_lut_executor.execution.events import Progress, QueueSettings, Sentence, TrajectoryReady
from teo_lut_executor.execution.halt import Halt
from teo_lut_executor.execution.path_monitor import PathMonitor
from teo_lut_executor.execution.situation import Situation
from teo_lut_executor.execution.states import State
from teo_motion.sentence.plan import Plan, Samples
from teo_motion.trajectory.limits import MotionLimits

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
    """What the queue remembers; the functions of `actions` change it.

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
        self.motion: PathMonitor | None = None
        self.continuation: PathMonitor | None = None
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
    def sent(self) -> tuple[PathMonitor, ...]:
        """The motion in force and its continuation, as far as there are any."""
        return tuple(motion for motion in (self.motion, self.continuation) if motion is not None)

    def tick(self, now: float) -> None:
        """Let time pass until now [s]."""
        path_time, clock_set = self.situation.tick(now)
        self.halt.shift_clock(clock_set)
        for motion in self.sent:
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
        monitor = PathMonitor(
            number=number,
            motion=plan,
            elapsed=elapsed,
            settings=situation.settings,
            awaited=start is None and situation.driver is not None,
        )
        if self.motion is None:
            self.motion = monitor
        else:
            self.continuation = monitor
        return TrajectoryReady(number=number, plan=plan, samples=samples, start=start)

    def progress(self) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        current = self.current
        if self.state not in (State.OPENING, State.SIGNING) or current is None or current.canceled:
            return None
        motion = next((motion for motion in self.sent if motion.motion is current.plan), None)
        if motion is None:  # there is no plan yet, or it waits for the end of its opening
            return None
        plan, elapsed = motion.motion, motion.elapsed
        signed = plan.token_at(elapsed)
        following = next((i for i, timing in enumerate(plan.timings) if timing.start > elapsed), None)
        return Progress(
            ticket=current.ticket,
            token=next(i for i in (signed, following, len(plan.timings) - 1) if i is not None),
            gloss="" if signed is None else plan.timings[signed].token.gloss,
            fraction=min(max(elapsed / plan.duration, 0.0), 1.0),
            stretch=plan.stretch,
        )
