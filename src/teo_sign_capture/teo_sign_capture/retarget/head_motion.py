# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""TEO's head and trunk following a person's."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description import HEAD, TRUNK, joint_limits
from teo_description.robot import Robot
from teo_sign_capture.tracks.head_pose import HeadPose
from teo_sign_capture.tracks.person import Person

# [rad] A head or trunk that never leaves straight by more than this does not sign: people sway by 3 deg and
# nod by 4 deg while they sign.
_HEAD_MOVES, _TRUNK_MOVES = np.radians(8.0), np.radians(8.0)


class HeadMotion(NamedTuple):
    """A person's head and TEO's over time.

    Attributes:
        turns: The person's head, turned from straight. Shape (T, 3, 3).
        places: The middle of the person's head [m]. Shape (T, 3).
        robot_turns: TEO's head, turned from home against the trunk. Shape (T, 3, 3).
        pivot: What it turns about, in ``base_link`` [m]. Shape (3,).
        axes: TEO's `HEAD` [rad]. Shape (T, 2).
        moves: Whether it moves.
        error: Angle that is left between both heads [rad]. Shape (T,).
    """

    turns: Array
    places: Array
    robot_turns: Array
    pivot: Array
    axes: Array
    moves: bool
    error: Array


def follow_head(robot: Robot, head: HeadPose, person: Person) -> HeadMotion:
    """Let TEO's head follow, as far as its two joints go; it cannot tilt to the side."""
    places = np.where(np.isfinite(head.places), head.places, person.head)
    yaw, pitch, _ = Rotation.from_matrix(head.turns).as_euler("ZYX").T
    wanted = np.stack([yaw, pitch], axis=1)
    limits = joint_limits(HEAD)
    moves = bool(np.abs(wanted).max() >= _HEAD_MOVES)
    axes = np.clip(wanted, limits.lower, limits.upper) if moves else np.zeros_like(wanted)
    turns = Rotation.from_euler("ZY", axes)
    left = turns.inv() * Rotation.from_matrix(head.turns)
    pivot = robot.placement(robot.configuration({}), f"{HEAD[1]}_link")[:3, 3]
    return HeadMotion(head.turns, places, turns.as_matrix(), pivot, axes, moves, left.magnitude())


class TrunkMotion(NamedTuple):
    """TEO's trunk over time.

    Attributes:
        axes: TEO's `TRUNK` [rad]. Shape (T, 2).
        moves: Whether it moves.
        error: Angle that is left to the person's trunk [rad]. Shape (T,).
    """

    axes: Array
    moves: bool
    error: Array


def follow_trunk(trunk: Array) -> TrunkMotion:
    """Let TEO's trunk follow, as far as its two joints go; it cannot lean to the side.

    Args:
        trunk: `SkeletonTrack.trunk`, zeros where it is not known [rad]. Shape (T, 3).
    """
    person = Rotation.from_rotvec(trunk)
    yaw, pitch, _ = person.as_euler("ZYX").T
    wanted = np.stack([yaw, pitch], axis=1)
    limits = joint_limits(TRUNK)
    moves = bool(np.abs(wanted).max() >= _TRUNK_MOVES)
    axes = np.clip(wanted, limits.lower, limits.upper) if moves else np.zeros_like(wanted)
    left = Rotation.from_euler("ZY", axes).inv() * person
    return TrunkMotion(axes, moves, left.magnitude())
