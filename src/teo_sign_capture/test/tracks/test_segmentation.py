# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_tracks import HANGING, Move, make_track, path
from refusals import refused
from scipy.ndimage import gaussian_filter1d

from teo_sign_capture.signing_space import MIRROR
from teo_sign_capture.tracks.segmentation import SignSpan, find_signs, the_sign
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track

RATE = 30.0
FRAMES = 2.0 / RATE  # [s]
REST = tuple(HANGING["right"])
CHIN, OUT, SIDE = (0.25, -0.05, 0.05), (0.42, -0.08, -0.05), (0.30, -0.35, 0.0)


def track_of(moves: list[Move], duration: float) -> SkeletonTrack:
    times = np.arange(0.0, duration, 1.0 / RATE)
    return make_track(times, path(times, REST, moves), noise=0.008)


def spans_of(track: SkeletonTrack) -> tuple[SignSpan, ...]:
    return find_signs(smooth_track(track).track)


ONE = [(0.5, 1.1, CHIN), (1.2, 1.6, OUT), (1.7, 2.3, REST)]


@settings(max_examples=8)
@given(
    up=st.floats(0.4, 0.8),
    stroke=st.floats(0.25, 0.8),
    down=st.floats(0.4, 0.8),
    side=st.floats(-0.4, 0.1),
    seed=st.integers(0, 100),
)
def test_boundaries_are_within_two_images_at_any_pace(
    up: float, stroke: float, down: float, side: float, seed: int
) -> None:
    begin, end = 0.5 + up, 0.5 + up + stroke
    moves: list[Move] = [(0.5, begin, CHIN), (begin, end, (0.42, side, -0.1)), (end, end + down, REST)]
    times = np.arange(0.0, end + down + 0.6, 1.0 / RATE)
    (span,) = spans_of(make_track(times, path(times, REST, moves), noise=0.005, seed=seed))
    assert span.start == pytest.approx(begin, abs=FRAMES)
    assert span.end == pytest.approx(end, abs=FRAMES)
    assert 0.5 < span.leaves < begin and end < span.returns < end + down + 0.1
    assert span.handedness == "right" and not span.cut_start and not span.cut_end


def test_a_sign_that_is_held_is_the_hold() -> None:
    (span,) = spans_of(track_of([(0.5, 1.1, CHIN), (1.8, 2.4, REST)], 3.0))
    assert span.start == pytest.approx(1.1, abs=3.0 / RATE)  # the last centimetre of the way up is slow
    assert span.end == pytest.approx(1.8, abs=3.0 / RATE)


def test_a_sign_that_is_but_a_touch_lasts_a_little() -> None:
    (span,) = spans_of(track_of([(0.5, 1.1, CHIN), (1.1, 1.7, REST)], 2.4))
    assert 0.3 <= span.duration <= 0.4
    assert span.start - 0.05 <= 1.1 <= span.end + 0.05


def test_a_sign_that_is_swung_into_and_out_of_is_kept_whole() -> None:
    """A hand that sweeps aside before the chest without slowing down: what it sweeps is the sign."""
    times = np.arange(0.0, 2.4, 1.0 / RATE)
    way = np.array([REST, REST, (0.30, -0.40, 0.0), (0.40, 0.10, 0.0), REST, REST])
    # Up in 0.5 s, across in 0.4 s at 1.3 m/s, down in 0.5 s; corners as round as those of hands.
    straight = np.stack([np.interp(times, (0.0, 0.5, 1.0, 1.4, 1.9, 2.4), axis) for axis in way.T], axis=1)
    rounded = gaussian_filter1d(straight, 0.06 * RATE, axis=0, mode="nearest")
    (span,) = spans_of(make_track(times, rounded, noise=0.005))
    assert span.start == pytest.approx(1.0, abs=2.0 * FRAMES)
    assert span.end == pytest.approx(1.4, abs=2.0 * FRAMES)


def test_a_hand_whose_depth_is_guessed_wrong_on_its_way_up_and_down_signs_not_yet() -> None:
    """In films a hand that passes the belly seems up to 20 cm too far forward."""
    times = np.arange(0.0, 3.0, 1.0 / RATE)
    wrist = path(times, REST, [(0.5, 1.1, CHIN), (1.2, 1.6, (0.25, -0.20, 0.0)), (1.7, 2.3, REST)])
    wrist[:, 0] += 0.2 * np.exp(-np.square((wrist[:, 2] + 0.30) / 0.10))
    (span,) = spans_of(make_track(times, wrist, noise=0.005))
    assert span.start == pytest.approx(1.1, abs=2.0 * FRAMES)
    assert span.end == pytest.approx(1.7, abs=2.0 * FRAMES)


