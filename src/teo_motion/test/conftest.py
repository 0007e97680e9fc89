# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_names import COMMANDED_JOINTS
from teo_signs.look_up_table import Lut


@pytest.fixture(scope="session")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture(scope="session")
def lut() -> Lut:
    return Lut.open()


@pytest.fixture(scope="session")
def least_distance(robot: Robot) -> Callable[[np.ndarray], float]:
    """The nearest that parts of the robot come to each other in some postures, each looked at [m]."""

    def least(positions: np.ndarray) -> float:
        poses = (dict(zip(COMMANDED_JOINTS, row.tolist(), strict=True)) for row in positions)
        return min(robot.clearance(robot.configuration(pose)).distance for pose in poses)

    return least
