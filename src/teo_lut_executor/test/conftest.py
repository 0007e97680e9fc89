# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Mapping

import pytest

from queue_world import World
from teo_description.robot import Robot
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign


@pytest.fixture(scope="session")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture(scope="session")
def lut() -> Lut:
    return Lut.open()


@pytest.fixture
def world(table: Mapping[str, Sign]) -> World:
    """One in which the robot has been heard, at rest."""
    world = World(table)
    world.run(0.2)
    return world
