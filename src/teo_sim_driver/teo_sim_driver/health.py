"""What the driver says about itself."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

from teo_sim_driver.joint_follower import FollowerReport
from teo_sim_driver.rate_meter import RateReport

# A tenth below the nominal rate: beyond the jitter of a busy machine.
_SLOW = 0.9


class Level(IntEnum):
    """Levels of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


class Health(NamedTuple):
    """One line for people, and the values."""

    level: Level
    message: str
    values: dict[str, str]


def assess(
    report: FollowerReport, rate: RateReport, *, nominal_rate: float, before: FollowerReport | None = None
) -> Health:
    """Judge the driver's state.

    Args:
        report: of the follower, now.
        rate: since the last time.
        nominal_rate: what the rate should be [Hz].
        before: the follower's report of the last time; what is new since then is judged.
    """
    level, message = Level.OK, str(report.activity)
    refused = sum(report.refused.values())
    if refused > (sum(before.refused.values()) if before else 0) and report.last_refusal:
        level, message = Level.WARN, f"trajectory refused: {report.last_refusal.code}"
    elif 0.0 < rate.rate < _SLOW * nominal_rate:
        level, message = Level.WARN, f"{rate.rate:.1f} steps per second instead of {nominal_rate:g}"
    if report.limited_steps > (before.limited_steps if before else 0):
        level, message = Level.ERROR, f"steps limited: {', '.join(report.limited_joints)}"
    return Health(level, message, _values(report, rate, refused))


def _values(report: FollowerReport, rate: RateReport, refused: int) -> dict[str, str]:
    last = report.last_refusal
    values = {
        "state": str(report.activity),
        "elapsed [s]": f"{report.elapsed:.3f}",
        "duration [s]": f"{report.duration:.3f}",
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
