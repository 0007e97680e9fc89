# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether trajectories are taken, and at which pace they are executed: what people and faults decide."""

from __future__ import annotations

from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.follower_report import Mode

# Modes in which nothing is taken, the first that holds goes first; with the refusal's code and what to do.
_BLOCKING = {
    Mode.INACTIVE: (Refusal.INACTIVE, "activate it (`ros2 lifecycle set ... activate`), then send it again"),
    Mode.FAULT: (Refusal.FAULT, "mend the cause, call `rearm`, then send it again"),
    Mode.STOPPED: (Refusal.STOPPED, "call `rearm`, then send it again"),
    Mode.PAUSED: (Refusal.PAUSED, "resume, or stop and re-arm, then send it again"),
}


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
            return "paused" if self.paused else "the speed scaling factor is 0"
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
