# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recording a sign as it is made: a countdown, the sign, and the moment at which it is over."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Any

from teo_sign_capture.recordings.skeleton_bag import stamp_of, track_of_people
from teo_sign_capture.tracks.segmentation import find_signs
from teo_signs.errors import LutError

# [s] From the end of the countdown to the end of the sign: a breath, the longest sign and the ways up and
# down.
LONGEST_WAIT = 8.0
_MOST_COUNTDOWN = 30.0  # [s]
# [s] Hands that are back at rest for so long have ended the sign; beats of one sign return for less.
_STAYS = 0.5
# [s] Length of the end of the countdown that is kept: where the hands rest is learned from it.
_BEFORE = 1.0
# [s] From one look for the end to the next: each takes some hundredths of a second.
_LOOK = 0.5


class Phase(enum.Enum):
    """Where a recording is."""

    COUNTDOWN = "countdown"
    SIGN = "sign now"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, kw_only=True)
class LiveState:
    """What to tell the person.

    Attributes:
        phase: Where the recording is.
        remaining: Of the countdown, or of the time in which the sign must end [s].
        problem: Why it failed; None while all is well.
    """

    phase: Phase
    remaining: float
    problem: LutError | None = None


class LiveTake:
    """Collects skeletons until a sign is over. Knows no clock: the time comes with each call."""

    def __init__(self, *, started: float, countdown: float, longest: float = LONGEST_WAIT) -> None:
        """Begin the countdown.

        Args:
            started: Now [s].
            countdown: [s].
            longest: Time after the countdown in which the sign must end [s].

        Raises:
            LutError: "bad_countdown".
        """
        if not 0.0 <= countdown <= _MOST_COUNTDOWN:
            raise LutError(
                "bad_countdown", f"expected a countdown of 0 to {_MOST_COUNTDOWN:g} s, got {countdown:g} s"
            )
        self._begins = started + countdown
        self._ends = self._begins + longest
        self._looked = started
        self._problem: LutError | None = None
        self._done = False
        self.messages: list[Any] = []
        """What came since shortly before the sign: `SkeletonArray`, in order."""

    def add(self, message: Any, now: float) -> None:
        """Keep a message, unless the countdown has still long to go or the recording is over."""
        if self._done or now < self._begins - _BEFORE:
            return
        if not self.messages or stamp_of(message) > stamp_of(self.messages[-1]):
            self.messages.append(message)

    def step(self, now: float) -> LiveState:
        """Look whether the sign is over.

        Args:
            now: [s].
        """
        if self._problem is not None:
            return LiveState(phase=Phase.FAILED, remaining=0.0, problem=self._problem)
        if self._done:
            return LiveState(phase=Phase.DONE, remaining=0.0)
        if now < self._begins:
            return LiveState(phase=Phase.COUNTDOWN, remaining=self._begins - now)
        if now - self._looked >= _LOOK or now >= self._ends:
            self._looked = now
            self._done = self._is_over()
            if not self._done and now >= self._ends:
                self._problem = self._why_not()
        if self._done or self._problem is not None:
            return self.step(now)
        return LiveState(phase=Phase.SIGN, remaining=self._ends - now)

    def _is_over(self) -> bool:
        if not self.messages:
            return False
        try:
            track = track_of_people(self.messages, source="live")
        except LutError:
            return False  # nobody to be seen yet
        spans = find_signs(track)
        return bool(spans) and not spans[-1].cut_end and track.times[-1] - spans[-1].returns >= _STAYS

    def _why_not(self) -> LutError:
        waited = f"within {self._ends - self._begins:g} s after the countdown"
        if not self.messages:
            return LutError(
                "no_skeletons",
                f"expected messages on the topic skeletons {waited}, got none: is retriever_node running?",
            )
        if not any(skeleton.is_signer for message in self.messages for skeleton in message.skeletons):
            return LutError("no_person", f"expected a person before the camera {waited}, got nobody")
        return LutError(
            "no_motion",
            f"expected hands that leave rest and return {waited}, got none: sign after the countdown",
        )
