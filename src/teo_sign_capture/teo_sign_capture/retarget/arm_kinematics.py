# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""TEO's right arm at many poses at once.

Pinocchio gives one pose a call, most of which is Python; a motion of some hundred frames sought from several
starts asks for thousands of poses a step. Here they are all worked out together. The geometry is read off the
robot's model: every joint of the arm turns about one of the axes of its link, and all links are parallel to
the base while the arm hangs.

The left arm is the right one in a mirror (`arm_bounds.mirrored`): what is said here of the right arm is
used for both.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_description import RIGHT_ARM
from teo_description.robot import Robot

# Joints whose axes go through the elbow and the wrist.
ELBOW, WRIST = 3, 5


class ArmPoses(NamedTuple):
    """Where n arms are, in ``base_link`` with the trunk at home.

    Attributes:
        axes: Of the six joints, unit vectors. Shape (n, 6, 3).
        origins: A point on each axis [m]. Shape (n, 6, 3).
        rotation: Of the palm; columns along the hand, to the little finger's side, out of the palm.
            Shape (n, 3, 3).
        place: Of the palm [m]. Shape (n, 3).
    """

    axes: Array
    origins: Array
    rotation: Array
    place: Array

    def points(self, local: Array) -> Array:
        """Points of the hand, from the palm's axes to the base's [m]. Shape (n, 3) each."""
        placed: Array = np.einsum("nij,nj->ni", self.rotation, local) + self.place
        return placed

    def point_jacobian(self, points: Array) -> Array:
        """How points that all joints carry move with them [m/rad]. Shape (n, 3, 6)."""
        return _cross(self.axes, points[:, None] - self.origins)

    def direction_jacobian(self, directions: Array) -> Array:
        """The same of directions [1/rad]. Shape (n, 3, 6)."""
        return _cross(self.axes, directions[:, None])


class ArmKinematics:
    """The right arm of one robot."""

    def __init__(self, robot: Robot) -> None:
        q = robot.configuration(dict.fromkeys(RIGHT_ARM, 0.0))
        placed = robot.placements(q, [f"{joint}_link" for joint in RIGHT_ARM])
        self.shoulder: Array = placed[1, :3, 3]
        """Where the shoulder's axes meet, in ``base_link`` [m]. Shape (3,)."""
        self._steps = np.diff(placed[:, :3, 3], axis=0, prepend=np.zeros((1, 3)))
        self._turns = [_axis(robot, joint) for joint in RIGHT_ARM]
        palm = robot.placement(q, "right_palm")
        self._palm_rotation, self._palm_step = palm[:3, :3], palm[:3, 3] - placed[-1, :3, 3]
        self.reach = float(np.linalg.norm(self._steps[2:], axis=1).sum() + np.linalg.norm(self._palm_step))
        """From the shoulder over elbow and wrist to the palm [m]."""

    def poses(self, positions: Array) -> ArmPoses:
        """Where the arm is.

        Args:
            positions: Of the joints of `RIGHT_ARM` [rad]. Shape (n, 6).
        """
        count = len(positions)
        cosines, sines = np.cos(positions), np.sin(positions)
        turned = np.broadcast_to(np.eye(3), (count, 3, 3)).copy()  # columns: the axes of the link
        place = np.zeros((count, 3))
        axes, origins = np.empty((count, len(self._turns), 3)), np.empty((count, len(self._turns), 3))
        for joint, axis in enumerate(self._turns):
            place = place + turned @ self._steps[joint]
            origins[:, joint], axes[:, joint] = place, turned[:, :, axis]
            one, other = turned[:, :, (axis + 1) % 3], turned[:, :, (axis + 2) % 3]
            cosine, sine = cosines[:, joint, None], sines[:, joint, None]
            first, second = cosine * one + sine * other, cosine * other - sine * one
            turned[:, :, (axis + 1) % 3], turned[:, :, (axis + 2) % 3] = first, second
        return ArmPoses(axes, origins, turned @ self._palm_rotation, place + turned @ self._palm_step)


def angles_between(first: Array, second: Array) -> Array:
    """Angles between unit vectors [rad]. Shapes (n, 3), (n, 3) or (3,), and (n,)."""
    angles: Array = 2.0 * np.arcsin(np.clip(np.linalg.norm(first - second, axis=1) / 2.0, 0.0, 1.0))
    return angles


def _cross(first: Array, second: Array) -> Array:
    """Vector products of rows as columns, three times as fast as `np.cross`. Shapes (n, k, 3), (n, 3, k)."""
    x, y, z = first[..., 0], first[..., 1], first[..., 2]
    u, v, w = second[..., 0], second[..., 1], second[..., 2]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=1)


def _axis(robot: Robot, joint: str) -> int:
    """About which of its axes a joint turns: 0 x, 1 y, 2 z."""
    model = robot.model.joints[robot.model.getJointId(joint)]
    return ("RX", "RY", "RZ").index(model.shortname()[-2:])
