# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics


@pytest.mark.parametrize("name", ["teo", "gr1t2"])
def test_many_arms_at_once_are_where_pinocchio_has_each(name):
    robot = Robot.load(name)
    humanoid, chain = robot.humanoid, ArmKinematics(robot)
    arm, frame = humanoid.arm("right"), humanoid.file.hand.palm
    limits = humanoid.limits(arm)
    positions = np.random.default_rng(0).uniform(limits.lower, limits.upper, (50, len(arm)))
    poses = chain.poses(positions)
    local = np.array([0.08, -0.02, 0.03])
    points = poses.points(np.tile(local, (50, 1)))
    slopes, turns = poses.point_jacobian(points), poses.direction_jacobian(poses.rotation[:, :, 2])
    for index, row in enumerate(positions):
        q = robot.configuration(dict(zip(arm, row.tolist(), strict=True)))
        palm = robot.placement(q, frame)
        assert poses.rotation[index] == pytest.approx(palm[:3, :3], abs=1e-12)
        assert poses.place[index] == pytest.approx(palm[:3, 3], abs=1e-12)
        elbow = robot.placement(q, humanoid.file.collision.right_arm.forearm[0])[:3, 3]
        assert poses.origins[index, chain.elbow] == pytest.approx(elbow, abs=1e-12)
        jacobian = robot.jacobian(q, frame, arm)
        expected = jacobian[:3] + np.cross(jacobian[3:].T, palm[:3, :3] @ local).T
        assert slopes[index] == pytest.approx(expected, abs=1e-12)
        assert turns[index] == pytest.approx(np.cross(jacobian[3:].T, palm[:3, 2]).T, abs=1e-12)


def test_reach_is_the_arm_stretched_out(robot):
    chain = ArmKinematics(robot)
    hanging = chain.poses(np.zeros((1, 6)))
    assert chain.reach == pytest.approx(np.linalg.norm(hanging.place[0] - chain.shoulder), abs=0.001)
