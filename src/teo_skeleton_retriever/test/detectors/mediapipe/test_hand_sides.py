# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticLandmarks
from teo_skeleton_retriever.detectors.mediapipe.mediapipe_detector import own_hands

HAND = np.zeros((21, 3))


def landmarks(left: float | None, right: float | None) -> HolisticLandmarks:
    return HolisticLandmarks(
        pose=np.zeros((33, 5)),
        left_hand=None if left is None else HAND,
        right_hand=None if right is None else HAND,
        face=None,
        left_hand_world=None,
        right_hand_world=None,
        left_hand_score=0.9,
        right_hand_score=0.9,
        face_score=0.0,
        left_hand_side=left or 0.0,
        right_hand_side=right or 0.0,
    )


@pytest.mark.parametrize(
    ("left", "right", "own"),
    [
        (0.98, 0.97, (True, True)),
        (0.05, 0.97, (False, True)),
        (0.9, 0.2, (True, False)),
        (None, 0.9, (False, True)),
        (None, None, (False, False)),
    ],
)
def test_a_hand_that_looks_like_the_other_one_is_not_the_persons(
    left: float | None, right: float | None, own: tuple[bool, bool]
) -> None:
    assert own_hands(landmarks(left, right)) == own


def test_a_single_hand_is_kept_whatever_it_looks_like() -> None:
    assert own_hands(landmarks(0.1, None)) == (True, False)
