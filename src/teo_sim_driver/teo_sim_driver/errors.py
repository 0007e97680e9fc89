# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver raises: one base class, and the reasons for which it refuses a trajectory."""

from __future__ import annotations

from enum import StrEnum


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
    """A trajectory was refused, and nothing of it is executed. `code` is a value of `Refusal`."""

    def __init__(self, code: Refusal, sentence: str) -> None:
        super().__init__(code.value, sentence)
