# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How many requests somebody may make: a token bucket."""

from __future__ import annotations


class RateLimit:
    """Lets through a burst, then a steady rate. Times are from a clock that nobody sets [s]."""

    def __init__(self, *, rate: float, burst: int) -> None:
        """Begin with a whole burst to spend.

        Args:
            rate: Requests a second in the long run [Hz].
            burst: Requests at once.
        """
        self._rate = rate
        self._burst = burst
        self._left = float(burst)
        self._at: float | None = None

    def take(self, now: float) -> bool:
        """Whether one more request may pass at this time."""
        if self._at is not None:
            self._left = min(self._left + (now - self._at) * self._rate, self._burst)
        self._at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True
