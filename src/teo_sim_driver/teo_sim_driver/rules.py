# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver accepts beyond the limits of the joints, which joints go together, and why it refuses."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from teo_description.humanoid import Humanoid


class DriverError(Exception):
    """Base of everything this package raises.

    Attributes:
        code: Stable reason, for programs.
        sentence: What was expected, what came and what to do, for people.
    """

    def __init__(self, code: str, sentence: str) -> None:
        super().__init__(f"{code}: {sentence}")
        self.code = code
        self.sentence = sentence


class Refusal(StrEnum):
    """Why a trajectory was refused. The values are stable: other programs may compare them."""

    NO_JOINTS = "no_joints"
    DUPLICATE_JOINT = "duplicate_joint"
    UNKNOWN_JOINT = "unknown_joint"
    HELD_JOINT = "held_joint"
    OTHER_GROUP = "other_group"
    MISSING_JOINTS = "missing_joints"
    NO_POINTS = "no_points"
    TOO_MANY_POINTS = "too_many_points"
    WRONG_LENGTH = "wrong_length"
    ACCELERATIONS_WITHOUT_VELOCITIES = "accelerations_without_velocities"
    EFFORT_GIVEN = "effort_given"
    BAD_TIME = "bad_time"
    NEGATIVE_TIME = "negative_time"
    TIMES_NOT_INCREASING = "times_not_increasing"
    TOO_LONG = "too_long"
    ENDS_IN_THE_PAST = "ends_in_the_past"
    STARTS_TOO_LATE = "starts_too_late"
    NOT_FINITE = "not_finite"
    POSITION_LIMIT = "position_limit"
    VELOCITY_LIMIT = "velocity_limit"
    MOVING_AT_END = "moving_at_end"
    SPEED_BETWEEN_POINTS = "speed_between_points"
    POSITION_BETWEEN_POINTS = "position_between_points"
    VELOCITY_BETWEEN_POINTS = "velocity_between_points"
    START_MISMATCH = "start_mismatch"
    START_TOO_FAST = "start_too_fast"
    START_LEAVES_LIMITS = "start_leaves_limits"
    STOPPING = "stopping"
    PAUSED = "paused"
    STOPPED = "stopped"
    FAULT = "fault"
    INACTIVE = "inactive"
    BAD_TOLERANCE = "bad_tolerance"
    MULTI_DOF = "multi_dof"
    BAD_ENCODING = "bad_encoding"
    TOO_LARGE = "too_large"
    TOO_MANY_WAITING = "too_many_waiting"
    INTERNAL = "internal"


class TrajectoryError(DriverError):
    """A trajectory was refused, and nothing of it is executed. `code` is a value of `Refusal`.

    Attributes:
        frame_id: Of the trajectory's header; empty if it has none, or is not known.
    """

    def __init__(self, code: Refusal, sentence: str) -> None:
        super().__init__(code.value, sentence)
        self.frame_id = ""


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


class JointGroup(NamedTuple):
    """Joints that one trajectory is about."""

    name: str
    """What its topic, its action and its status are found under; empty for the whole body."""
    joints: tuple[str, ...]

    @property
    def prefix(self) -> str:
        """What the names of its topic and action begin with."""
        return f"{self.name}/" if self.name else ""


def joint_groups(humanoid: Humanoid) -> tuple[JointGroup, ...]:
    """The whole body, then each limb that has joints."""
    limbs = (JointGroup(name, joints) for name, joints in humanoid.limbs.items() if joints)
    return JointGroup("", humanoid.commanded_joints), *limbs
