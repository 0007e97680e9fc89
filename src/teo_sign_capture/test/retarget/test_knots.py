# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from teo_common.arrays import Array
from teo_description.humanoid import load_humanoid
from teo_names import RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_sign_capture.retarget.knots import (
    FINGER_TUBE,
    TOLERANCE,
    passed,
    reduce_to_knots,
    smoothest_motion,
    tube_radii,
)

JOINTS = RIGHT_ARM + RIGHT_HAND
TEO = load_humanoid()
TIMES = np.arange(0.0, 1.5, 1.0 / 30.0)
MIDDLE = (joint_limits(JOINTS).lower + joint_limits(JOINTS).upper) / 2.0


def speed(positions: Array) -> Array:
    return np.abs(np.diff(positions, axis=0)).max(axis=0) / (TIMES[1] - TIMES[0])


@settings(max_examples=8)
@given(seed=st.integers(0, 1000), share=st.floats(0.0, 1.0))
def test_no_frame_leaves_the_tube_or_the_limits(seed: int, share: float) -> None:
    rng = np.random.default_rng(seed)
    limits = joint_limits(JOINTS)
    motion = np.clip(
        MIDDLE + np.cumsum(rng.normal(0.0, 0.2, (len(TIMES), 12)), axis=0), limits.lower, limits.upper
    )
    gentle = smoothest_motion(TEO, TIMES, JOINTS, motion, share=share)
    assert (np.abs(gentle - motion) <= share * tube_radii(TEO, JOINTS) + 1e-9).all()
    assert (gentle >= limits.lower - 1e-12).all()
    assert (gentle <= limits.upper + 1e-12).all()


def test_fingers_that_tremble_stand_still() -> None:
    rng = np.random.default_rng(1)
    noise = np.clip(rng.normal(0.0, np.radians(4.0), (len(TIMES), 12)), -FINGER_TUBE, FINGER_TUBE)
    motion = MIDDLE + noise * np.array([0.0] * 6 + [1.0] * 6)
    assert speed(motion)[6:].min() > np.radians(200.0)
    assert speed(smoothest_motion(TEO, TIMES, JOINTS, motion)).max() < 1e-6


def test_an_index_that_hooks_a_little_goes_on() -> None:
    """By 15 deg of its axis, 45 in all its joints, at 3 Hz: the tube of a still finger would take it away."""
    hooks = np.radians(7.5) * (1.0 - np.cos(2.0 * np.pi * 3.0 * TIMES))
    gentle = smoothest_motion(TEO, TIMES, JOINTS, MIDDLE + np.outer(hooks, [0.0] * 6 + [1.0] * 6))
    assert (np.ptp(gentle[:, 6:], axis=0) >= 0.5 * np.ptp(hooks) - 1e-9).all()


def test_it_is_the_gentlest() -> None:
    """No small change within the tube has less acceleration."""
    rng = np.random.default_rng(2)
    motion = MIDDLE + np.outer(TIMES, np.full(12, 0.3)) + rng.normal(0.0, 0.02, (len(TIMES), 12))
    gentle = smoothest_motion(TEO, TIMES, JOINTS, motion)
    radii = tube_radii(TEO, JOINTS)

    def bending(positions: Array) -> Array:
        return np.square(np.diff(positions, 2, axis=0)).sum(axis=0)

    for _ in range(50):
        other = np.clip(gentle + rng.normal(0.0, 1e-3, gentle.shape), motion - radii, motion + radii)
        other = gentle + 0.1 * (other - gentle)
        assert (bending(other) >= bending(gentle) - 1e-9).all()


@pytest.mark.filterwarnings("error")
def test_steps_and_limits_are_no_trouble_for_the_search() -> None:
    """Motions whose answer lies on the tube's edge for long: a step, and a joint that leaves its limit."""
    rng = np.random.default_rng(3)
    step = np.tile(MIDDLE, (len(TIMES), 1)) + 0.3 * (TIMES > 0.7)[:, None]
    upper = joint_limits(JOINTS).upper
    leaving = upper + np.minimum(0.0, np.round(np.cumsum(rng.normal(0.0, 0.05, (len(TIMES), 12)), axis=0), 2))
    for motion in (step, np.maximum(leaving, joint_limits(JOINTS).lower)):
        for share in (1.0, 0.25, 0.02):
            gentle = smoothest_motion(TEO, TIMES, JOINTS, motion, share=share)
            assert (np.abs(gentle - motion) <= share * tube_radii(TEO, JOINTS) + 1e-9).all()
            assert (gentle <= upper + 1e-12).all()


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


def test_a_slow_motion_needs_few_knots_and_a_fast_one_keeps_its_turns() -> None:
    slow, fast = (reduce_to_knots(TIMES, swinging(TIMES, frequency)) for frequency in (0.25, 3.0))
    assert len(slow) <= 12
    turns = np.flatnonzero(np.diff(np.sign(np.diff(swinging(TIMES, 3.0)[:, 0])))) + 1
    assert all(np.abs(fast - turn).min() <= 1 for turn in turns)


def test_the_spline_is_one_through_the_knots() -> None:
    times = np.linspace(0.0, 1.0, 11)
    knots = swinging(times, 0.5)
    between = np.linspace(0.0, 1.0, 101)
    # An independent spline, at rest at both ends.
    free = CubicSpline(times, knots, bc_type="clamped")(between)
    assert np.abs(passed(times, knots, between) - free).max() < np.radians(0.5)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_short_motions_keep_what_they_have(count: int) -> None:
    motion = np.array([[0.0], [1.0], [0.0]])[:count]
    assert reduce_to_knots(TIMES[:count], motion).tolist() == list(range(count))
    still = np.tile(MIDDLE, (count, 1))
    np.testing.assert_allclose(smoothest_motion(TEO, TIMES[:count], JOINTS, still), still, atol=1e-9)
