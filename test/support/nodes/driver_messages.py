# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Trajectory messages made of arrays, and what the driver does with one that has come."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike
from rclpy.serialization import serialize_message
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_sim_driver import JointFollower, Trajectory, check
from teo_sim_driver.motion.path_time import SECOND


def trajectory_message(
    names: Sequence[str],
    times: Iterable[float],
    positions: ArrayLike,
    velocities: ArrayLike | None = None,
    accelerations: ArrayLike | None = None,
    *,
    stamp: int = 0,
) -> JointTrajectory:
    """Make a message.

    Args:
        names: Joints, one for each column.
        times: From the start [s]. Shape (n,).
        positions: [rad]. Shape (n, joints).
        velocities: [rad/s]. Shape (n, joints).
        accelerations: [rad/s^2]. Shape (n, joints).
        stamp: When it starts [ns]; 0 is now.
    """
    message = JointTrajectory(joint_names=list(names))
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    for i, time in enumerate(times):
        point = JointTrajectoryPoint(
            **{
                field: array("d", np.asarray(rows, dtype=np.float64)[i].tolist())
                for field, rows in (
                    ("positions", positions),
                    ("velocities", velocities),
                    ("accelerations", accelerations),
                )
                if rows is not None
            }
        )
        duration = point.time_from_start
        duration.sec, duration.nanosec = divmod(round(time * SECOND), SECOND)
        message.points.append(point)
    return message


def send(follower: JointFollower, message: JointTrajectory, now: int) -> Trajectory:
    """Let a follower take a message at a time [ns], by way of its bytes as the node does.

    Returns:
        What is being executed then.

    Raises:
        TrajectoryError: The message is refused.
    """
    follower.take(check(serialize_message(message), limits=follower.limits, rules=follower.rules), now)
    assert follower.trajectory is not None
    return follower.trajectory
