# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_skeleton_retriever.detectors.mediapipe.mediapipe_detector import (
    BODY_25_FROM_POSE,
    FACE_70_FROM_MESH,
    person_from_holistic,
)
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, FACE_PARTS
from teo_skeleton_retriever.layouts.person_2d import body_25_from_coco_18

# MediaPipe's pose landmarks: odd is left from the ears on.
LEFT_OF_POSE = {2, 7, *range(11, 33, 2)}


def pose() -> np.ndarray:
    """Landmarks whose place tells which they are: x = i / 100, y = i / 50, visibility = 1 - i / 100."""
    i = np.arange(33.0)
    return np.column_stack([i / 100, i / 50, 1 - i / 100])


def row(person_body: np.ndarray, name: str) -> list[float]:
    return person_body[BODY_25.index[name]].tolist()


def test_left_comes_from_left_and_right_from_right() -> None:
    for name, landmark in BODY_25_FROM_POSE.items():
        if name != "Nose":
            assert name.startswith("L") == (landmark in LEFT_OF_POSE), name


def test_landmarks_become_pixels_with_their_visibility() -> None:
    body = person_from_holistic(width=200, height=100, pose=pose()).body
    assert row(body, "RWrist") == pytest.approx([0.16 * 200, 0.32 * 100, 0.84])


def test_neck_is_between_the_shoulders_with_the_lower_confidence() -> None:
    body = person_from_holistic(width=100, height=100, pose=pose()).body
    assert row(body, "Neck") == pytest.approx([11.5, 23.0, 0.88])
    assert row(body, "MidHip") == pytest.approx([23.5, 47.0, 0.76])


def test_small_toes_and_parts_not_seen_are_absent() -> None:
    person = person_from_holistic(width=100, height=100, pose=pose())
    assert row(person.body, "LSmallToe") == row(person.body, "RSmallToe") == [0.0, 0.0, 0.0]
    assert len(person.left_hand) == len(person.right_hand) == len(person.face) == 0


def test_nobody_gives_a_person_without_parts() -> None:
    assert len(person_from_holistic(width=100, height=100).body) == 0


def test_hands_keep_their_order_and_side() -> None:
    left = np.full((21, 2), 0.25)
    left[8] = (0.5, 0.5)
    person = person_from_holistic(width=100, height=10, left_hand=left, left_hand_confidence=0.9)
    assert person.left_hand[8].tolist() == [50.0, 5.0, 0.9]
    assert len(person.right_hand) == 0


def test_every_face_part_has_its_number_of_different_landmarks() -> None:
    assert {part: len(found) for part, found in FACE_70_FROM_MESH.items()} == {
        part: len(indices) for part, indices in FACE_PARTS.items()
    }
    chosen = [i for part in FACE_70_FROM_MESH.values() for i in part]
    assert len(set(chosen)) == 70


def test_pupils_need_the_irises() -> None:
    without = person_from_holistic(width=10, height=10, face=np.full((468, 2), 0.5)).face
    assert without[67].tolist() == [5.0, 5.0, 1.0]
    assert without[68:].tolist() == [[0.0, 0.0, 0.0]] * 2
    with_them = person_from_holistic(width=10, height=10, face=np.full((478, 2), 0.5)).face
    assert with_them[68:, 2].tolist() == [1.0, 1.0]


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"pose": np.zeros((32, 3))}, "wrong_shape"),
        ({"left_hand": np.zeros((21, 3))}, "wrong_shape"),
        ({"face": np.zeros((100, 2))}, "wrong_shape"),
        ({"right_hand": np.full((21, 2), np.nan)}, "not_finite"),
        ({"pose": np.full((33, 3), 8.32)}, "bad_visibility"),
    ],
)
def test_landmarks_that_are_not_mediapipes_are_refused(change: dict[str, np.ndarray], code: str) -> None:
    with pytest.raises(RetrieverError) as caught:
        person_from_holistic(width=10, height=10, **change)
    assert caught.value.code == code


def test_coco_becomes_body_25_by_name() -> None:
    coco = np.column_stack([np.arange(18.0), np.arange(18.0) * 2, np.linspace(1, 0.5, 18)])
    body = body_25_from_coco_18(coco)
    for name in COCO_18.keypoints:
        assert row(body, name) == coco[COCO_18.index[name]].tolist()
    assert row(body, "MidHip") == pytest.approx([9.5, 19.0, coco[11, 2]])
    assert row(body, "LHeel") == [0.0, 0.0, 0.0]


def test_a_midpoint_of_an_absent_keypoint_is_absent() -> None:
    coco = np.ones((18, 3))
    coco[COCO_18.index["LHip"]] = 0.0
    assert row(body_25_from_coco_18(coco), "MidHip") == [0.0, 0.0, 0.0]
