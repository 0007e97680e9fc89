# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from teo_description import COMMANDED_JOINTS, HOME, LEG_JOINTS, JointLimits, joint_limits
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.message import PlainTrajectory, plain_trajectory

PERIOD = 0.01  # [s]
START = 1_700_000_000_000_000_000  # a time of day as ROS counts it [ns]


@pytest.fixture(scope="session")
def limits() -> JointLimits:
    return joint_limits(COMMANDED_JOINTS)


@pytest.fixture(scope="session")
def home() -> NDArray[np.float64]:
    return np.array([HOME[name] for name in COMMANDED_JOINTS])


@pytest.fixture(scope="session")
def new_follower(limits: JointLimits, home: NDArray[np.float64]) -> Callable[..., JointFollower]:
    """A follower that stands at HOME and has made its first step at START."""

    def make(**arguments: object) -> JointFollower:
        follower = JointFollower(
            **{"limits": limits, "start": home, "period": PERIOD, "held": LEG_JOINTS, **arguments}
        )
        follower.step(START)
        return follower

    return make


@pytest.fixture(scope="session")
def swing(limits: JointLimits, home: NDArray[np.float64]) -> Callable[..., PlainTrajectory]:
    """From HOME, one joint to an angle and back as (4 u (1 - u))^3: no acceleration at either end."""

    def make(
        joint: str = "FrontalRightElbow",
        angle: float = -0.5,
        duration: float = 4.0,
        **stamp: int,
    ) -> PlainTrajectory:
        times = np.arange(1, round(duration / 0.1) + 1) * 0.1
        shape = np.zeros(len(home))
        shape[limits.names.index(joint)] = angle
        curve = 64.0 * np.polynomial.Polynomial([0.0, 1.0 / duration, -1.0 / duration**2]) ** 3
        derivatives = [shape * curve.deriv(order)(times)[:, None] for order in range(3)]
        derivatives[0] += home
        derivatives[1][-1] = 0.0
        return plain_trajectory(limits.names, times, *derivatives, **stamp)

    return make