def test_a_shake_that_never_stops_is_kept_whole() -> None:
    times = np.arange(0.0, 2.8, 1.0 / RATE)
    held = path(times, REST, [(0.5, 1.0, CHIN), (1.8, 2.3, REST)])
    shake = 0.05 * np.sin(2.0 * np.pi * 4.0 * (times - 1.0)) * ((times > 0.9) & (times < 1.9))
    (span,) = spans_of(make_track(times, held + shake[:, None] * (0.0, 1.0, 0.0), noise=0.005))
    assert span.start == pytest.approx(1.0, abs=0.15)
    assert span.end == pytest.approx(1.8, abs=0.15)


def test_a_hand_that_is_held_and_does_nothing_takes_no_part() -> None:
    times = np.arange(0.0, 3.0, 1.0 / RATE)
    belly = np.tile((0.15, 0.25, -0.25), (len(times), 1))
    (span,) = spans_of(make_track(times, path(times, REST, ONE), belly, noise=0.008))
    assert (span.handedness, span.held) == ("right", ("left",))


def test_a_scratch_beside_the_sign_is_no_second_sign() -> None:
    fidget: list[Move] = [(3.2, 3.5, (0.12, -0.22, -0.32)), (3.6, 3.9, REST)]
    assert len(spans_of(track_of([*ONE, *fidget], 4.6))) == 1


@pytest.mark.parametrize(("right", "hands"), [(True, "both"), (False, "left")])
def test_the_hands_that_sign_are_told(right: bool, hands: str) -> None:
    times = np.arange(0.0, 3.0, 1.0 / RATE)
    signs = path(times, REST, ONE)
    other = signs if right else np.tile(HANGING["right"], (len(times), 1))
    (span,) = spans_of(make_track(times, other, signs * MIRROR, noise=0.008))
    assert span.handedness == hands


def test_a_beat_that_returns_to_rest_shortly_is_one_sign() -> None:
    moves = [*ONE[:2], (1.7, 2.0, REST), (2.1, 2.4, CHIN), (2.5, 2.9, REST)]
    assert len(spans_of(track_of(moves, 3.6))) == 1


def test_many_signs_without_rest_are_too_long_and_their_pauses_named() -> None:
    places = [CHIN, SIDE, OUT] * 3
    moves = [(0.5 + 0.6 * index, 1.0 + 0.6 * index, place) for index, place in enumerate(places)]
    track = smooth_track(track_of([*moves, (6.0, 6.6, REST)], 7.2)).track
    with refused("too_long") as error:
        the_sign(track)
    pauses = find_signs(track)[0].pauses
    assert min(abs(pause - 1.65) for pause in pauses) < 0.1
    assert f"{pauses[0]:.2f}" in str(error.value)


@pytest.mark.parametrize("moves", [[], [(0.5, 0.8, (0.10, -0.20, -0.46)), (0.9, 1.2, REST)]])
def test_hands_that_stay_at_rest_or_fidget_are_no_sign(moves: list[Move]) -> None:
    track = smooth_track(track_of(moves, 2.0)).track
    assert find_signs(track) == ()
    with refused("no_motion"):
        the_sign(track)


def test_hands_that_rest_below_the_image_are_at_rest() -> None:
    track = track_of(ONE, 3.0)
    wrist = track.body.positions[:, 4].copy()
    wrist[wrist[:, 2] < -0.45] = np.nan
    (span,) = spans_of(make_track(track.times, wrist))
    assert span.start == pytest.approx(1.1, abs=FRAMES)
    assert span.end == pytest.approx(1.7, abs=FRAMES)


def test_a_hanging_hand_whose_depth_is_guessed_is_at_rest() -> None:
    """Lifted from a film, an arm that seems 3 cm too short is a hand 20 cm forward."""
    times = np.arange(0.0, 3.0, 1.0 / RATE)
    hanging = np.tile(HANGING["left"], (len(times), 1))
    hanging[:, 0] += 0.2 * (np.sin(2.0 * np.pi * 1.5 * times) > 0.5)
    (span,) = spans_of(make_track(times, path(times, REST, ONE), hanging, noise=0.008))
    assert not span.cut_start
    assert not span.cut_end
    assert (span.handedness, span.start) == ("right", pytest.approx(1.1, abs=FRAMES))


def test_a_recording_cut_within_the_sign_says_so() -> None:
    (span,) = find_signs(smooth_track(track_of(ONE, 3.0)).track.between(0.9, 1.65))
    assert span.cut_start
    assert span.cut_end
