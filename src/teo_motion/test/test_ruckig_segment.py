# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_motion.trajectory.ruckig_segment import Bounds, RuckigSegment, RuckigSolver, State
from teo_motion.trajectory.waypoint_chain import waypoint_states
from teo_signs.errors import PlanError

numbers = st.floats(-1.0, 1.0)


def one(value: float) -> np.ndarray:
    return np.array([value])


def bounds(velocity: float = 0.87, acceleration: float = 5.0, jerk: float = 52.0) -> Bounds:
    return Bounds(*map(one, (-10.0, 10.0, velocity, acceleration, jerk)))


def moved(
    start: tuple[float, float, float], end: tuple[float, float, float], duration: float
) -> RuckigSegment | None:
    states = [State(*map(one, numbers)) for numbers in (start, end)]
    return RuckigSolver(1).segment(*states, bounds(), duration=duration)


@settings(max_examples=300)
@given(p=numbers, q=numbers, v=numbers, w=numbers, a=numbers, b=numbers, duration=st.floats(0.0, 3.0))
def test_the_range_of_a_move_is_exact(
    p: float, q: float, v: float, w: float, a: float, b: float, duration: float
) -> None:
    # The solver's own extremes miss joints that turn at constant acceleration.
    segment = moved((p, 0.5 * v, 3.0 * a), (q, 0.5 * w, 3.0 * b), duration)
    if segment is None:
        return
    (lengths,) = segment.pieces.lengths
    if not lengths.any():  # a time may be so short that its parts are nothing
        return
    times = np.linspace(0.0, 1.0, 400)[:, None] * lengths
    dense = segment.pieces.after(times[:, None, :])[0][:, :, lengths > 0.0]
    least, greatest = segment.pieces.range()
    assert least[0] <= dense.min() + 1e-12 and greatest[0] >= dense.max() - 1e-12
    step = 1.0 / 400 * float(lengths.max())
    assert least[0] >= dense.min() - 0.87 * step and greatest[0] <= dense.max() + 0.87 * step


@pytest.mark.parametrize(
    ("joints", "speed", "most"),
    [(1, np.nan, 0.87), (1, np.inf, 0.87), (2, 0.0, 0.87), (1, 0.0, 0.0)],
)
def test_the_solver_is_given_numbers_of_its_joints_and_limits_above_0(
    joints: int, speed: float, most: float
) -> None:
    start, end = (State(one(0.0), one(v), one(0.0)) for v in (speed, 0.0))
    with pytest.raises(PlanError) as refusal:
        RuckigSolver(joints).segment(start, end, bounds(velocity=most), duration=1.0)
    assert refusal.value.code == "bad_state"


knot_lists = st.integers(2, 8).flatmap(
    lambda n: st.tuples(
        st.lists(st.floats(0.01, 2.0), min_size=n - 1, max_size=n - 1),
        st.lists(numbers, min_size=n, max_size=n),
    )
)


@given(knot_lists)
def test_knots_are_passed_the_way_the_joint_goes(knots: tuple[list[float], list[float]]) -> None:
    times = np.concatenate([[0.0], np.cumsum(knots[0])])
    positions = np.array(knots[1])[:, None]
    velocities, accelerations = waypoint_states(times, positions, np.ones_like(positions), swing=0.0)
    chords = np.diff(positions[:, 0]) / np.diff(times)
    assert velocities[0] == velocities[-1] == accelerations[0] == accelerations[-1] == 0.0
    for i in range(1, len(times) - 1):
        before, after = chords[i - 1], chords[i]
        bound = min(abs(before), abs(after)) * (3.0 if before * after > 0.0 else 1.0)
        assert abs(velocities[i, 0]) <= bound + 1e-12
        if before == 0.0 or after == 0.0:
            assert velocities[i, 0] == 0.0 and accelerations[i, 0] == 0.0


def test_dense_knots_of_a_smooth_motion_are_passed_as_it_does() -> None:
    times = np.arange(0.0, 2.0, 0.05)
    positions = np.sin(3.0 * times)[:, None]
    velocities, accelerations = waypoint_states(times, positions, np.ones_like(positions), swing=0.02)
    middle = slice(8, -8)
    np.testing.assert_allclose(velocities[middle, 0], 3.0 * np.cos(3.0 * times[middle]), atol=0.01)
    np.testing.assert_allclose(accelerations[middle, 0], -9.0 * np.sin(3.0 * times[middle]), atol=0.3)
