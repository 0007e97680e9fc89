# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A robot's head and trunk following a person's."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_description.robot_schema import Turning
from teo_sign_capture.signing_space import find_place
from teo_sign_capture.tracks.head_pose import HeadPose
from teo_sign_capture.tracks.signer_motion import Person

# [rad] A head or trunk that never leaves straight by more than this does not sign: people sway by 3 deg and
# nod by 4 deg while they sign.
_MOVES = np.radians(8.0)
# Share of the frames in which a head must be seen to take part: else most of its motion would be made up.
_SEEN = 0.5


class HeadMotion(NamedTuple):
    """A person's head and a robot's over time.

    Attributes:
        turns: The person's head, turned from straight. Shape (T, 3, 3).
        places: The middle of the person's head [m]. Shape (T, 3).
        robot_turns: The robot's head, turned from home against the trunk. Shape (T, 3, 3).
        pivot: What it turns about, in ``base_link`` [m]. Shape (3,).
        axes: Of the joints of the robot's head [rad]. Shape (T, k).
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
    """Let the robot's head follow, as far as its joints go.

    A head that is not seen in half of the frames takes no part.
    """
    places = np.where(np.isfinite(head.places), head.places, person.head)
    followed = _followed(
        robot,
        Rotation.from_matrix(head.turns),
        robot.humanoid.file.groups.head,
        taking_part=float(head.seen.mean()) >= _SEEN,
    )
    last = robot.humanoid.head[-1:]
    # A head that does not move turns about its neck as well as about anything.
    pivot = (
        robot.joint_placements(robot.configuration({}), last)[0, :3, 3]
        if last
        else find_place(robot.humanoid, "throat").point
    )
    return HeadMotion(
        head.turns, places, followed.turns.as_matrix(), pivot, followed.axes, followed.moves, followed.error
    )


class JointMotion(NamedTuple):
    """A robot's head or trunk over time.

    Attributes:
        axes: Of its joints [rad]. Shape (T, k).
        turns: How these turn it, T of them.
        moves: Whether it moves.
        error: Angle that is left to the person's [rad]. Shape (T,).
    """

    axes: Array
    turns: Rotation
    moves: bool
    error: Array


def follow_trunk(robot: Robot, trunk: Array) -> JointMotion:
    """Let the robot's trunk follow, as far as its joints go.

    Args:
        robot: The robot.
        trunk: `SkeletonTrack.trunk`, zeros where it is not known [rad]. Shape (T, 3).
    """
    return _followed(robot, Rotation.from_rotvec(trunk), robot.humanoid.file.groups.trunk)


# The axes about which joints turn, as Euler angles are written about moving axes.
_LETTERS = {"yaw": "Z", "pitch": "Y", "roll": "X"}


def _followed(robot: Robot, person: Rotation, joints: Turning, *, taking_part: bool = True) -> JointMotion:
    """Let joints follow.

    Args:
        robot: The robot.
        person: T turns of the person's.
        joints: By what they do, yaw, pitch or roll; the first carries the others.
        taking_part: Whether they may move at all.
    """
    names = tuple(joints.values())
    order = "".join(_LETTERS[way] for way in joints)
    rest = "".join(letter for letter in _LETTERS.values() if letter not in order)
    wanted = person.as_euler(order + rest)[:, : len(order)]
    # URDFs have joints that turn the other way.
    signs = np.array([robot.joint_axis(name).sum() for name in names])
    limits = robot.humanoid.limits(names)
    moves = taking_part and bool(np.abs(wanted).max(initial=0.0) >= _MOVES)
    axes = np.clip(signs * wanted, limits.lower, limits.upper) if moves else np.zeros_like(wanted)
    turns = Rotation.from_euler(order, signs * axes) if order else Rotation.identity(len(person))
    return JointMotion(axes, turns, moves, (turns.inv() * person).magnitude())
