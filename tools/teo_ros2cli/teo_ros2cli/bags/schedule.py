# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""When to publish what a bag holds."""

from __future__ import annotations


class Schedule:
    """Translates the times of a bag to moments of a steady clock, at a rate that may change, with pauses.

    Args:
        origin: Time of the bag that is due at once [ns].
        now: Moment at which playing starts [s of a steady clock].
        rate: Seconds of the bag in one second of the clock.
        paused: Begin with a pause.
    """

    def __init__(self, origin: int, now: float, *, rate: float = 1.0, paused: bool = False) -> None:
        self._bag = origin
        self._now = now
        self._rate = rate
        self._paused = paused

    @property
    def paused(self) -> bool:
        """True in a pause."""
        return self._paused

    @property
    def rate(self) -> float:
        """Seconds of the bag in one second of the clock."""
        return self._rate

    def due(self, time: int) -> float:
        """Return the moment [s] at which a time of the bag [ns] is due, as if a pause had just ended."""
        return self._now + (time - self._bag) * 1e-9 / self._rate

    def time_at(self, now: float) -> int:
        """Return the time of the bag [ns] at a moment [s]."""
        if self._paused:
            return self._bag
        return self._bag + round((now - self._now) * self._rate * 1e9)

    def pause(self, now: float) -> None:
        """Stop the time of the bag at a moment [s]."""
        self._settle(now)
        self._paused = True

    def resume(self, now: float) -> None:
        """Let the time of the bag run on from a moment [s]."""
        self._settle(now)
        self._paused = False

    def set_rate(self, rate: float, now: float) -> None:
        """Change the rate from a moment [s] on."""
        self._settle(now)
        self._rate = rate

    def _settle(self, now: float) -> None:
        self._bag = self.time_at(now)
        self._now = now
