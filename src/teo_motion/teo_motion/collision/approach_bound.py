# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How much nearer two parts of the robot can have come to each other while its joints turned.

Two parts approach by at most what the joints between them move the farthest points of both. How far a point
of a rigid part is displaced between two postures is a convex function of the point, so it is greatest at a
corner of a box that holds the part. Between two rows the joints turn evenly: a corner leaves the straight
line from one to the other by at most (angle turned)^2 * reach / 8, which is added. So the distance of a
watched pair in one row bounds it in another.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pinocchio as pin

from teo_common.arrays import Array
from teo_description.errors import DescriptionError
from teo_description.humanoid import SIDES, Side
from teo_description.robot import Robot
from teo_motion.collision.reach import ArmReach, reach_of


class ApproachBound:
    """Bounds of how much any watched pair of parts of a robot approaches."""

    def __init__(self, robot: Robot) -> None:
        """Take the reach of the robot's parts.

        Raises:
            DescriptionError: The joints of an arm do not follow one another ("bad_robot").
        """
        self._reach = reach_of(robot)
        self._arms = tuple(_Arm(robot, side, self._reach.arms[side]) for side in SIDES)

    def approaches(self, positions: Array) -> Array:
        """Bounds of how much any watched pair approaches between one row and the next [m].

        Args:
            positions: Of the commanded joints, on straight lines between rows [rad]. Shape (n, joints).

        Returns:
            Shape (n - 1,).
        """
        turned = np.abs(np.diff(positions, axis=0))
        left, right = (arm.way(positions, turned) for arm in self._arms)
        head, trunk = (_farthest(turned, swings) for swings in (self._reach.head, self._reach.trunk))
        # The trunk carries head and arms alike: they approach pelvis and legs.
        bounds: Array = np.maximum(right + left, np.maximum(right, left) + np.maximum(head, trunk))
        return bounds


class _Arm:
    """Kinematics of an arm from its shoulder on, for many postures at once."""

    def __init__(self, robot: Robot, side: Side, reach: ArmReach) -> None:
        names, model = robot.humanoid.arm(side), robot.model
        chain = [model.getJointId(name) for name in names]
        for before, joint in pairwise(chain):
            if model.parents[joint] != before:
                message = (
                    f"{robot.humanoid.name}: groups.{side}_arm: expected joints that follow one another, "
                    f"got {model.names[joint]} after {model.names[before]}"
                )
                raise DescriptionError("bad_robot", message)
        self._columns = robot.humanoid.columns(names)
        self._placements = [model.jointPlacements[joint] for joint in chain]
        self._crosses = [np.array(pin.skew(_axis(model, joint))) for joint in chain]
        self._reach = reach

    def way(self, positions: Array, turned: Array) -> Array:
        """How far a point of the arm or hand goes from row to row [m]. Shape (n - 1,)."""
        angles = positions[:, self._columns]
        turn, place = np.eye(3)[None], np.zeros((1, 3))
        found = []
        for number, (placement, corners) in enumerate(
            zip(self._placements, self._reach.corners, strict=True)
        ):
            if number:  # where the shoulder is does not matter
                place = place + turn @ placement.translation
            turn = turn @ placement.rotation @ _rotations(self._crosses[number], angles[:, number])
            if len(corners):
                found.append(place[:, None] + corners @ turn.transpose(0, 2, 1))
        steps = np.diff(np.concatenate(found, axis=1), axis=0)
        straight = np.sqrt(np.einsum("ijk,ijk->ij", steps, steps).max(axis=1))
        beside = turned[:, self._columns].sum(axis=1) ** 2 * self._reach.length / 8.0
        way: Array = straight + beside + _farthest(turned, self._reach.digits)
        return way


def _farthest(turned: Array, swings: Array) -> Array:
    """How far the farthest point goes by what joints turn. Shapes (n, joints), (points, joints) and (n,)."""
    farthest: Array = (turned @ swings.T).max(axis=1)
    return farthest


def _axis(model: pin.Model, joint: int) -> Array:
    """The axis about which a joint turns, in its frame, unit vector."""
    motion = model.joints[joint].createData()
    model.joints[joint].calc(motion, np.zeros(model.joints[joint].nq))
    axis: Array = np.asarray(motion.S).reshape(6, -1)[3:, 0]
    return axis


def _rotations(cross: Array, angles: Array) -> Array:
    """Rotations about the axis of a cross-product matrix by angles [rad] (Rodrigues). Shape (n, 3, 3)."""
    sines, cosines = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    turns: Array = np.eye(3) + sines * cross + (1.0 - cosines) * (cross @ cross)
    return turns
