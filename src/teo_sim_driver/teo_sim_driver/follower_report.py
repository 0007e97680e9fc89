# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the follower says about itself."""

from __future__ import annotations

from dataclasses import dataclass
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
    """Who gave the trajectory that is being executed."""

    NONE = ""
    TOPIC = "topic"
    ACTION = "action"


@dataclass(frozen=True, kw_only=True)
class FollowerReport:
    """What goes on, and what has happened since the start."""

    mode: Mode
    at_rest: bool
    source: Source
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
