# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticLandmarks
from teo_skeleton_retriever.detectors.mediapipe.mediapipe_detector import (
    BODY_25_FROM_POSE,
    own_hands,
    person_from_holistic,
)
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D

# MediaPipe's pose landmarks: odd is left from the ears on.
LEFT_OF_POSE = {2, 7, *range(11, 33, 2)}
HAND = np.zeros((21, 3))


def landmarks(**seen: Any) -> HolisticLandmarks:
    """Landmarks whose place tells which they are: x = z = i / 100, y = i / 50, visibility = 1 - i / 100."""
    i = np.arange(33.0)
    parts: dict[str, Any] = dict.fromkeys(HolisticLandmarks.__dataclass_fields__)
    sure = {name: 1.0 for name in parts if name.endswith(("_score", "_side"))}
    pose = np.column_stack([i / 100, i / 50, i / 100, 1 - i / 100, np.ones(33)])
    return HolisticLandmarks(**{**parts, **sure, "pose": pose, **seen})


def person(width: int = 100, height: int = 100, **seen: Any) -> Person2D:
    return person_from_holistic(landmarks(**seen), width=width, height=height)


def row(person_body: np.ndarray, name: str) -> list[float]:
    return person_body[BODY_25.index[name]].tolist()


def test_landmarks_become_pixels_with_their_visibility_and_midpoints_have_the_lower_one() -> None:
    assert row(person(200).body, "RWrist") == pytest.approx([0.16 * 200, 0.32 * 100, 0.84])
    body = person().body
    assert row(body, "Neck") == pytest.approx([11.5, 23.0, 0.88])
    assert row(body, "MidHip") == pytest.approx([23.5, 47.0, 0.76])
    depth = person(200).body_depth
    assert depth is not None
    assert (depth / 200 * 100)[[BODY_25.index[name] for name in ("RWrist", "Neck")]] == pytest.approx(
        [16, 11.5]
    )
    assert row(body, "LSmallToe") == row(body, "RSmallToe") == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("left", "right", "own"),
    [
        (0.98, 0.97, (True, True)),
        (0.05, 0.97, (False, True)),
        (0.9, 0.2, (True, False)),
        (None, 0.9, (False, True)),
        (None, None, (False, False)),
        (0.1, None, (True, False)),  # a single hand is kept whatever it looks like
    ],
)
def test_a_hand_that_looks_like_the_other_one_is_not_the_persons(
    left: float | None, right: float | None, own: tuple[bool, bool]
) -> None:
    seen = landmarks(
        left_hand=None if left is None else HAND,
        right_hand=None if right is None else HAND,
        left_hand_side=left or 0.0,
        right_hand_side=right or 0.0,
    )
    assert own_hands(seen) == own


def test_pupils_need_the_irises() -> None:
    without, with_them = (person(10, 10, face=np.full((count, 3), 0.5)).face for count in (468, 478))
    assert without[67].tolist() == [5.0, 5.0, 1.0]
    assert without[68:].tolist() == [[0.0, 0.0, 0.0]] * 2
    assert with_them[68:, 2].tolist() == [1.0, 1.0]


def test_left_comes_from_left_and_right_from_right() -> None:
    for name, landmark in BODY_25_FROM_POSE.items():
        if name != "Nose":
            assert name.startswith("L") == (landmark in LEFT_OF_POSE), name


def test_hands_keep_their_order_and_side_and_parts_not_seen_are_absent() -> None:
    left = np.full((21, 3), 0.25)
    left[8, :2] = (0.5, 0.5)
    seen = person(height=10, left_hand=left, left_hand_score=0.9)
    assert seen.left_hand[8].tolist() == [50.0, 5.0, 0.9]
    assert len(seen.right_hand) == len(seen.face) == 0
