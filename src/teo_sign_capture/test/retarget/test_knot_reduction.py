# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Knots are few, and what passes through them stays near the motion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from teo_common.arrays import Array
from teo_sign_capture.retarget.knots import TOLERANCE, deviations, passed, reduce_to_knots

TIMES = np.arange(0.0, 2.0, 1.0 / 30.0)


def swinging(times: Array, frequency: float, amplitude: float = 0.4) -> Array:
    return np.column_stack([amplitude * np.sin(2.0 * np.pi * frequency * times), 0.2 * times])


@settings(max_examples=12)
@given(frequency=st.floats(0.1, 3.0), amplitude=st.floats(0.01, 0.8))
def test_no_frame_is_farther_than_the_tolerance(frequency: float, amplitude: float) -> None:
    motion = swinging(TIMES, frequency, amplitude)
    knots = reduce_to_knots(TIMES, motion)
    assert knots[0] == 0
    assert knots[-1] == len(TIMES) - 1
    # Straight lines, worked out apart from the code.
    for column in motion.T:
        assert np.abs(np.interp(TIMES, TIMES[knots], column[knots]) - column).max() <= TOLERANCE
    assert np.abs(passed(TIMES[knots], motion[knots], TIMES) - motion).max() <= TOLERANCE
    assert deviations(TIMES, motion, TIMES[knots], motion[knots]).max() <= TOLERANCE


def test_a_slow_motion_needs_few_knots_and_a_fast_one_keeps_its_turns() -> None:
    slow, fast = (reduce_to_knots(TIMES, swinging(TIMES, frequency)) for frequency in (0.25, 3.0))
    assert len(slow) <= 12
    turns = np.flatnonzero(np.diff(np.sign(np.diff(swinging(TIMES, 3.0)[:, 0])))) + 1
    assert all(np.abs(fast - turn).min() <= 1 for turn in turns)


def test_the_spline_is_one_through_the_knots() -> None:
    times = np.linspace(0.0, 1.0, 11)
    knots = swinging(times, 0.5)
    between = np.linspace(0.0, 1.0, 101)
    free = CubicSpline(times, knots, bc_type="clamped")(
        between
    )  # an independent spline, at rest at both ends
    assert np.abs(passed(times, knots, between) - free).max() < np.radians(0.5)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_short_motions_keep_what_they_have(count: int) -> None:
    motion = np.array([[0.0], [1.0], [0.0]])[:count]
    assert reduce_to_knots(TIMES[:count], motion).tolist() == list(range(count))


def test_a_still_motion_is_two_knots() -> None:
    assert reduce_to_knots(TIMES, np.ones((len(TIMES), 3))).tolist() == [0, len(TIMES) - 1]
