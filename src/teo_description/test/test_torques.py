# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0

import numpy as np
import pinocchio as pin
import pytest

from teo_names import COMMANDED_JOINTS


def test_torques_are_what_energy_asks_for(robot):
    """Power put in equals the rate of change of kinetic and potential energy: a derivation of its own.

    In thirty states at random, so that no direction of the 28 joints is left out.
    """
    rng, step = np.random.default_rng(3), 1e-4
    for _ in range(30):
        start, speed, push = (rng.uniform(-0.4, 0.4, 28) * scale for scale in (1.0, 2.0, 5.0))

        def energy(time, start=start, speed=speed, push=push):
            at = [start + speed * time + push * time**2 / 2.0, speed + push * time]
            q = [
                robot.configuration(dict(zip(COMMANDED_JOINTS, values.tolist(), strict=True)))
                for values in (at[0], at[0] + 1e-6 * at[1])
            ]
            velocity = (q[1] - q[0]) / 1e-6
            kinetic = pin.computeKineticEnergy(robot.model, robot.data, q[0], velocity)
            return kinetic + pin.computePotentialEnergy(robot.model, robot.data, q[0])

        power = (energy(step) - energy(-step)) / (2.0 * step)
        torques = robot.torques(start[None], speed[None], push[None])[0]
        assert torques @ speed == pytest.approx(power, rel=1e-3, abs=1e-3)
