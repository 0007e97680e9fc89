"""The rate at which something arrives."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple


class Rate(NamedTuple):
    """Statistics of the intervals in a window.

    Args:
        hertz: Inverse of the mean interval [1/s].
        shortest: Shortest interval [s].
        longest: Longest interval [s].
        deviation: Standard deviation of the intervals [s].
        intervals: Number of intervals looked back on.
    """

    hertz: float
    shortest: float
    longest: float
    deviation: float
    intervals: int


class RateMeter:
    """Measures the rate of arrivals over the latest ones.

    Args:
        window: Number of intervals to look back on.
    """

    def __init__(self, window: int) -> None:
        self._intervals: deque[int] = deque(maxlen=window)
        self._last: int | None = None

    def arrive(self, time: int) -> None:
        """Note an arrival [ns]; one before the last (a clock was set back) starts the measurement anew."""
        if self._last is not None:
            if time < self._last:
                self._intervals.clear()
            else:
                self._intervals.append(time - self._last)
        self._last = time

    @property
    def last(self) -> int | None:
        """Time of the latest arrival [ns], None before the first."""
        return self._last

    def rate(self) -> Rate | None:
        """Return the rate, or None before there is an interval."""
        count = len(self._intervals)
        if not count:
            return None
        mean = sum(self._intervals) / count
        variance = sum((interval - mean) ** 2 for interval in self._intervals) / count
        return Rate(
            hertz=1e9 / mean if mean > 0 else 0.0,
            shortest=min(self._intervals) * 1e-9,
            longest=max(self._intervals) * 1e-9,
            deviation=math.sqrt(variance) * 1e-9,
            intervals=count,
        )
