# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences on their way: announced by the translator, signed or refused by the executor, then history."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from msgspec.structs import replace

from teo_console.protocol import Caption, ExecutorState, Progress, Sentence

# Sentences that can be looked back at: a lesson's worth, and few enough to be sent whole.
HISTORY = 30
# Sentences that the translator announced and that nobody has taken up: a text's worth of them.
_ANNOUNCED = 200
# A path whose end is farther than this from the sentence's is another one's [s]: the arms' first rise while
# the sentence is planned, or one that the next sentence is already part of. Clock and speed are never so far
# off: the driver tells each change of speed within a tenth of a second.
_SAME_END = 1.0

_Key = tuple[str, int]


@dataclass(frozen=True, kw_only=True)
class SigningReport:
    """What the executor says."""

    stamp: float
    state: ExecutorState
    key: _Key | None
    """Utterance and index of the sentence that it is about; None if none."""
    duration: float
    captions: tuple[Caption, ...]
    """Planned signs with their times, while a sentence is signed."""
    code: str
    message: str


@dataclass(frozen=True, kw_only=True)
class PathReport:
    """What the driver says of the trajectory that it executes."""

    stamp: float
    """When it was true [s]."""
    speed: float
    """Trajectory's seconds a second, 0 to 1."""
    remaining: float | None
    """Of the trajectory [s]; None while there is none."""


class _SentenceProgress:
    """Follows a sentence's motion: by the driver's word where there is one, else by clock and speed."""

    def __init__(self, duration: float, began: float, speed: float) -> None:
        """Begin a sentence.

        Args:
            duration: Of its whole motion [s].
            began: When it began [s].
            speed: In force then, 0 to 1.
        """
        self._duration = duration
        self.told = Progress(stamp=began, elapsed=0.0, speed=speed)
        """As pages get it."""

    def path(self, report: PathReport) -> None:
        """Take what the driver says."""
        passed = self.told.elapsed + self.told.speed * max(report.stamp - self.told.stamp, 0.0)
        elapsed = min(passed, self._duration)
        # A trajectory ends with the sentence's motion: what remains of both is the same.
        if report.remaining is not None:
            told = self._duration - report.remaining
            if abs(told - elapsed) <= _SAME_END:
                elapsed = max(told, 0.0)
        self.told = Progress(stamp=report.stamp, elapsed=elapsed, speed=report.speed)


class Sentences:
    """What is announced, what is signed now, and what was before."""

    def __init__(self) -> None:
        """Begin without a sentence."""
        self._announced: dict[_Key, Sentence] = {}
        self._current: Sentence | None = None
        self._progress: _SentenceProgress | None = None
        self._history: deque[Sentence] = deque(maxlen=HISTORY)
        self._speed = 1.0

    @property
    def current(self) -> Sentence | None:
        """What is signed now."""
        return self._current

    @property
    def progress(self) -> Progress | None:
        """How far that is."""
        return None if self._progress is None else self._progress.told

    @property
    def history(self) -> tuple[Sentence, ...]:
        """What was signed or refused, the newest first."""
        return tuple(self._history)

    def announce(self, sentence: Sentence) -> None:
        """Take a sentence of the translator's."""
        self._announced[_key(sentence)] = sentence
        while len(self._announced) > _ANNOUNCED:
            del self._announced[next(iter(self._announced))]

    def report(self, report: SigningReport) -> None:
        """Take what the executor says."""
        match report.state:
            case "signing":
                self._sign(report)
            case "refused" if report.key is not None:
                self._refuse(report, report.key)
            case "idle":
                self._end_current()
            case _:
                pass  # it waits, is paused, stopped or at fault: what is signed now stays so

    def path(self, report: PathReport) -> None:
        """Take what the driver says of its path."""
        self._speed = report.speed
        if self._progress is not None:
            self._progress.path(report)

    def _sign(self, report: SigningReport) -> None:
        if report.key is None:
            return
        if self._current is not None and _key(self._current) != report.key:
            self._end_current()
        known = self._current or self._take(report.key)
        if self._current is None or self._progress is None:
            self._progress = _SentenceProgress(report.duration, report.stamp, self._speed)
        self._current = replace(
            known, state="signing", captions=report.captions, duration=report.duration, code="", message=""
        )

    def _refuse(self, report: SigningReport, key: _Key) -> None:
        if self._current is not None and _key(self._current) == key:
            sentence, self._current, self._progress = self._current, None, None
        else:
            sentence = self._take(key)
        self._history.appendleft(replace(sentence, state="refused", code=report.code, message=report.message))

    def _take(self, key: _Key) -> Sentence:
        return self._announced.pop(key) if key in self._announced else _unannounced(key)

    def _end_current(self) -> None:
        if self._current is not None:
            self._history.appendleft(replace(self._current, state="signed"))
        self._current = self._progress = None


def _key(sentence: Sentence) -> _Key:
    return sentence.utterance, sentence.index


def _unannounced(key: _Key) -> Sentence:
    """A sentence that was announced before the console listened, or that came as a goal of the action."""
    return Sentence(
        utterance=key[0],
        index=key[1],
        count=1,
        text="",
        form="statement",
        negated=False,
        uncertain=False,
        dropped=(),
        captions=(),
        state="waiting",
    )
