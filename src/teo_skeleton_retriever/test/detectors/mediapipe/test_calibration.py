# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from capsule_person import ROW, person_2d, pose

from teo_skeleton_retriever.detectors.mediapipe.calibration import (
    corrected_body,
    corrected_hand,
    elbow_error,
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


HAND = pose((-0.4, -0.2, -0.1), (0.25, 0.05, -0.2), curl=0.3).right_hand
MIRROR = np.array([-1.0, 1.0, 1.0])


def test_the_wrist_moves_away_from_the_fingers_and_finger_tips_stay() -> None:
    moved = corrected_hand(HAND, left=False)
    along = HAND[9] - HAND[0]
    assert (moved[0] - HAND[0]) @ along < -0.1 * along @ along
    np.testing.assert_array_equal(moved[[8, 12, 16, 20]], HAND[[8, 12, 16, 20]])


def test_a_left_hand_is_a_right_hand_in_the_mirror_of_any_size() -> None:
    left = corrected_hand(2.0 * HAND * MIRROR, left=True)
    np.testing.assert_allclose(left * MIRROR, 2.0 * corrected_hand(HAND, left=False), atol=1e-12)


ACROSS, POINTED = 1.0, 0.4  # parts of a forearm's length that are seen


def test_an_elbow_is_farther_off_the_less_sure_the_detector_and_the_more_the_forearm_points() -> None:
    """And it is seen too near to the shoulder only where the forearm points at the camera."""
    across, between, pointed = (
        [elbow_error(confidence, forearm) for confidence in (1.0, 0.99, 0.96, 0.9, 0.0)]
        for forearm in (ACROSS, 0.75, POINTED)
    )
    assert pointed == sorted(pointed)
    assert across == sorted(across)
    assert {error.short for error in across} == {0.0}
    assert (pointed[0].short, pointed[0].sigma) == (0.0, across[0].sigma)
    assert 0.04 < pointed[-1].short < 0.06
    for least, middle, most in zip(across[1:4], between[1:4], pointed[1:4], strict=True):
        assert 1.5 * least.sigma < most.sigma
        assert least.sigma < middle.sigma < most.sigma
