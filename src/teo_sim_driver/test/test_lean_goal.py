# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The bytes of a goal's trajectory say what the goal made of objects says."""

import numpy as np
import pytest
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance
from rclpy.serialization import deserialize_message, serialize_message
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_sim_driver.checking.reading import FIELDS
from teo_sim_driver.node.lean_goal import lean_action

RequestType = FollowJointTrajectory.Impl.SendGoalService.Request
Lean = lean_action(lambda: 500).Impl.SendGoalService.Request


def request(rng, lengths, joints):
    trajectory = JointTrajectory(joint_names=[f"joint {i} ñ" for i in range(joints)])
    trajectory.header.stamp.sec, trajectory.header.stamp.nanosec = -7, 4_000_000_000
    trajectory.header.frame_id = "a frame"
    for row in lengths:
        point = JointTrajectoryPoint()
        for field, length in zip(FIELDS, row, strict=True):
            setattr(point, field, rng.normal(size=length).tolist())
        point.time_from_start.sec = int(rng.integers(-(2**31), 2**31))
        point.time_from_start.nanosec = int(rng.integers(0, 2**32))
        trajectory.points.append(point)
    asked = RequestType()
    asked.goal_id.uuid = rng.integers(0, 256, 16, dtype=np.uint8)
    asked.goal.trajectory = trajectory
    asked.goal.path_tolerance = [JointTolerance(name="joint", position=0.5)]
    asked.goal.goal_time_tolerance.sec = 3
    return asked


@pytest.mark.parametrize(
    "lengths",
    [
        [],
        [(4, 0, 0, 0)],
        [(4, 4, 4, 0)] * 50,
        [(4, 4, 4, 4), (4, 4, 0, 0), (4, 0, 0, 0)] * 5,
        [(4, 3, 5, 1), (0, 0, 0, 0), (4, 4, 4, 0)],
    ],
    ids=["none", "one", "full", "ragged", "wrong lengths"],
)
def test_it_says_the_same(lengths):
    asked = request(np.random.default_rng(1), lengths, joints=4)
    lean = deserialize_message(serialize_message(asked), Lean)
    assert deserialize_message(lean.goal.trajectory, JointTrajectory) == asked.goal.trajectory
    assert lean.goal.points == len(lengths)
    assert bytes(lean.goal_id.uuid) == bytes(asked.goal_id.uuid)
    assert lean.goal.message.path_tolerance == asked.goal.path_tolerance
    assert lean.goal.message.goal_time_tolerance.sec == 3
    assert not lean.goal.message.trajectory.points


def test_of_a_goal_with_more_points_than_are_taken_only_their_number_is_read():
    asked = request(np.random.default_rng(2), [(2, 0, 0, 0)] * 501, joints=2)
    lean = deserialize_message(serialize_message(asked), Lean)
    assert (lean.goal.points, lean.goal.trajectory) == (501, b"")
