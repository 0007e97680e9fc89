# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver makes of the motions that a world's queue has sent, judged by differences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from queue_world import World
from trajectory_msgs.msg import JointTrajectory

from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.events import StopReady, TrajectoryReady
from teo_lut_executor.node.messages import to_stop, to_trajectory
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, joint_limits
from teo_sim_driver.joint_follower import JointFollower

_STEP = 1_000_000  # [ns]


def executed(world: World) -> Array:
    """Positions to which the driver takes the robot, every millisecond [rad]. Shape (n, joints).

    Raises:
        TrajectoryError: The driver refuses a motion.
    """
    limits, start = joint_limits(COMMANDED_JOINTS), load_humanoid().ready.copy()
    follower = JointFollower(limits=limits, start=start, period=0.001)
    # A motion with a time comes half a period before that: what the sender did not know by then must not
    # matter. One that is overtaken by the next before it begins comes with that: in the order of sending.
    begin = np.array([time - (0.01 if _is_timed(event) else 0.0) for time, event in world.taken])
    come = np.minimum.accumulate(begin[::-1])[::-1]
    messages = [
        (round(time * 1e9), _message(world.planner.limits.names, event))
        for time, (_, event) in zip(come, world.taken, strict=True)
    ]
    path, now, end = [], messages[0][0], round(world.now * 1e9)
    while now < end:
        while messages and messages[0][0] <= now:
            follower.accept(messages.pop(0)[1], now)
        path.append(follower.step(now).positions)
        now += _STEP
    assert not messages
    return np.array(path)


def _is_timed(event: TrajectoryReady | StopReady) -> bool:
    return isinstance(event, TrajectoryReady) and event.start is not None


def _message(names: Sequence[str], event: TrajectoryReady | StopReady) -> JointTrajectory:
    if isinstance(event, StopReady):
        return to_stop(names, event.end, event.lead)
    return to_trajectory(names, event.samples, start=event.start)


def most_of_limits(path: Array, limits: MotionLimits) -> Array:
    """The most that a joint reaches, over its limit [1]: of velocity, acceleration and jerk. Shape (3,)."""
    step = _STEP * 1e-9
    orders = enumerate((limits.velocity, limits.acceleration, limits.jerk), start=1)
    return np.array(
        [(np.abs(np.diff(path, n=order, axis=0)) / step**order / limit).max() for order, limit in orders]
    )
