"""Time as the motion sees it: it only ever goes forward, and never by a leap."""

from __future__ import annotations

from teo_sim_driver.plain_message import SECOND

LONGEST_GAP = 0.5
"""Longest gap between two steps that the motion follows [s]: longer than checking the longest message
takes. A greater one is a clock that was set or a process that stood still, and no path is cut short for
either."""


class PathClock:
    """Turns clock readings into steps of time."""

    def __init__(self, period: float) -> None:
        """Start without a reading.

        Args:
            period: usual time between steps [s].
        """
        self._period = period
        self._last: int | None = None
        self.jumps = 0
        """Readings that went back, or too far ahead."""

    def advance(self, now: int) -> float:
        """Time since the last reading [s]; one period where the clock jumped, as a step was made.

        Args:
            now: reading [ns].
        """
        last, self._last = self._last, now
        if last is None:
            return 0.0
        gap = (now - last) / SECOND
        if 0.0 <= gap <= LONGEST_GAP:
            return gap
        self.jumps += 1
        return self._period
