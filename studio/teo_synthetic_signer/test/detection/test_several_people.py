# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from teo_skeleton_retriever.detectors.detector import DetectionFrame
from teo_skeleton_retriever.detectors.mediapipe.mediapipe_detector import MediaPipeDetector
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.retriever import Retriever, RetrieverParameters
from teo_synthetic_signer import Companion, SyntheticFrame, Truth, render_take

NECK = BODY_25.index["Neck"]


@pytest.fixture(scope="module")
def frames() -> list[SyntheticFrame]:
    """A woman at 1.8 m and, half a metre behind and beside her, a tall man, the larger of the two."""
    beside = Companion(body="man_tall", script="signing", behind=0.5, aside=0.7)
    return list(
        render_take(
            script="two_hands", body="woman_small", distance=1.8, companions=(beside,), frames=range(30, 34)
        )
    )


@pytest.fixture
def detector() -> Iterator[MediaPipeDetector]:
    detector = MediaPipeDetector()
    yield detector
    detector.close()


def owner(frame: SyntheticFrame, person: Person2D) -> Truth:
    """Whose keypoints these are."""
    people = (frame.truth, *frame.others)
    off = [np.linalg.norm(frame.camera.project(t.body)[NECK] - person.body[NECK, :2]) for t in people]
    assert min(off) < 40.0  # [px]
    return people[int(np.argmin(off))]


def test_each_of_two_people_is_followed_with_their_own_hands(
    frames: list[SyntheticFrame], detector: MediaPipeDetector
) -> None:
    for frame in frames:
        people = detector.detect(frame.color, frame.stamp)
        assert {id(owner(frame, person)) for person in people} == {id(frame.truth), id(frame.others[0])}
        for person in people:
            truth = owner(frame, person)
            for hand, points in ((person.left_hand, truth.left_hand), (person.right_hand, truth.right_hand)):
                if len(hand):
                    off = np.linalg.norm(hand[:, :2] - frame.camera.project(points), axis=1)
                    assert np.median(off) < 15.0  # [px]


def test_the_nearest_of_two_people_signs_though_the_other_is_larger(
    frames: list[SyntheticFrame], detector: MediaPipeDetector
) -> None:
    retriever = Retriever(RetrieverParameters(newcomer_images=1))
    for frame in frames:
        people = detector.detect(frame.color, frame.stamp)
        found = retriever.process(DetectionFrame(frame.stamp, people, frame.depth, frame.camera))
        assert len(found) == 2
        (signer,) = (skeleton for skeleton in found if skeleton.is_signer)
        assert np.linalg.norm(signer.body.points[NECK] - frame.truth.body[NECK]) < 0.15  # [m]


def test_a_newcomer_is_found_while_another_is_followed(
    frames: list[SyntheticFrame], detector: MediaPipeDetector
) -> None:
    alone = frames[0].color.copy()
    alone[:, 400:] = 128  # where he stands
    seen = [len(detector.detect(alone, i / 30.0)) for i in range(3)]
    later = [len(detector.detect(frames[0].color, i / 30.0)) for i in range(3, 20)]
    assert (seen, later[-1]) == ([1] * 3, 2)
    assert [len(detector.detect(alone, 1.0 + i / 30.0)) for i in range(3)][-1] == 1


def test_no_more_people_are_followed_than_asked_for(frames: list[SyntheticFrame]) -> None:
    detector = MediaPipeDetector(people=1)
    assert [len(detector.detect(frame.color, frame.stamp)) for frame in frames] == [1] * len(frames)
    detector.close()
