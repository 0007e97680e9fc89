# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A motion that continues another, as the driver executes it: no limit is broken at the seam, of jerk too."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from queue_world import World

from teo_description import COMMANDED_JOINTS, joint_limits
from teo_lut_executor.execution.events import Preemption, QueueSettings, TrajectoryReady
from teo_lut_executor.node.messages import to_trajectory
from teo_motion.sentence.rest_posture import REST
from teo_motion.trajectory.limits import MotionLimits
from teo_signs.sign import Sign
from teo_sim_driver.joint_follower import JointFollower

STEP = 1_000_000  # [ns]


def executed(world: World) -> np.ndarray:
    """Positions to which the driver takes the robot, every millisecond [rad]; it must refuse nothing."""
    follower = JointFollower(limits=joint_limits(COMMANDED_JOINTS), start=REST.copy(), period=0.001)
    sent = [event for event in world.events if isinstance(event, TrajectoryReady)]
    # Each half a period before it begins: what the sender did not know by then must not matter.
    messages = [
        (
            round((event.start - 0.01) * 1e9),
            to_trajectory(world.planner.limits.names, event.samples, start=event.start),
        )
        for event in sent
    ]
    path, now, end = [], messages[0][0], round(world.now * 1e9)
    while now < end:
        while messages and messages[0][0] <= now:
            follower.accept(messages.pop(0)[1], now)
        path.append(follower.step(now).positions)
        now += STEP
    assert not messages
    return np.array(path)


def assert_within_limits(path: np.ndarray, limits: MotionLimits) -> None:
    step = STEP * 1e-9
    for order, limit in enumerate((limits.velocity, limits.acceleration, limits.jerk), start=1):
        reached = np.abs(np.diff(path, n=order, axis=0)) / step**order
        assert (reached <= limit * 1.001 + 1e-3).all(), f"derivative {order}: {(reached / limit).max():.2f}"


@pytest.mark.parametrize("opening", [0.4, 0.413])
def test_the_plan_that_takes_over_from_an_opening_keeps_every_limit(
    table: Mapping[str, Sign], opening: float
) -> None:
    world = World(table)
    world.run(0.2)
    world.opening_time, world.planning_time = opening, 0.31
    world.sign("CASA A-N")
    world.run_until(lambda: len(world.sent) == 2)
    world.run(1.0)
    assert_within_limits(executed(world), world.planner.limits)


@pytest.mark.parametrize("wait", [0.0, 5.613])
def test_a_sentence_that_joins_another_keeps_every_limit(table: Mapping[str, Sign], wait: float) -> None:
    world = World(table)
    world.run(0.2)
    world.planning_time = 0.1
    world.sign("A-N")
    world.run(wait)
    world.sign("N-A")
    world.run_until(lambda: len(world.sent) == 2)
    world.run(1.0)
    assert_within_limits(executed(world), world.planner.limits)


def test_a_newer_text_that_takes_over_keeps_every_limit(table: Mapping[str, Sign]) -> None:
    world = World(table, QueueSettings(preemption=Preemption.REPLACE))
    world.run(0.2)
    world.planning_time = 0.1
    for moment in (2.51, 3.337, 0.0):
        world.sign("A-N-A", utterance_id=str(moment))
        world.run(moment)
    world.run_until(lambda: len(world.sent) == 3)
    world.run(1.0)
    assert_within_limits(executed(world), world.planner.limits)


# Seconds after the sentence came: in its opening, just before its plan takes over, and while it signs.
@pytest.mark.parametrize("moment", [0.2, 0.47, 0.9, 1.31, 1.7, 2.2, 2.53, 2.8])
def test_a_stop_keeps_every_limit(table: Mapping[str, Sign], moment: float) -> None:
    world = World(table)
    world.run(0.2)
    world.opening_time, world.planning_time = 0.4, 0.31
    ticket = world.sign("CASA A-N")
    world.run(moment)
    moving = np.abs(world.velocities).max()
    world.cancel(ticket)
    world.obstacle = "it is to stand"
    world.run(1.5)
    assert moving > 0.1 and not world.velocities.any()
    assert_within_limits(executed(world), world.planner.limits)
