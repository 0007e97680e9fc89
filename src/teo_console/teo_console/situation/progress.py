# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far the current sentence is, from what the driver says of its path."""

from __future__ import annotations

from dataclasses import dataclass

from teo_console.protocol.to_page import Progress

# A path whose end is farther than this from the sentence's is another one's [s]: the arms' first rise while
# the sentence is planned, or one that the next sentence is already part of. Clock and speed are never so far
# off: the driver tells each change of speed within a tenth of a second.
_SAME_END = 1.0


@dataclass(frozen=True, kw_only=True)
class PathReport:
    """What the driver says of the trajectory that it executes."""

    stamp: float
    """When it was true [s]."""
    speed: float
    """Trajectory's seconds a second, 0 to 1."""
    remaining: float | None
    """Of the trajectory [s]; None while there is none."""


class SentenceProgress:
    """Follows a sentence's motion: by the driver's word where there is one, else by clock and speed."""

    def __init__(self, duration: float, began: float, speed: float) -> None:
        """Begin a sentence.

        Args:
            duration: Of its whole motion [s].
            began: When it began [s].
            speed: In force then, 0 to 1.
        """
        self._duration = duration
        self._progress = Progress(stamp=began, elapsed=0.0, speed=speed)

    def path(self, report: PathReport) -> None:
        """Take what the driver says."""
        elapsed = self.elapsed(report.stamp)
        # A trajectory ends with the sentence's motion: what remains of both is the same.
        if report.remaining is not None:
            told = self._duration - report.remaining
            if abs(told - elapsed) <= _SAME_END:
                elapsed = max(told, 0.0)
        self._progress = Progress(stamp=report.stamp, elapsed=elapsed, speed=report.speed)

    def elapsed(self, now: float) -> float:
        """Time since the motion began, in the motion's own seconds [s]."""
        progress = self._progress
        passed = progress.elapsed + progress.speed * max(now - progress.stamp, 0.0)
        return min(passed, self._duration)

    def report(self) -> Progress:
        """As pages get it."""
        return self._progress
