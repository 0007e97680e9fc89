"""Every refusal is logged, but a sender that goes wrong a thousand times a second does not fill the disk."""

from __future__ import annotations

from teo_sim_driver.errors import TrajectoryError

QUIET = 1.0
"""After a refusal was logged, those of the same code are only counted for this long [s]."""


class RefusalLog:
    """Decides which refusals are worth a line, and says how many were not."""

    def __init__(self) -> None:
        self._logged_at: dict[str, float] = {}
        self._unlogged: dict[str, int] = {}

    def line(self, refusal: TrajectoryError, now: float) -> str | None:
        """Line to log, or None to be quiet.

        Args:
            refusal: what happened.
            now: on a clock that nobody sets [s].
        """
        logged_at = self._logged_at.get(refusal.code)
        if logged_at is not None and now - logged_at < QUIET:
            self._unlogged[refusal.code] = self._unlogged.get(refusal.code, 0) + 1
            return None
        self._logged_at[refusal.code] = now
        more = self._unlogged.pop(refusal.code, 0)
        line = f"trajectory refused ({refusal.code}): {refusal.sentence}"
        return f"{line} [{more} more of this code since the last line]" if more else line
