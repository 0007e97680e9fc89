# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from made_bags import signing

from teo_description.robot import Robot
from teo_sign_capture.entries.take import SignTake, capture_take
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics


@pytest.fixture(scope="session")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture(scope="session")
def chain(robot: Robot) -> ArmKinematics:
    return ArmKinematics(robot)


@pytest.fixture(scope="session")
def take(robot: Robot) -> SignTake:
    """A sign from the chin outwards, captured."""
    return capture_take(robot, signing())
