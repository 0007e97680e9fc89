"""How regularly the steps come."""

from __future__ import annotations

from typing import NamedTuple


class RateReport(NamedTuple):
    """Over the time since the last report."""

    rate: float
    """Steps per second [Hz]; 0 with fewer than two steps."""
    longest_gap: float
    """Longest time between two steps [s]."""
    longest_step: float
    """Longest time that one step took [s]."""


class RateMeter:
    """Counts steps between reports. Times are from a clock that nobody sets [s]."""

    def __init__(self) -> None:
        self._first: float | None = None
        self._last = 0.0
        self._count = 0
        self._longest_gap = 0.0
        self._longest_step = 0.0

    def step(self, begin: float, end: float) -> None:
        """Enter a step that began and ended at these times [s]."""
        if self._first is None:
            self._first = begin
        else:
            self._longest_gap = max(self._longest_gap, begin - self._last)
            self._count += 1
        self._last = begin
        self._longest_step = max(self._longest_step, end - begin)

    def report(self) -> RateReport:
        """Report, and begin anew from the last step."""
        span = 0.0 if self._first is None else self._last - self._first
        report = RateReport(self._count / span if span > 0.0 else 0.0, self._longest_gap, self._longest_step)
        self._first = None if self._first is None else self._last
        self._count, self._longest_gap, self._longest_step = 0, 0.0, 0.0
        return report
