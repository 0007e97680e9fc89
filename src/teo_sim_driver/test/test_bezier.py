# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly

from teo_sim_driver.motion.bezier import CUBIC, LINEAR, QUINTIC, first_excess
from teo_sim_driver.motion.trajectory import Trajectory

GIVEN = {LINEAR: 1, CUBIC: 2, QUINTIC: 3}  # derivatives that a point gives, the zeroth included


def random_trajectory(seed: int, degrees: list[int], joints: int = 3) -> Trajectory:
    rng = np.random.default_rng(seed)
    points = len(degrees) + 1
    times = np.concatenate([[0.0], np.cumsum(rng.uniform(0.005, 2.0, points - 1))])
    return Trajectory(
        times,
        rng.normal(size=(points, joints)),
        rng.normal(size=(points, joints)),
        rng.normal(scale=5.0, size=(points, joints)),
        np.repeat(np.array(degrees, dtype=np.int8)[:, None], joints, axis=1),
    )


def independent(trajectory: Trajectory, segment: int, order: int = 0):
    ends = []
    for i in (segment, segment + 1):
        values = [trajectory.positions[i], trajectory.velocities[i], trajectory.accelerations[i]]
        ends.append(values[: GIVEN[int(trajectory.degrees[segment, 0])]])
    return BPoly.from_derivatives(trajectory.times[segment : segment + 2], ends).derivative(order)


@settings(max_examples=60)
@given(st.integers(0, 2**32), st.lists(st.sampled_from([LINEAR, CUBIC, QUINTIC]), min_size=1, max_size=4))
def test_positions_velocities_and_accelerations_agree_with_scipy(seed, degrees):
    trajectory = random_trajectory(seed, degrees)
    for segment in range(len(degrees)):
        low, high = trajectory.times[segment : segment + 2]
        for time in np.linspace(low, high, 6)[:-1]:
            state = trajectory.sample(float(time))
            duration = high - low
            for order, values in enumerate(state):
                truth = independent(trajectory, segment, order)(time)
                np.testing.assert_allclose(values, truth, rtol=1e-9, atol=1e-9 / duration**order)


@settings(max_examples=60)
@given(
    st.integers(0, 2**32),
    st.lists(st.sampled_from([LINEAR, CUBIC, QUINTIC]), min_size=1, max_size=4),
    st.floats(0.0, 1.0),
    st.floats(0.01, 1.5),
)
def test_a_cut_and_joined_trajectory_is_the_same_motion(seed, degrees, begin, length):
    trajectory = random_trajectory(seed, degrees)
    start = begin * trajectory.duration
    end = start + length * trajectory.duration
    middle = start + 0.4 * (end - start)
    whole = trajectory.cut(start, middle).then(trajectory.cut(middle, end))
    assert whole.duration == pytest.approx(end - start)
    for time in np.linspace(0.0, end - start, 23):
        np.testing.assert_allclose(
            whole.sample(time).positions, trajectory.sample(start + time).positions, atol=1e-8
        )


@settings(max_examples=200)
@given(
    st.integers(0, 2**32), st.sampled_from([LINEAR, CUBIC, QUINTIC]), st.floats(-0.05, 0.05), st.booleans()
)
def test_bounds_are_neither_missed_nor_imagined(seed, degree, margin, of_velocity):
    trajectory = random_trajectory(seed, [degree], joints=1)
    truth = independent(trajectory, 0, int(of_velocity))
    values = truth(np.linspace(0.0, trajectory.duration, 20001))[:, 0]
    low, high = values.min(), values.max()
    span = slice(0, 1)
    control = trajectory.velocity_control(span) if of_velocity else trajectory.position_control(span)
    slack = margin * max(high - low, 1e-3)
    excess = first_excess(control, np.array([low - 1.0]), np.array([high + slack]))
    # The densest sampling is off the true extremum by this much.
    blur = 1e-6 * max(high - low, 1e-3)
    if slack > blur:
        assert excess is None
    elif slack < -blur:
        assert excess is not None
        assert excess.value > high + slack - 1e-9
        at = truth(excess.fraction * trajectory.duration)[0]
        assert excess.value == pytest.approx(at, abs=1e-7)


def test_a_curve_that_is_not_finite_is_outside():
    control = np.zeros((6, 2, 1))
    control[3, 1, 0] = np.nan
    assert first_excess(control, np.array([-1.0]), np.array([1.0])).segment == 1
    control[3, 1, 0] = np.inf
    assert first_excess(control, np.array([-1.0]), np.array([1.0])).segment == 1
