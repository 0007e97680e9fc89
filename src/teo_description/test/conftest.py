# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_names import ALL_JOINTS, joint_limits


@pytest.fixture(scope="session")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture
def random_positions() -> Callable[[], Mapping[str, float]]:
    """Positions of all 40 joints, uniform within their limits; the same sequence on every run."""
    limits = joint_limits(ALL_JOINTS)
    generator = np.random.default_rng(20)

    def positions() -> Mapping[str, float]:
        values = generator.uniform(limits.lower, limits.upper)
        return {name: float(value) for name, value in zip(ALL_JOINTS, values, strict=True)}

    return positions
