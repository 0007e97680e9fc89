# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pytest
from refusals import refused

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_sign_capture.entries.take_combination import combine
from teo_sign_capture.retarget.robot_motion import RobotMotion

NAMES = ("one", "two", "three", "four", "five")
RAISED = np.radians([-73.0, 10.0, 10.0, -75.0, 35.0, 2.0, 10.0, 8.0, 8.0, 8.0, 8.0, 8.0])


def motion(
    shape: Callable[[Array], Array],
    *,
    duration: float = 1.0,
    noise: float = 0.0,
    seed: int = 0,
    error: float = 0.02,
    joints: tuple[str, ...] = RIGHT_ARM + RIGHT_HAND,
) -> RobotMotion:
    """The forearm turns by an angle [rad], `shape` of the share of the time, 0 to 1."""
    times = np.arange(0.0, duration, 1.0 / 30.0)
    positions = np.tile(RAISED, (len(times), len(joints) // len(RAISED)))
    positions[:, 4] += shape(times / times[-1])
    positions[:, :6] += np.random.default_rng(seed).normal(0.0, noise, (len(times), 6))
    errors = np.full((len(times), 2), error)
    errors[:, 1] = np.nan
    figures = [field.name for field in fields(RobotMotion)[3:-1]]
    return RobotMotion(
        times=times, joints=joints, positions=positions, **dict.fromkeys(figures, errors), handshapes={}
    )


def wave(share: Array) -> Array:
    return 0.5 * np.sin(2.0 * np.pi * share)


def hurried(share: Array) -> Array:
    """The same wave, begun slowly and ended fast."""
    return wave(share**1.4)


def other(share: Array) -> Array:
    return -0.8 * np.sin(np.pi * share) - 0.3


def test_one_take_is_taken_as_it_is(robot: Robot) -> None:
    take = motion(wave)
    combined = combine(robot, [take], NAMES[:1])
    np.testing.assert_array_equal(combined.positions, take.positions)
    assert combined.used == (0,)


def test_the_mean_of_takes_is_nearer_to_the_truth_than_any(robot: Robot) -> None:
    takes = [motion(wave, noise=0.06, seed=seed, duration=1.0 + 0.1 * seed) for seed in range(4)]
    combined = combine(robot, takes, NAMES[:4])
    assert combined.used == (0, 1, 2, 3)
    truth = motion(wave, duration=1.0 + 0.1 * combined.leader).positions
    mean_error = np.abs(combined.positions[:, :6] - truth[:, :6]).mean()
    errors = [
        np.abs(take.positions[:, :6] - motion(wave, duration=1.0 + 0.1 * i).positions[:, :6]).mean()
        for i, take in enumerate(takes)
    ]
    assert mean_error < 0.7 * min(errors)
    assert combined.times[-1] == pytest.approx(np.mean([take.times[-1] for take in takes]), rel=1e-6)
    assert "Mean of 4" in combined.reason


def test_pace_does_not_make_an_outlier_another_sign_does(robot: Robot) -> None:
    takes = [
        motion(wave, noise=0.01),
        motion(hurried, noise=0.01, seed=1),
        motion(other),
        motion(wave, duration=1.6),
    ]
    combined = combine(robot, takes, NAMES[:4])
    assert combined.used == (0, 1, 3)
    assert "three is left out" in combined.reason


def test_of_two_takes_the_better_is_chosen(robot: Robot) -> None:
    combined = combine(robot, [motion(wave, error=0.10), motion(hurried, error=0.01)], NAMES[:2])
    assert combined.used == (1,)
    assert "two is taken" in combined.reason


def test_takes_that_differ_too_much_for_a_mean_are_not_averaged(robot: Robot) -> None:
    takes = [motion(lambda share, a=a: a * np.sin(np.pi * share)) for a in (0.2, 0.6, 1.0)]
    combined = combine(robot, takes, NAMES[:3])
    assert len(combined.used) == 1
    assert "too much for a mean" in combined.reason


def test_takes_of_different_hands_are_refused(robot: Robot) -> None:
    both = motion(wave, joints=RIGHT_ARM + RIGHT_HAND + LEFT_ARM + LEFT_HAND)
    with refused("takes_differ") as error:
        combine(robot, [motion(wave), both], NAMES[:2])
    assert "two" in str(error.value)
