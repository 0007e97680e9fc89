# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_description.robot import Robot
from teo_signs.look_up_table import Lut, default_lut_directory


@pytest.fixture(scope="session")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture(scope="session")
def shipped() -> Lut:
    """The package's table, of which each entry is read once."""
    return Lut.open(default_lut_directory())
