# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The bound of how much parts approach, against the shapes of the robot description moved by Pinocchio."""

from __future__ import annotations

from itertools import product

import numpy as np
import pinocchio as pin
import pytest

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_motion.collision.approach_bound import ApproachBound

STEPS = 11  # at which the way from one row to the next is looked at


@pytest.fixture(scope="module", params=("teo", "gr1t2"))
def robot(request: pytest.FixtureRequest) -> Robot:
    return Robot.load(request.param)


@pytest.fixture(scope="module")
def bound(robot: Robot) -> ApproachBound:
    return ApproachBound(robot)


@pytest.fixture(scope="module")
def points(robot: Robot) -> dict[str, tuple[int, Array]]:
    """Corners of the boxes about all collision shapes, in the frames of their joints, by joint."""
    geometry = pin.buildGeomFromUrdfString(
        robot.model, robot.humanoid.urdf_text(), pin.GeometryType.COLLISION
    )
    found: dict[str, list[Array]] = {}
    for item in geometry.geometryObjects:
        item.geometry.computeLocalAABB()
        box = item.geometry.aabb_local
        for corner in product(*zip(np.ravel(box.min_), np.ravel(box.max_), strict=True)):
            name = robot.model.names[item.parentJoint]
            found.setdefault(name, []).append(item.placement.act(np.array(corner)))
    return {name: (robot.model.getJointId(name), np.array(rows)) for name, rows in found.items()}


def moved(robot: Robot, points: dict[str, tuple[int, Array]], row: Array, first: str) -> Array:
    """Where the points of a joint and of all that hangs on it are [m]."""
    q = robot.configuration(dict(zip(robot.humanoid.commanded_joints, row.tolist(), strict=True)))
    beyond = {robot.model.names[joint] for joint in robot.model.subtrees[robot.model.getJointId(first)]}
    pin.forwardKinematics(robot.model, robot.data, q)
    return np.concatenate(
        [
            local @ robot.data.oMi[joint].rotation.T + robot.data.oMi[joint].translation
            for name, (joint, local) in points.items()
            if name in beyond
        ]
    )


@pytest.mark.parametrize(
    ("part", "turning"),
    [
        ("right_arm", ("right_arm", "right_hand")),
        ("left_arm", ("left_arm", "left_hand")),
        ("right_arm", ("right_arm",)),
        ("left_arm", ("left_hand",)),
        ("head", ("head",)),
        ("right_arm", ("trunk",)),
    ],
)
def test_no_point_goes_farther_than_parts_are_said_to_approach(
    robot: Robot,
    bound: ApproachBound,
    points: dict[str, tuple[int, Array]],
    part: str,
    turning: tuple[str, ...],
) -> None:
    limits, limbs = robot.humanoid.limits(), robot.humanoid.limbs
    joints = [name for limb in turning for name in limbs[limb]]
    if not joints:
        pytest.skip(f"{robot.humanoid.name} has no joint there")
    rng = np.random.default_rng(11)
    turns = np.array([name in joints for name in limits.names])
    closest = 0.0
    for size in (0.02, 0.3) * 10:
        first = rng.uniform(limits.lower, limits.upper)
        second = np.clip(first + turns * rng.uniform(-size, size, len(first)), limits.lower, limits.upper)
        most = float(bound.approaches(np.array([first, second]))[0])
        start = moved(robot, points, first, limbs[part][0])
        for share in np.linspace(0.0, 1.0, STEPS)[1:]:
            here = moved(robot, points, first + share * (second - first), limbs[part][0])
            farthest = float(np.linalg.norm(here - start, axis=1).max())
            assert farthest <= most
            closest = max(closest, farthest / most)
    assert closest > 0.3  # else looks along a motion are wasted


def test_what_stands_still_approaches_nothing(robot: Robot, bound: ApproachBound) -> None:
    rest = robot.humanoid.ready
    assert bound.approaches(np.array([rest, rest, rest])).tolist() == [0.0, 0.0]
    assert bound.approaches(rest[None]).shape == (0,)
