# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the follower says about itself."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from enum import StrEnum

from teo_sim_driver.errors import TrajectoryError


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


@dataclass
class Tally:
    """What has happened since the start; attributes as those of `FollowerReport`."""

    accepted: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    last_refusal: TrajectoryError | None = None
    limited_steps: int = 0
    limited_joints: tuple[str, ...] = ()

    def refuse(self, refusal: TrajectoryError) -> None:
        """Enter a refusal."""
        self.refused[refusal.code] += 1
        self.last_refusal = refusal


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
    last_refusal: TrajectoryError | None
    limited_steps: int
    """Steps that the guard changed. Anything but 0 is a fault of this driver."""
    limited_joints: tuple[str, ...]
    """Joints that the guard held back last."""
    clock_jumps: int
