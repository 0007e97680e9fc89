# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver accepts, beyond the limits of the joints."""

from __future__ import annotations

from dataclasses import dataclass

# How far a position may be beyond a joint limit [rad]: one count of an arm's motor encoder, 0.00088 deg, the
# finest step that the robot has. It admits the rounding of poses that sit exactly on a limit.
POSITION_TOLERANCE = 1.5e-5

# How far a velocity may be beyond a joint limit, as a part of the limit. A planner that keeps within the
# limit at its own points swings beyond it by about this much between them, where its jerk changes.
VELOCITY_TOLERANCE = 1e-3

# Below this a joint stands still [rad/s]: an encoder count would take 15 s.
REST_VELOCITY = 1e-6


@dataclass(frozen=True, kw_only=True)
class Rules:
    """Limits on a message. The defaults are the node's."""

    start_tolerance: float = 0.01
    """How far the robot may be from a first point that is due at the start [rad]; MoveIt's
    allowed_start_tolerance has the same default."""

    max_duration: float = 600.0
    """Longest trajectory [s]. A long sentence takes a minute; ten times that is a mistake of units."""

    max_points: int = 20000
    """Most points in a message: 200 s at 100 Hz."""

    max_start_delay: float = 60.0
    """How far ahead a start may be scheduled [s]; more means that the clocks do not agree."""

    allow_partial_joints_goal: bool = False
    """Whether a message may leave joints out; they hold their position. Off, as
    joint_trajectory_controller has it, because a forgotten joint is more often a mistake than a wish."""
