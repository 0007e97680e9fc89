# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver says about itself: its diagnosis, and a line for refusals."""

from __future__ import annotations

from teo_common.diagnostics import Diagnosis, Level, RateReport
from teo_sim_driver.errors import TrajectoryError
from teo_sim_driver.follower_report import FollowerReport, Mode

# A tenth below the nominal rate: beyond the jitter of a busy machine.
_SLOW = 0.9

# After a refusal was logged, those of the same code are only counted for this long [s].
_QUIET = 1.0


def assess(
    report: FollowerReport, rate: RateReport, *, nominal_rate: float, before: FollowerReport | None = None
) -> Diagnosis:
    """Judge the driver's state.

    Args:
        report: Of the follower, now.
        rate: Since the last time.
        nominal_rate: What the rate should be [Hz].
        before: The follower's report of the last time; what is new since then is judged.
    """
    level, message = Level.OK, str(report.mode)
    if report.reason:
        message += f": {report.reason}"
        level = Level.ERROR if report.mode is Mode.FAULT else Level.WARN
    refused = sum(report.refused.values())
    if level is Level.ERROR:
        pass
    elif refused > (sum(before.refused.values()) if before else 0) and report.last_refusal:
        level, message = Level.WARN, f"trajectory refused: {report.last_refusal.code}"
    elif 0.0 < rate.rate < _SLOW * nominal_rate:
        level, message = Level.WARN, f"{rate.rate:.1f} steps per second instead of {nominal_rate:g}"
    if report.limited_steps > (before.limited_steps if before else 0):
        level, message = Level.ERROR, f"steps limited: {', '.join(report.limited_joints)}"
    return Diagnosis(level, message, _values(report, rate, refused))


def _values(report: FollowerReport, rate: RateReport, refused: int) -> dict[str, str]:
    last = report.last_refusal
    values = {
        "state": str(report.mode),
        "reason": report.reason,
        "commanded by": ", ".join(report.commands),
        "speed scaling": f"{report.speed_scaling:.3f}",
        "elapsed [s]": f"{report.path_time:.3f}",
        "duration [s]": f"{report.path_duration:.3f}",
        "accepted": str(report.accepted),
        "refused": str(refused),
        "last refusal code": last.code if last else "",
        "last refusal": last.sentence if last else "",
        "limited steps": str(report.limited_steps),
        "limited joints": ", ".join(report.limited_joints),
        "clock jumps": str(report.clock_jumps),
        "rate [Hz]": f"{rate.rate:.1f}",
        "longest gap [ms]": f"{1e3 * rate.longest_gap:.1f}",
        "longest step [ms]": f"{1e3 * rate.longest_step:.2f}",
    }
    values.update({f"refused {code}": str(count) for code, count in sorted(report.refused.items())})
    return values


class RefusalLog:
    """Decides which refusals are logged, so that a sender that goes wrong often does not fill the disk."""

    def __init__(self) -> None:
        self._logged_at: dict[str, float] = {}
        self._unlogged: dict[str, int] = {}

    def line(self, refusal: TrajectoryError, now: float) -> str | None:
        """Line to log, or None to be quiet.

        Args:
            refusal: What happened.
            now: On a clock that nobody sets [s].
        """
        logged_at = self._logged_at.get(refusal.code)
        if logged_at is not None and now - logged_at < _QUIET:
            self._unlogged[refusal.code] = self._unlogged.get(refusal.code, 0) + 1
            return None
        self._logged_at[refusal.code] = now
        more = self._unlogged.pop(refusal.code, 0)
        line = f"trajectory refused ({refusal.code}): {refusal.sentence}"
        return f"{line} [{more} more of this code since the last line]" if more else line
