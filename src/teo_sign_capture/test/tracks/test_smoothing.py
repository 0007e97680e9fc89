# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from made_tracks import lose, make_track, path

from teo_common.arrays import Array
from teo_sign_capture.tracks.smoothing import LONGEST_FILLED, smooth_positions, smooth_track

MIDDLE = np.array([0.3, -0.2, -0.1])
WRIST = 4


def shaking(times: Array, frequency: float = 3.0, amplitude: float = 0.08) -> Array:
    return MIDDLE + np.outer(np.sin(2.0 * np.pi * frequency * times), [0.0, amplitude, 0.0])


def smoothed_wrist(times: Array, truth: Array, noise: float) -> Array:
    return smooth_track(make_track(times, truth, noise=noise)).track.body.positions[:, WRIST]


@pytest.mark.parametrize(("rate", "kept"), [(30.0, 0.98), (15.0, 0.95)])
def test_a_hand_that_shakes_at_3_hz_keeps_its_amplitude(rate: float, kept: float) -> None:
    times = np.arange(0.0, 3.0, 1.0 / rate)
    wrist = smoothed_wrist(times, shaking(times), noise=0.010)
    waves = np.column_stack([np.sin(6.0 * np.pi * times), np.cos(6.0 * np.pi * times), np.ones(len(times))])
    amplitude = np.hypot(*np.linalg.lstsq(waves, wrist[:, 1], rcond=None)[0][:2])
    assert kept * 0.08 < amplitude < 1.03 * 0.08


def test_noise_becomes_less() -> None:
    times = np.arange(0.0, 3.0, 1.0 / 30.0)
    truth = shaking(times, frequency=1.0)
    error = smoothed_wrist(times, truth, noise=0.010) - truth
    assert np.sqrt(np.square(error).mean()) < 0.75 * 0.010


def test_a_keypoint_that_jumps_for_an_image_is_not_followed() -> None:
    times = np.arange(0.0, 2.0, 1.0 / 30.0)
    positions = np.tile(MIDDLE, (len(times), 1, 1)).reshape(-1, 1, 3)
    positions[30] += [0.0, 0.3, 0.0]
    smooth = smooth_positions(times, positions, np.full(positions.shape[:2], 0.010))
    assert np.abs(smooth - MIDDLE).max() < 0.03


def test_a_better_measured_keypoint_counts_more() -> None:
    times = np.arange(0.0, 1.0, 1.0 / 30.0)
    positions = np.tile(MIDDLE, (len(times), 1, 1)).reshape(-1, 1, 3)
    positions[::2] += [0.0, 0.04, 0.0]
    sigma = np.full(positions.shape[:2], 0.005)
    sigma[::2] = 0.030
    smooth = smooth_positions(times, positions, sigma)
    assert np.abs(smooth[5:-5, 0, 1] - MIDDLE[1]).max() < 0.01


def test_a_short_gap_is_filled_and_said_a_long_one_is_left() -> None:
    times = np.arange(0.0, 3.0, 1.0 / 30.0)
    truth = path(times, MIDDLE, [(0.5, 1.0, MIDDLE + np.array([0.0, 0.2, 0.0])), (1.6, 2.4, MIDDLE)])
    whole = make_track(times, truth)
    track = lose(lose(whole, "body", 0.7, 0.8), "body", 1.7, 2.3)
    smooth = smooth_track(track)
    wrist = smooth.track.body.positions[:, WRIST]
    short, long = (times > 0.65) & (times < 0.85), (times > 1.75) & (times < 2.25)
    assert np.abs(wrist[short] - truth[short]).max() < 0.02
    assert np.isnan(wrist[long]).all()
    gaps = [gap for gap in smooth.gaps if gap.part == "body"]
    assert len(gaps) == 2
    assert gaps[0].start == pytest.approx(0.7, abs=0.04)
    assert gaps[1].end - gaps[1].start > LONGEST_FILLED


@pytest.mark.parametrize(
    ("start", "end", "within"),
    [
        (0.68, 1.02, 0.03),  # for the whole of a movement: only its wrist knows when it moved
        (0.3, 1.4, 0.02),  # hidden for longer, its shape the same before and after
        (0.0, 0.25, 0.03),  # found late
    ],
)
def test_a_hand_that_is_lost_goes_with_its_wrist_in_the_shape_it_has_before_or_after(
    start: float, end: float, within: float
) -> None:
    times = np.arange(0.0, 2.5, 1.0 / 30.0)
    whole = make_track(times, path(times, MIDDLE, [(0.7, 1.0, MIDDLE + np.array([0.0, 0.3, 0.0]))]))
    smooth = smooth_track(lose(whole, "right_hand", start, end)).track.right_hand.positions
    assert np.abs(smooth - whole.right_hand.positions).max() < within


def test_a_single_image_is_left_as_it_is() -> None:
    track = make_track(np.array([0.0]), np.array([MIDDLE]))
    np.testing.assert_allclose(smooth_track(track).track.body.positions[:, WRIST], [MIDDLE])
