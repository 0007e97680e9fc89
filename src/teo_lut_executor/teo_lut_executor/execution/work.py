# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is under way: the sentence at hand, and the motions that were sent for it."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

from teo_lut_executor.execution.announcements import Announcements
from teo_lut_executor.execution.events import Event, Progress
from teo_lut_executor.execution.halt import Halt
from teo_lut_executor.execution.job import Job, Phase
from teo_lut_executor.execution.joining import Joining
from teo_lut_executor.execution.motions import Motions
from teo_lut_executor.execution.situation import Situation


class Work:
    """What is under way; `Signing` and `Interruption` change it.

    Attributes:
        situation: What is known at the moment.
        waiting: Sentences that wait; the first is taken when its time comes.
        announcements: What is told.
        numbers: For motions, and plans that are wanted.
        motions: What the robot was sent.
        joining: The next sentence, in preparation to continue the present one.
        halt: Brings the robot to a standstill.
        phase: What the robot does.
        current: The sentence at hand, if any.
        asked: Number of the plan that is awaited while standing or opening; 0 if none.
        astray: Whether the robot was left somewhere, and is to be brought to rest.
        returns: How often the way to rest has failed since it was there.
    """

    def __init__(
        self,
        situation: Situation,
        waiting: deque[Job],
        announcements: Announcements,
        numbers: Iterator[int],
    ) -> None:
        """Begin at a standstill."""
        self.situation = situation
        self.waiting = waiting
        self.announcements = announcements
        self.numbers = numbers
        self.motions = Motions()
        self.joining = Joining(situation, waiting, numbers)
        self.halt = Halt(situation)
        self.phase = Phase.RESTING
        self.current: Job | None = None
        self.asked = 0
        self.astray = False
        self.returns = 0

    @property
    def interrupted(self) -> Job | None:
        """The sentence that waits to be signed again, if any."""
        return self.waiting[0] if self.waiting and self.waiting[0].again else None

    def tick(self, path_time: float, clock_set: float) -> None:
        """Let path time pass, and follow a clock that was set; both [s]."""
        self.halt.shift_clock(clock_set)
        self.motions.advance(path_time)

    def tell(self) -> list[Event]:
        """The present status, if it is not what was told last."""
        return self.announcements.tell(self.phase, self.current, astray=self.astray)

    def progress(self) -> Progress | None:
        """How far the current sentence is; None while none is signed."""
        current = self.current
        if self.phase is not Phase.SIGNING or current is None or current.plan is None or current.canceled:
            return None
        plan = current.plan
        motion = self.motions.of(plan)
        if motion is None:  # it waits for the end of its opening
            return None
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
