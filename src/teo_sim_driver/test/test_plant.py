# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from teo_description import JointLimits
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.plants.plant import Faults, FaultyPlant, IdealPlant, StateLine

SPEED = 20.0  # [rad/s]
LIMITS = JointLimits(
    names=("neck", "elbow"), lower=np.full(2, -9.0), upper=np.full(2, 9.0), velocity=np.full(2, SPEED)
)
SECOND = 1_000_000_000


def at(*positions):
    return MotionState.at_rest(np.array(positions))


@pytest.fixture
def plant():
    return FaultyPlant(IdealPlant(), LIMITS, np.zeros(2))


def run(plant, goal, steps):
    for _ in range(steps):
        state = plant.step(goal, 0.01)
    return state.positions


def test_a_frozen_joint_stays_and_catches_up_no_faster_than_it_can_when_it_is_freed(plant):
    plant.step(at(0.1, 0.1), 0.01)
    plant.faults = Faults(frozen=("elbow",))
    assert run(plant, at(0.3, 0.6), 3).tolist() == [0.3, 0.1]
    plant.faults = Faults()
    went = [run(plant, at(0.3, 0.6), 1)[1] for _ in range(4)]
    np.testing.assert_allclose(went, [0.3, 0.5, 0.6, 0.6], rtol=1e-5)
    assert plant.step(at(0.3, 0.6), 0.01).velocities.tolist() == [0.0, 0.0]


def test_a_lag_is_of_first_order(plant):
    plant.faults = Faults(lag=0.2)
    # A step of 1 rad, after one and two time constants.
    np.testing.assert_allclose(run(plant, at(1.0, 0.0), 20), [1.0 - np.exp(-1.0), 0.0])
    np.testing.assert_allclose(run(plant, at(1.0, 0.0), 20), [1.0 - np.exp(-2.0), 0.0])


def test_a_tracking_error_and_the_steps_of_an_encoder_are_measured(plant):
    plant.faults = Faults(tracking_error=0.013, encoder_step=0.01)
    np.testing.assert_allclose(run(plant, at(0.1, -0.1), 1), [0.11, -0.09])


def test_late_states_keep_their_order_and_their_time():
    line, faults = StateLine(), Faults(state_delay=0.02)
    arrived = [line.send(at(i, i), i * SECOND // 100, faults) for i in range(5)]
    assert [len(each) for each in arrived] == [0, 0, 1, 1, 1]
    assert [(time, state.positions[0]) for time, state in arrived[4]] == [(2 * SECOND // 100, 2.0)]


def test_of_lost_states_the_part_that_was_asked_for_is_missing():
    line = StateLine()
    assert sum(len(line.send(at(0, 0), i, Faults(state_loss=0.3))) for i in range(5000)) == pytest.approx(
        3500, abs=150
    )
    assert not line.send(at(0, 0), 9000, Faults(state_loss=1.0))
