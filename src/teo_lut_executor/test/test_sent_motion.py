# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A motion that continues another, as the driver executes it: no limit is broken at the seam, of jerk too."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from executed_motion import executed, judged
from queue_world import World
from teo_lut_executor.execution.interface import Preemption, QueueSettings
from teo_signs.sign import Sign


def assert_within_limits(world: World) -> None:
    """What the driver makes of all that was sent; it must refuse nothing."""
    _, *most = judged(executed(world))
    assert max(most) <= 1.001, f"velocity, acceleration, jerk over the limit: {most}"


@pytest.mark.parametrize("opening", [0.4, 0.413])
def test_the_plan_that_takes_over_from_an_opening_keeps_every_limit(world: World, opening: float) -> None:
    world.opening_time, world.planning_time = opening, 0.31
    world.sign("CASA A-N")
    world.run_until(lambda: len(world.sent) == 2)
    world.run(1.0)
    assert_within_limits(world)


@pytest.mark.parametrize("wait", [0.0, 5.613])
def test_a_sentence_that_joins_another_keeps_every_limit(world: World, wait: float) -> None:
    world.planning_time = 0.1
    world.sign("A-N")
    world.run(wait)
    world.sign("N-A")
    world.run_until(lambda: len(world.sent) == 2)
    world.run(1.0)
    assert_within_limits(world)


def test_a_newer_text_that_takes_over_keeps_every_limit(table: Mapping[str, Sign]) -> None:
    world = World(table, QueueSettings(preemption=Preemption.REPLACE))
    world.run(0.2)
    world.planning_time = 0.1
    for moment in (2.51, 3.337, 0.0):
        world.sign("A-N-A", utterance_id=str(moment))
        world.run(moment)
    world.run_until(lambda: len(world.sent) == 3)
    world.run(1.0)
    assert_within_limits(world)


# Seconds after the sentence came: in its opening, just before its plan takes over, and while it signs.
@pytest.mark.parametrize("moment", [0.2, 0.47, 1.31, 2.53])
def test_a_stop_keeps_every_limit(world: World, moment: float) -> None:
    world.opening_time, world.planning_time = 0.4, 0.31
    ticket = world.sign("CASA A-N")
    world.run(moment)
    moving = np.abs(world.velocities).max()
    world.cancel(ticket)
    world.obstacle = "it is to stand"
    world.run(1.5)
    assert moving > 0.1 and not world.velocities.any()
    assert_within_limits(world)


# Ticks after the plan was sent that takes over from the opening: the last of them find it in force.
@pytest.mark.parametrize("ticks", range(0, 9, 2))
def test_a_stop_about_a_take_over_keeps_every_limit(world: World, ticks: int) -> None:
    world.opening_time, world.planning_time = 0.4, 0.2
    ticket = world.sign("CASA A-N")
    world.run_until(lambda: len(world.sent) == 2)
    for _ in range(ticks):
        world.tick()
    world.cancel(ticket)
    world.obstacle = "it is to stand"
    world.run(1.5)
    assert len(world.sent) == 3 and not world.velocities.any()
    assert_within_limits(world)


def test_a_stop_just_before_a_plan_begins_where_the_opening_ended(world: World) -> None:
    world.opening_time, world.planning_time = 0.4, 0.6  # too late to take over in motion
    ticket = world.sign("CASA A-N")
    world.run_until(lambda: len(world.sent) == 2)
    world.cancel(ticket)
    world.obstacle = "it is to stand"
    stopped = world.positions
    world.run(1.5)
    assert not world.velocities.any()
    assert np.abs(world.positions - stopped).max() < 0.02
    assert_within_limits(world)
