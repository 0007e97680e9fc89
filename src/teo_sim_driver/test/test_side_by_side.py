# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Trajectories of different joints in one: each goes on exactly as it would alone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_sim_driver.motion.commanded_path import Part, side_by_side, slowed_down
from teo_sim_driver.motion.path_time import Braking
from teo_sim_driver.motion.trajectory import Trajectory

DEGREES = st.lists(st.sampled_from([1, 3, 5]), min_size=0, max_size=5)


def random_trajectory(rng, degrees, joints):
    points = len(degrees) + 1
    return Trajectory(
        np.concatenate([[0.0], np.cumsum(rng.uniform(0.005, 1.0, points - 1))]),
        *rng.normal(size=(3, points, joints)),
        np.repeat(np.array(degrees, np.int8).reshape(-1, 1), joints, axis=1),
    )


@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.integers(0, 2**32), DEGREES, DEGREES)
def test_each_part_moves_as_it_would_alone(seed, first, second):
    rng = np.random.default_rng(seed)
    parts = [
        Part(np.array([2, 0]), random_trajectory(rng, first, 2)),
        Part(np.array([1]), random_trajectory(rng, second, 1)),
    ]
    together = side_by_side(parts)
    assert together.duration == max(part.trajectory.duration for part in parts)
    times = rng.uniform(0.0, together.duration * 1.1, 40)
    sampled = [np.array(values) for values in zip(*(together.sample(time) for time in times), strict=True)]
    for columns, alone in parts:
        for ours, truth in zip(sampled, alone.states(times), strict=True):
            np.testing.assert_allclose(ours[:, columns], truth, rtol=1e-7, atol=1e-6)


def test_points_at_the_same_time_but_for_rounding_make_no_segment_of_their_own():
    rng = np.random.default_rng(3)
    one = random_trajectory(rng, [5, 5], 1)
    other = Trajectory(one.times + np.array([0.0, 1e-13, 2e-13]), *rng.normal(size=(3, 3, 1)), one.degrees)
    assert len(side_by_side([Part(np.array([0]), one), Part(np.array([1]), other)]).times) == 3


@pytest.mark.parametrize("start", [0.3, 1.0, 1.9])
def test_slowing_down_ends_at_rest_on_the_path_within_its_bounds(start):
    # A turn of 0.7 rad/s: its place is known in closed form, and the stop must lie on it.
    times = np.linspace(0.0, 4.0, 401)
    angle = 0.7 * times[:, None]
    path = Trajectory.quintic(times, np.sin(angle), 0.7 * np.cos(angle), -0.49 * np.sin(angle))
    stop = slowed_down(path, start, np.array([0.9]), Braking(5.2, 105.0))
    states = stop.states(np.linspace(0.0, stop.duration, 500))
    own = 0.7 * start
    np.testing.assert_allclose(states.positions[0], np.sin(own), atol=1e-9)
    np.testing.assert_allclose(states.velocities[0], 0.7 * np.cos(own), atol=1e-6)
    assert not stop.sample(stop.duration).velocities.any()
    assert 0.05 < stop.duration < 0.7 / 5.2 + 5.2 / 105.0 + 0.05
    assert np.abs(states.accelerations).max() < 5.2 + 0.49 + 0.1
    travelled = np.arcsin(np.clip(states.positions[:, 0], -1.0, 1.0)) / 0.7 - start
    assert travelled.max() < 0.5 * stop.duration + 0.03
