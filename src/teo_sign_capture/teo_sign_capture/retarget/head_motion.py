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
_MOVES = np.radians(8.0)
# Share of the frames in which a head must be seen to take part: else most of its motion would be made up.
_SEEN = 0.5


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
    """Let TEO's head follow, as far as its two joints go; it cannot tilt to the side.

    A head that is not seen in half of the frames takes no part.
    """
    places = np.where(np.isfinite(head.places), head.places, person.head)
    axes, turns, moves, error = _followed(
        Rotation.from_matrix(head.turns), HEAD, taking_part=float(head.seen.mean()) >= _SEEN
    )
    pivot = robot.placement(robot.configuration({}), f"{HEAD[1]}_link")[:3, 3]
    return HeadMotion(head.turns, places, turns.as_matrix(), pivot, axes, moves, error)


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
    axes, _, moves, error = _followed(Rotation.from_rotvec(trunk), TRUNK)
    return TrunkMotion(axes, moves, error)


def _followed(
    person: Rotation, joints: tuple[str, ...], *, taking_part: bool = True
) -> tuple[Array, Rotation, bool, Array]:
    """Two joints that yaw and pitch, their turn, whether they move, and the angle left to the person's.

    Args:
        person: T turns of the person's.
        joints: `HEAD` or `TRUNK`.
        taking_part: Whether they may move at all.

    Returns:
        Positions of the joints [rad], shape (T, 2), T turns, whether any moves, and angles [rad], shape (T,).
    """
    yaw, pitch, _ = person.as_euler("ZYX").T
    wanted = np.stack([yaw, pitch], axis=1)
    limits = joint_limits(joints)
    moves = taking_part and bool(np.abs(wanted).max() >= _MOVES)
    axes = np.clip(wanted, limits.lower, limits.upper) if moves else np.zeros_like(wanted)
    turns = Rotation.from_euler("ZY", axes)
    return axes, turns, moves, (turns.inv() * person).magnitude()
