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

from collections.abc import Mapping, Sequence
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from teo_common.arrays import Array
from teo_description.errors import DescriptionError
from teo_description.humanoid import SIDES, Humanoid, Side
from teo_description.robot import Robot
from teo_description.robot_schema import Reach

_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))


class ArmReach(NamedTuple):
    """An arm with its hand."""

    corners: tuple[Array, ...]
    """Of a box that holds what each joint carries up to the next, in its frame [m]; the last one's holds the
    hand with all that fingers and thumb reach. Shape (8, 3) each, (0, 3) of a joint that carries nothing."""
    length: float
    """From the shoulder to the farthest point of the hand [m]."""
    digits: Array
    """How far a point of each digit goes in the hand for each radian of each commanded joint [m]. Shape
    (digits, joints)."""


class _BodyReach(NamedTuple):
    """A whole robot."""

    arms: Mapping[Side, ArmReach]
    head: Array
    """How far points of the head go for each radian of the commanded joints [m]. Shape (points, joints)."""
    trunk: Array
    """The same of all that the trunk carries."""


def _reach_of(robot: Robot) -> _BodyReach:
    """The reach that the robot's description states; where it states none, as measured."""
    stated = robot.humanoid.file.reach
    return _Parts(robot).reach_of_all() if stated is None else _stated(robot.humanoid, stated)


def _stated(humanoid: Humanoid, reach: Reach) -> _BodyReach:
    def swings(axes: Mapping[str | None, float]) -> Array:
        row = np.zeros(len(humanoid.commanded_joints))
        for name, swing in axes.items():
            if name is not None:
                row[humanoid.columns([name])] = swing
        return row

    arms: dict[Side, ArmReach] = {}
    for side in SIDES:
        boxes = [reach.arm_boxes.get(name) for name in humanoid.arm("right")]
        corners = tuple(np.empty((0, 3)) if box is None else _box(np.array(box)) for box in boxes)
        abductor, thumb, *fingers = humanoid.hand_axes(side)
        digits = [{abductor: reach.abductor, thumb: reach.thumb}, *({name: reach.finger} for name in fingers)]
        arms[side] = ArmReach(corners, reach.arm, np.array([swings(axes) for axes in digits]))
    return _BodyReach(
        arms=arms,
        head=swings(dict.fromkeys(humanoid.head, reach.head))[None],
        trunk=swings(dict.fromkeys(humanoid.trunk, reach.trunk))[None],
    )


class _Parts:
    """The bodies that joints move, and how far they reach.

    Attributes:
        robot: The robot.
        corners: Corners of boxes that hold the body of each joint, in its frame [m]. Shape (n, 3) each.
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        model, humanoid = robot.model, robot.humanoid
        geometry = pin.buildGeomFromUrdfString(model, humanoid.urdf_text(), pin.GeometryType.COLLISION)
        self.corners: list[Array] = [np.empty((0, 3))] * model.njoints
        for item in geometry.geometryObjects:
            item.geometry.computeLocalAABB()
            box = item.geometry.aabb_local
            middle, half = (box.max_ + box.min_) / 2.0, (box.max_ - box.min_) / 2.0
            local = middle + _CORNERS * half
            placed = local @ item.placement.rotation.T + item.placement.translation
            self.corners[item.parentJoint] = np.concatenate([self.corners[item.parentJoint], placed])
        self._reaches: dict[int, float] = {}
        self._columns = {name: column for column, name in enumerate(humanoid.commanded_joints)}
        # Which commanded joint turns each joint of the model, and how much [1].
        self._turned_by: dict[int, tuple[int, float]] = {}
        for joint in humanoid.urdf_tree().findall("joint"):
            mimic = joint.find("mimic")
            name, times = joint.attrib["name"], 1.0
            if mimic is not None:
                name, times = mimic.attrib["joint"], abs(float(mimic.get("multiplier", "1")))
            if name in self._columns:
                self._turned_by[model.getJointId(joint.attrib["name"])] = self._columns[name], times

    def children(self, joint: int) -> list[int]:
        """Joints of the model that hang on one."""
        return list(self.robot.model.children[joint])

    def reach(self, joint: int) -> float:
        """From a joint to the farthest point of all that it moves, stretched [m]."""
        if joint not in self._reaches:
            own = np.linalg.norm(self.corners[joint], axis=1).max(initial=0.0)
            beyond = (
                float(np.linalg.norm(self.robot.model.jointPlacements[child].translation)) + self.reach(child)
                for child in self.children(joint)
            )
            self._reaches[joint] = max(float(own), *beyond, 0.0)
        return self._reaches[joint]

    def reach_of_all(self) -> _BodyReach:
        """The whole robot."""
        humanoid = self.robot.humanoid
        return _BodyReach(
            arms={side: self._arm(humanoid.arm(side)) for side in SIDES},
            head=self._swings(humanoid.head),
            trunk=self._swings(humanoid.trunk),
        )

    def _arm(self, names: Sequence[str]) -> ArmReach:
        model = self.robot.model
        chain = [model.getJointId(name) for name in names]
        hand = chain[-1]
        fingers = [
            model.jointPlacements[child].translation + _CORNERS * self.reach(child)
            for child in self.children(hand)
        ]
        corners = [self.corners[joint] for joint in chain[:-1]]
        corners.append(np.concatenate([self.corners[hand], *fingers]))
        return ArmReach(tuple(map(_box, corners)), self.reach(chain[0]), self._digits(hand))

    def _swings(self, joints: Sequence[str]) -> Array:
        """How far points beyond joints that follow one another go. Shape (points, commanded joints)."""
        if not joints:
            return np.zeros((1, len(self._columns)))
        counted = {self._columns[name] for name in joints}
        return self._ways(self.robot.model.getJointId(joints[0]), counted)

    def _digits(self, hand: int) -> Array:
        """How far points of what hangs on a hand go in it. Shape (points, commanded joints)."""
        rows = [self._ways(child, set(self._columns.values())) for child in self.children(hand)]
        return np.unique(np.concatenate([np.zeros((1, len(self._columns))), *rows]), axis=0)

    def _ways(self, joint: int, counted: set[int]) -> Array:
        """A row for each way from a joint to the end of a chain, of the commanded joints that count."""
        own = np.zeros(len(self._columns))
        column, times = self._turned_by.get(joint, (-1, 0.0))
        if column in counted:
            own[column] = times * self.reach(joint)
        beyond = [self._ways(child, counted) for child in self.children(joint)]
        ways: Array = own + np.concatenate([np.zeros((1, len(own))), *beyond])
        return np.unique(ways, axis=0)


def _box(points: Array) -> Array:
    """Corners of the box that holds points, along the axes. Shape (8, 3), or (0, 3) without points."""
    if not len(points):
        return points
    low, high = points.min(axis=0), points.max(axis=0)
    corners: Array = (low + high) / 2.0 + _CORNERS * (high - low) / 2.0
    return corners


class ApproachBound:
    """Bounds of how much any watched pair of parts of a robot approaches."""

    def __init__(self, robot: Robot) -> None:
        """Take the reach of the robot's parts.

        Raises:
            DescriptionError: The joints of an arm do not follow one another ("bad_robot").
        """
        self._reach = _reach_of(robot)
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
