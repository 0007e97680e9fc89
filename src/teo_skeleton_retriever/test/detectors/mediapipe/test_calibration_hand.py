# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
from capsule_person import pose

from teo_skeleton_retriever.detectors.mediapipe.calibration import corrected_hand

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


def test_a_palm_without_extent_makes_no_frame_and_stays() -> None:
    point = np.tile([0.1, 0.2, 1.5], (21, 1))
    np.testing.assert_array_equal(corrected_hand(point, left=False), point)
