# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver makes of a plan, and of the motions that a world's queue has sent."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from trajectory_msgs.msg import JointTrajectory

from driver_messages import send
from queue_world import World
from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.interface import StopReady, TrajectoryReady
from teo_lut_executor.node.messages import to_stop, to_trajectory
from teo_motion.sentence.plan import Plan
from teo_names import COMMANDED_JOINTS, joint_limits
from teo_sim_driver.joint_follower import JointFollower

STEP = 0.001  # [s] between two positions that are looked at
_STEP = 1_000_000  # [ns], the same


def following(plan: Plan, period: float) -> JointFollower:
    """A follower that has taken a plan as the executor sends it, at time 0.

    Args:
        plan: From where the robot stands.
        period: Usual time between two steps [s].
    """
    follower = JointFollower(
        limits=joint_limits(COMMANDED_JOINTS), start=plan.positions[0].copy(), period=period
    )
    follower.step(0)
    send(follower, to_trajectory(COMMANDED_JOINTS, plan.samples, start=0.0), 0)
    return follower


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
            send(follower, messages.pop(0)[1], now)
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
