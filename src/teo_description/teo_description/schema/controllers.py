# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What ``robot.yaml`` says of the robot's own controllers."""

from __future__ import annotations

from typing import Literal

import msgspec

from teo_description.schema.body import Groups
from teo_description.schema.urdf import Finite, Positive


class Setpoint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the controller of a hand's axis counts in: a straight line of the joint's angle."""

    unit: Literal["deg", "mm"]
    """Degrees of a servo, or millimetres of a tendon."""
    travel: Positive
    """Greatest set-point, in that unit; the least is 0."""
    low_deg: Finite
    """Joint angle at set-point 0."""
    high_deg: Finite
    """Joint angle at the greatest set-point."""


class HandSetpoints(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The axes of either hand as their controllers count them."""

    abductor: Setpoint
    thumb: Setpoint
    finger: Setpoint


class Servo(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The drive of a joint, seen from the joint."""

    torque: Positive
    """The most that it gives, without losses [N m]."""
    inertia: Positive
    """Of the motor's rotor [kg m^2]."""


class Servos(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The drives of the commanded joints."""

    body: dict[str, Servo]
    """By joint of head, trunk and arms."""
    hand: Servo
    """Of every axis of a hand."""


class Controllers(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is published of the robot's own controllers; nobody needs it to have the robot sign."""

    boards: dict[str, str]
    """Names of the control boards, by limb: head, trunk, left_arm, right_arm, left_hand, right_hand."""
    hands: HandSetpoints
    servos: Servos

    def __post_init__(self) -> None:
        """Refuse boards of other limbs than there are."""
        limbs = set(Groups.__struct_fields__)
        if set(self.boards) != limbs:
            raise ValueError(f"boards: expected {', '.join(sorted(limbs))}, got {', '.join(self.boards)}")
