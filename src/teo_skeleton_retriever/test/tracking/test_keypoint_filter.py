# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from teo_skeleton_retriever.tracking.keypoint_filter import FilterOutput, KeypointFilter

RATE = 30.0  # [1/s]
SIGMA = np.array([0.003, 0.003, 0.008])  # of x/z, y/z and z [m] at 1.5 m


def make(n: int = 1, *, smoothing: float = 1.0, acceleration: float = 25.0) -> KeypointFilter:
    return KeypointFilter(n, acceleration=acceleration, hold_time=0.3, smoothing=smoothing)


def play(filter_: KeypointFilter, values: np.ndarray, start: float = 0.0) -> list[FilterOutput]:
    """Values of shape (images, n, 3)."""
    sigma = np.broadcast_to(SIGMA, values.shape[1:])
    return [filter_.step(start + i / RATE, value, sigma) for i, value in enumerate(values)]


def depths(outputs: list[FilterOutput]) -> np.ndarray:
    return np.array([output.depth for output in outputs])


def still(images: int, n: int, seed: int = 0) -> np.ndarray:
    noise = np.random.default_rng(seed).normal(size=(images, n, 3)) * SIGMA
    return np.array([0.1, -0.2, 1.5]) + noise


@pytest.mark.parametrize("frequency", [1.0, 2.5])
def test_a_fast_hand_is_followed_without_delay(frequency: float) -> None:
    times = np.arange(90) / RATE
    truth = 1.5 + 0.15 * np.sin(2 * math.pi * frequency * times)  # 2.5 Hz: 2.4 m/s, 37 m/s^2
    seen = still(90, 1)
    seen[:, 0, 2] += truth - 1.5
    error = depths(play(make(), seen))[30:, 0] - truth[30:]
    assert np.sqrt(np.mean(error**2)) < 0.015


def test_a_single_depth_far_off_is_not_believed_three_in_a_row_are() -> None:
    seen = still(40, 1)
    seen[20, 0, 2] = 2.5
    seen[30:, 0, 2] = 2.5
    outputs = play(make(), seen)
    found = depths(outputs)[:, 0]
    assert found[20] == pytest.approx(1.5, abs=0.05)
    assert not outputs[20].fresh[0]
    assert found[30] < 1.6
    assert found[32] == pytest.approx(2.5, abs=0.05)


def test_a_single_jump_sideways_is_not_believed_three_in_a_row_are() -> None:
    filter_ = make()
    play(filter_, still(20, 1))
    far, across = np.array([[0.5, -0.2]]), np.array([0.01])
    believed = [bool(filter_.believable((20 + i) / RATE, far, across)[0]) for i in range(3)]
    assert believed == [False, False, True]
    assert filter_.believable(1.0, np.array([[0.1, -0.2]]), across)[0]


def test_a_stroke_that_begins_within_what_arms_can_do_is_believed_at_once() -> None:
    """3 m/s from rest, sideways and in depth; twice the greatest speed is not believed."""
    for speed, expected in ((3.0, True), (10.0, False)):
        filter_ = KeypointFilter(1, acceleration=25.0, speed=5.0, hold_time=0.3, smoothing=1.0)
        play(filter_, still(30, 1))
        moved = np.array([[0.1 + speed / RATE / 1.5, -0.2, 1.5 + speed / RATE]])
        across = np.array([0.005])
        assert filter_.believable(1.0, moved[:, :2], across)[0] == expected
        assert filter_.step(1.0, moved, SIGMA[None]).fresh[0] == expected


def test_a_keypoint_seen_without_depth_moves_in_the_image() -> None:
    filter_ = make()
    play(filter_, still(20, 1))
    seen = np.full((10, 1, 3), math.nan)
    seen[..., 0], seen[..., 1] = 0.1 + 0.01 * np.arange(10)[:, None], -0.2
    outputs = play(filter_, seen, start=20 / RATE)
    assert outputs[-1].rays[0, 0] == pytest.approx(0.19, abs=0.01)
    assert outputs[-1].depth[0] == pytest.approx(1.5, abs=0.1)
    assert not outputs[-1].fresh[0]


def test_a_held_hand_comes_to_rest() -> None:
    filter_ = make()
    seen = still(20, 1)
    seen[:, 0, 2] += np.arange(20) * 0.05  # 1.5 m/s
    play(filter_, seen)
    held = depths(play(filter_, np.full((8, 1, 3), math.nan), start=20 / RATE))[:, 0]
    assert held[-1] - seen[-1, 0, 2] < 1.5 * 0.17 + 0.03
    assert np.diff(held)[-1] < 0.5 * np.diff(held)[0]


def test_what_is_not_seen_is_held_with_growing_doubt_then_forgotten() -> None:
    filter_ = make()
    play(filter_, still(20, 1))
    outputs = play(filter_, np.full((12, 1, 3), math.nan), start=20 / RATE)
    sigmas = [float(output.sigma[0, 2]) for output in outputs]
    assert all(later > earlier for earlier, later in pairwise(sigmas[:8]))
    assert math.isnan(outputs[-1].depth[0])
