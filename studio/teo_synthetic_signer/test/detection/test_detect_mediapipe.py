# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import gc
import os
import threading
import weakref
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.mediapipe.mediapipe_detector import MediaPipeDetector, without_doubles
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_synthetic_signer import SyntheticFrame, render_take

HANDS = ("left_hand", "right_hand")


@pytest.fixture(scope="module")
def frames() -> list[SyntheticFrame]:
    """A man who moves his right hand at up to 2 m/s before his chest, at 1.5 m."""
    return list(render_take(script="fast", body="man_average", distance=1.5, frames=range(92, 108)))


@pytest.fixture(scope="module")
def people(frames: list[SyntheticFrame]) -> list[Person2D]:
    """What the detector sees of him, image by image."""
    detector = MediaPipeDetector()
    found = [detector.detect(frame.color, frame.stamp) for frame in frames]
    detector.close()
    assert [len(people) for people in found] == [1] * len(frames)
    return [people[0] for people in found]


@pytest.fixture(scope="module")
def hands() -> list[tuple[SyntheticFrame, Person2D]]:
    """A woman whose hands cross before her, seen at 1.5 m."""
    frames = list(render_take(script="crossing", body="woman_average", distance=1.5, frames=range(50, 62, 2)))
    detector = MediaPipeDetector()
    people = [detector.detect(frame.color, frame.stamp)[0] for frame in frames]
    detector.close()
    return list(zip(frames, people, strict=True))


@pytest.fixture
def detector() -> Iterator[MediaPipeDetector]:
    detector = MediaPipeDetector()
    yield detector
    detector.close()


def off(frame: SyntheticFrame, seen: FloatArray, truth: FloatArray) -> FloatArray:
    """How far keypoints are from the projections of the joints, brought to the joints' distance [m]."""
    pixels = np.linalg.norm(seen[:, :2] - frame.camera.project(truth), axis=1)
    metres: FloatArray = pixels * truth[:, 2] / frame.camera.fx
    return metres


def test_joints_and_face_are_where_they_are_and_what_is_not_seen_is_not_trusted(
    frames: list[SyntheticFrame], people: list[Person2D]
) -> None:
    joints = [BODY_25.index[side + joint] for side in "LR" for joint in ("Shoulder", "Elbow", "Wrist")]
    errors = np.array(
        [off(f, p.body[joints], f.truth.body[joints]) for f, p in zip(frames, people, strict=True)]
    )
    # The network's idea of a shoulder is not the joint's centre: 2 to 4 cm aside. A swapped or a lost arm
    # would be off by decimetres.
    assert errors.mean() < 0.05
    assert errors.max() < 0.15
    assert min(person.body[joints, 2].min() for person in people) > 0.5
    faces = np.array([off(f, p.face, f.truth.face) for f, p in zip(frames, people, strict=True)])
    assert faces.mean() < 0.02
    assert min(person.face[:, 2].min() for person in people) > 0.5
    ankles = [BODY_25.index["LAnkle"], BODY_25.index["RAnkle"]]  # below the image: not trusted
    assert (frames[0].camera.project(frames[0].truth.body[ankles])[:, 1] > 480.0).all()
    assert max(person.body[ankles, 2].max() for person in people) < 0.2


@pytest.mark.parametrize("side", HANDS)
def test_hands_are_whole_and_on_their_own_side(
    side: str, hands: list[tuple[SyntheticFrame, Person2D]]
) -> None:
    errors = np.array(
        [off(frame, getattr(person, side), getattr(frame.truth, side)) for frame, person in hands]
    )
    assert errors.mean() < 0.015
    assert min(getattr(person, side)[0, 2] for _, person in hands) >= 0.5


@pytest.mark.parametrize("side", HANDS)
def test_the_hands_shape_has_the_cameras_axes_and_metres(
    side: str, hands: list[tuple[SyntheticFrame, Person2D]]
) -> None:
    """Moved to the place of the true hand, it lies on it as well as a network can imagine it."""
    errors, mirrored = [], []
    for frame, person in hands:
        shape, truth = getattr(person, f"{side}_world"), getattr(frame.truth, side)
        for sign, list_of in ((1.0, errors), (-1.0, mirrored)):
            moved = (shape - shape.mean(axis=0)) * [1.0, 1.0, sign] + truth.mean(axis=0)
            list_of.append(np.linalg.norm(moved - truth, axis=1).mean())
    assert np.mean(errors) < 0.025
    assert np.mean(errors) < np.mean(mirrored)


def test_the_small_network_finds_the_hands_nearly_as_well(
    hands: list[tuple[SyntheticFrame, Person2D]],
) -> None:
    detector = MediaPipeDetector(hands="lite")
    errors, differences = [], []
    for frame, full in hands:
        person = detector.detect(frame.color, frame.stamp)[0]
        errors.append(off(frame, person.left_hand, frame.truth.left_hand))
        differences.append(np.abs(person.left_hand - full.left_hand).max())
    detector.close()
    assert np.mean(errors) < 0.02
    assert min(differences) > 0.0  # it is another network
    with pytest.raises(RetrieverError, match="full"):
        MediaPipeDetector(hands="tiny")


