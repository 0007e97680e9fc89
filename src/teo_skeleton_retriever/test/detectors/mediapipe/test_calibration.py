# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from capsule_person import ROW, person_2d, pose

from teo_skeleton_retriever.detectors.mediapipe.calibration import (
    corrected_body,
    corrected_hand,
    elbow_error,
    extra_hand_sigma,
)


def at(distance: float) -> np.ndarray:
    return person_2d(pose((-0.2, 0.2, -0.1), (0.2, 0.2, -0.1), at=(0.0, -0.2, distance))).body


def test_shoulders_are_moved_out_and_down() -> None:
    moved = corrected_body(at(2.0)) - at(2.0)
    assert moved[ROW["LShoulder"], 0] > 0 > moved[ROW["RShoulder"], 0]  # the person faces the camera
    assert (moved[[ROW["LShoulder"], ROW["RShoulder"]], 1] > 0).all()
    assert not moved[ROW["Nose"]].any()


def test_who_stands_twice_as_far_is_moved_half_as_much_in_the_image() -> None:
    """About: elbows and nose are nearer than the shoulders, and are seen larger from near."""
    near, far = (corrected_body(at(d)) - at(d) for d in (1.5, 3.0))
    np.testing.assert_allclose(near[ROW["LShoulder"]], 2 * far[ROW["LShoulder"]], rtol=0.1)


def test_without_hips_shoulders_are_moved_out_by_what_else_is_seen() -> None:
    whole = corrected_body(at(2.0))
    half = at(2.0).copy()
    half[ROW["MidHip"]] = 0.0
    difference = (whole - corrected_body(half))[ROW["LShoulder"], :2]
    trunk = (at(2.0)[ROW["MidHip"]] - at(2.0)[ROW["Neck"]])[:2]
    np.testing.assert_allclose(difference, 0.044 * trunk, atol=1e-9)


HAND = pose((-0.4, -0.2, -0.1), (0.25, 0.05, -0.2), curl=0.3).right_hand
MIRROR = np.array([-1.0, 1.0, 1.0])


def test_the_wrist_moves_away_from_the_fingers_and_finger_tips_stay() -> None:
    moved = corrected_hand(HAND, left=False)
    along = HAND[9] - HAND[0]
    assert (moved[0] - HAND[0]) @ along < -0.1 * along @ along
    np.testing.assert_array_equal(moved[[8, 12, 16, 20]], HAND[[8, 12, 16, 20]])


def test_a_left_hand_is_a_right_hand_in_the_mirror() -> None:
    left = corrected_hand(HAND * MIRROR, left=True)
    np.testing.assert_allclose(left * MIRROR, corrected_hand(HAND, left=False), atol=1e-12)


def test_a_hand_twice_as_large_is_moved_twice_as_far() -> None:
    one, two = corrected_hand(HAND, left=False) - HAND, corrected_hand(2 * HAND, left=False) - 2 * HAND
    np.testing.assert_allclose(two, 2 * one, atol=1e-12)


ACROSS, POINTED = 1.0, 0.4  # parts of a forearm's length that are seen


@pytest.mark.parametrize("forearm", [ACROSS, POINTED])
def test_an_elbow_is_farther_off_the_less_the_detector_is_sure_of_it(forearm: float) -> None:
    confidences = (1.0, 0.999, 0.99, 0.98, 0.95, 0.9, 0.5, 0.0)
    sigmas = [elbow_error(confidence, forearm).sigma for confidence in confidences]
    assert sigmas == sorted(sigmas)
    assert sigmas[0] == pytest.approx(0.02)
    assert sigmas[-1] < 0.12


@pytest.mark.parametrize("confidence", [0.99, 0.96, 0.9])
def test_an_elbow_behind_a_forearm_that_points_at_the_camera_is_a_guess(confidence: float) -> None:
    assert elbow_error(confidence, POINTED).sigma > 1.5 * elbow_error(confidence, ACROSS).sigma
    between = elbow_error(confidence, 0.75).sigma
    assert elbow_error(confidence, ACROSS).sigma < between < elbow_error(confidence, POINTED).sigma


def test_only_an_elbow_whose_forearm_points_at_the_camera_is_seen_too_near_to_the_shoulder() -> None:
    short = [elbow_error(confidence, POINTED).short for confidence in (1.0, 0.99, 0.97, 0.9, 0.0)]
    assert short == sorted(short)
    assert short[0] == 0.0
    assert 0.04 < short[-1] < 0.06
    assert elbow_error(0.9, ACROSS).short == 0.0


def test_a_hand_is_doubted_the_more_the_less_it_seems_to_be_there_and_not_in_plain_view() -> None:
    doubts = extra_hand_sigma(np.array([1.0, 0.98, 0.9, 0.8, 0.6, 0.0]))
    assert (np.diff(doubts) >= 0.0).all()
    assert doubts[0] == doubts[1] == 0.0
    assert 0.01 < doubts[-1] < 0.03
