# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest
from mediapipe.python.solutions.holistic import Holistic
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticGraph, HolisticLandmarks
from teo_skeleton_retriever.detectors.mediapipe.people_follower import PeopleFollower, PeopleGraph
from teo_synthetic_signer import render_take

Images = list[NDArray[np.uint8]]
PARTS = ("pose", "left_hand", "right_hand", "face")


@pytest.fixture(scope="module")
def images() -> Images:
    """A woman whose hands cross before her at 1.5 m."""
    frames = range(50, 58)
    return [
        f.color for f in render_take(script="crossing", body="woman_average", distance=1.5, frames=frames)
    ]


def seen_by_ours(images: Iterable[NDArray[np.uint8]]) -> list[HolisticLandmarks]:
    finder = PeopleGraph(min_detection_confidence=0.5)
    follower = PeopleFollower(
        lambda: HolisticGraph(min_tracking_confidence=0.5, lite_hands=False), finder, most=1
    )
    seen = [landmarks for image in images for landmarks in follower.follow(image)]
    follower.close()
    return seen


def seen_by_whole(images: Iterable[NDArray[np.uint8]]) -> list[dict[str, FloatArray | None]]:
    """What the graph as it is packaged finds, by MediaPipe's own way to use it."""
    with Holistic(smooth_landmarks=False, refine_face_landmarks=True) as whole:
        results = [whole.process(image) for image in images]
    return [
        {
            part: None if landmarks is None else np.array([(m.x, m.y, m.z) for m in landmarks.landmark])
            for part in PARTS
            for landmarks in [getattr(result, f"{part}_landmarks")]
        }
        for result in results
    ]


def test_it_finds_what_the_whole_graph_finds(images: Images) -> None:
    for i, (ours, whole) in enumerate(zip(seen_by_ours(images), seen_by_whole(images), strict=True)):
        for part in PARTS:
            off = (getattr(ours, part)[:, :2] - whole[part][:, :2]) * [640.0, 480.0]  # [px]
            # Ours rounds otherwise in the seventh digit, as it projects with the image's size; from image to
            # image the crops, which follow from what was found before, drift apart a little.
            assert np.abs(off).max() < (0.1 if i == 0 else 2.0)
            assert np.linalg.norm(off, axis=1).mean() < 1.0
        assert i or min(ours.left_hand_side, ours.right_hand_side) > 0.7  # told apart


@pytest.mark.parametrize("step", [30, 200])
def test_the_face_goes_along_with_a_body_that_moves_fast_or_is_suddenly_elsewhere(
    step: int, images: Images
) -> None:
    moving = [np.roll(images[0], step * max(0, i - 2), axis=1) for i in range(6 if step < 100 else 4)]
    seen = seen_by_ours(moving)
    for i, landmarks in enumerate(seen):
        assert landmarks.face is not None
        assert seen[0].face is not None
        off = (landmarks.face - seen[0].face)[:, 0].mean() * 640.0 - step * max(0, i - 2)
        assert abs(off) < 3.0  # [px]


def test_a_face_that_comes_back_is_found_again(images: Images) -> None:
    without_head = images[0].copy()
    without_head[:200] = 0
    faces = [seen.face for seen in seen_by_ours([images[0], without_head, without_head, images[0]])]
    assert [face is not None for face in faces] == [True, False, False, True]