def test_one_hand_taken_for_both_is_the_hand_of_the_nearer_arm() -> None:
    body = np.zeros((25, 3))
    body[BODY_25.index["LWrist"]] = 100.0, 200.0, 0.9
    body[BODY_25.index["RWrist"]] = 130.0, 200.0, 0.9
    hand = np.column_stack([np.random.default_rng(0).normal(0.0, 20.0, (21, 2)), np.full(21, 0.9)])
    hand[0, :2] = 0.0
    at_right = hand + np.array([128.0, 200.0, 0.0])
    world = np.zeros((21, 3))
    both = Person2D(
        body=body,
        left_hand=at_right + np.array([1.0, 0.0, 0.0]),
        right_hand=at_right,
        left_hand_world=world,
        right_hand_world=world,
    )
    one = without_doubles(both)
    assert len(one.left_hand) == 0
    assert one.left_hand_world is None
    assert len(one.right_hand) == 21
    touching = replace(both, left_hand=at_right - np.array([25.0, 0.0, 0.0]))
    assert without_doubles(touching) is touching
    alone = replace(both, right_hand=np.zeros((0, 3)))
    assert without_doubles(alone) is alone


def test_a_fast_hand_is_not_trailed(frames: list[SyntheticFrame], people: list[Person2D]) -> None:
    wrist = BODY_25.index["RWrist"]
    true = np.array([f.camera.project(f.truth.body[wrist : wrist + 1])[0] for f in frames])
    seen = np.array([p.body[wrist, :2] for p in people])
    at = np.arange(len(frames), dtype=np.float64)
    assert np.abs(np.diff(true, axis=0)).max() > 10.0  # [px] from image to image: fast enough to tell

    def scatter(lag: float) -> float:
        inside = slice(3, -3)
        past = np.column_stack([np.interp(at - lag, at, axis) for axis in true.T])
        return float(np.std((seen - past)[inside], axis=0).sum())

    lags = np.arange(-2.0, 2.01, 0.1)  # [frames]
    assert abs(lags[np.argmin([scatter(lag) for lag in lags])]) < 0.35


def test_each_of_two_images_at_once_gets_its_own_answer(
    frames: list[SyntheticFrame], detector: MediaPipeDetector
) -> None:
    shown = [frames[0].color, np.zeros_like(frames[0].color), frames[0].color[::2, ::2]]
    alone = [detector.detect(image, 0.0) for image in shown]
    assert [len(people) for people in alone] == [1, 0, 1]
    with ThreadPoolExecutor(2) as threads:
        together = list(threads.map(lambda i: detector.detect(shown[i % 3], 0.0), range(9)))
    for i, people in enumerate(together):
        assert len(people) == len(alone[i % 3])
        for one, other in zip(people, alone[i % 3], strict=True):
            np.testing.assert_allclose(one.body[:8, :2], other.body[:8, :2], atol=12.0)


def test_an_empty_image_of_any_size_has_nobody(detector: MediaPipeDetector) -> None:
    for shape in ((480, 640), (720, 1280), (1, 1), (3, 2), (40, 2000)):
        assert detector.detect(np.full((*shape, 3), 90, np.uint8), 0.0) == ()


def test_the_person_is_found_again_after_leaving_and_in_another_resolution(
    frames: list[SyntheticFrame], detector: MediaPipeDetector
) -> None:
    image = frames[0].color
    whole = detector.detect(image, 0.0)[0]
    assert detector.detect(np.zeros_like(image), 1.0) == ()
    again = detector.detect(image, 0.5)[0]  # stamps may go back
    np.testing.assert_allclose(again.body[:8], whole.body[:8], atol=6.0)
    half = detector.detect(image[::2, ::2], 2.0)[0]
    np.testing.assert_allclose(2.0 * half.body[:8, :2], whole.body[:8, :2], atol=12.0)


def test_it_says_nothing_on_standard_error(
    frames: list[SyntheticFrame], capfd: pytest.CaptureFixture[str]
) -> None:
    detector = MediaPipeDetector()
    for frame in frames[:2]:
        detector.detect(frame.color, frame.stamp)
    detector.close()
    assert capfd.readouterr().err == ""


def test_a_graph_that_failed_fails_one_image_only(
    frames: list[SyntheticFrame], detector: MediaPipeDetector
) -> None:
    assert detector._follower is not None
    for graph in (*detector._follower._followed, *detector._follower._spare):
        graph._graph.close()
    with refused("failed"):
        detector.detect(frames[0].color, 0.0)
    assert len(detector.detect(frames[0].color, 0.1)) == 1


def test_closing_waits_for_the_image_at_hand_and_refuses_the_next(frames: list[SyntheticFrame]) -> None:
    detector = MediaPipeDetector()
    begun = threading.Event()
    found = []

    def work() -> None:
        while True:
            found.append(detector.detect(frames[0].color, 0.0))
            begun.set()

    with ThreadPoolExecutor(1) as thread:
        running = thread.submit(work)
        assert begun.wait(60.0)
        detector.close()
        error = running.exception(timeout=60.0)
    assert isinstance(error, RetrieverError)
    assert error.code == "closed"
    assert {len(people) for people in found} == {1}


def test_a_closed_detector_frees_its_networks() -> None:
    detector = MediaPipeDetector()
    graph = weakref.ref(detector._follower)
    detector.close()
    gc.collect()
    assert graph() is None
    before = resident()
    for _ in range(3):
        MediaPipeDetector().close()
    assert resident() - before < 125.0  # [MB]; each holds more than 50, and what was freed may stay in use


def resident() -> float:
    """Memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6
