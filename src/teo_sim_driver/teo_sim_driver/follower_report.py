# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver is doing, whether it takes trajectories, and what it says about itself."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import dataclass, field
from enum import StrEnum

from teo_common.diagnostics import Diagnosis, Level, RateReport
from teo_sim_driver.rules import Refusal, TrajectoryError


class Mode(StrEnum):
    """What the driver is doing, and whether it takes trajectories: only in the first two."""

    HOLDING = "holding"
    MOVING = "moving"
    PAUSED = "paused"
    STOPPED = "stopped"
    INACTIVE = "inactive"
    FAULT = "fault"


class Source(StrEnum):
    """How a trajectory came."""

    NONE = ""
    TOPIC = "topic"
    ACTION = "action"


# Refusals that are kept to be told of [1]: as many as a topic holds of what a sender sends at once.
_KEPT = 10


@dataclass
class Tally:
    """What has happened since the start; attributes as those of `FollowerReport`."""

    accepted: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    refusals: deque[TrajectoryError] = field(default_factory=lambda: deque(maxlen=_KEPT))
    limited_steps: int = 0
    limited_joints: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class FollowerReport:
    """What goes on, and what has happened since the start."""

    mode: Mode
    at_rest: bool
    source: Source
    """Who gave the newest trajectory that is being executed."""
    commands: tuple[str, ...]
    """All that are being executed, such as ``left_arm action``; the oldest first."""
    speed_scaling: float
    """In force now: trajectory time per time, 0..1."""
    path_time: float
    """Trajectory time that has been executed [s]; 0 when nothing is."""
    path_duration: float
    """Of the trajectory that is being executed [s]; 0 when nothing is."""
    reason: str
    """Why it is paused, stopped, inactive or in fault; empty otherwise."""
    accepted: int
    refused: dict[str, int]
    """Refusal code to number of messages."""
    refusals: tuple[TrajectoryError, ...]
    """The last of them, the newest last."""
    limited_steps: int
    """Steps that the guard changed. Anything but 0 is a fault of this driver."""
    limited_joints: tuple[str, ...]
    """Joints that the guard held back last."""
    clock_jumps: int

    @property
    def last_refusal(self) -> TrajectoryError | None:
        """The newest; None before the first."""
        return self.refusals[-1] if self.refusals else None


# Modes in which nothing is taken, the first that holds goes first; with the refusal's code and what to do.
_BLOCKING = {
    Mode.INACTIVE: (Refusal.INACTIVE, "activate it (`ros2 lifecycle set ... activate`), then send it again"),
    Mode.FAULT: (Refusal.FAULT, "mend the cause, call `rearm`, then send it again"),
    Mode.STOPPED: (Refusal.STOPPED, "call `rearm`, then send it again"),
    Mode.PAUSED: (Refusal.PAUSED, "let it, or stop and re-arm it, then send it again"),
}

_NO_PACE = "the speed scaling factor is 0: it goes on at a greater one, sent on `speed_scaling_input`"


class Gate:
    """Open unless it is blocked or paused."""

    def __init__(self) -> None:
        self.blocks: dict[Mode, str] = {}
        """Modes in which nothing moves until they are released, and why."""
        self.paused = False
        """Whether somebody paused it."""
        self.scaling = 1.0
        """Speed scaling factor that was asked for, 0..1."""

    @property
    def pace(self) -> float:
        """At which the path is to be executed, 0..1."""
        return 0.0 if self.paused else self.scaling

    def mode(self, moving: bool) -> Mode:
        """What it is doing, if a trajectory is being executed or not."""
        for mode in _BLOCKING:
            if mode in self.blocks:
                return mode
        if self.pace == 0.0:
            return Mode.PAUSED
        return Mode.MOVING if moving else Mode.HOLDING

    def reason(self, mode: Mode) -> str:
        """Why it is paused, stopped, inactive or in fault; empty in the other modes."""
        if mode is Mode.PAUSED:
            return "paused: it goes on at `resume`" if self.paused else _NO_PACE
        return self.blocks.get(mode, "")

    def check(self, moving: bool) -> None:
        """Let a trajectory through.

        Raises:
            TrajectoryError: in a mode in which nothing is taken.
        """
        mode = self.mode(moving)
        if mode in _BLOCKING:
            code, remedy = _BLOCKING[mode]
            raise TrajectoryError(code, f"{self.reason(mode)}: {remedy}")


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
