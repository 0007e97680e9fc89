# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import resource
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from capsule_person import CAMERA, ROW, Pose, face, frame, person_2d, pose
from refusals import refused

from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.retriever import (
    DetectionFrame,
    KeypointStatus,
    Retriever,
    RetrieverParameters,
    Skeleton,
)

RATE = 30.0  # [1/s]
ARMS = [ROW[side + joint] for side in "RL" for joint in ("Shoulder", "Elbow", "Wrist")]
AT_ONCE = RetrieverParameters(newcomer_images=1)


def signing(time: float, at: tuple[float, float, float] = (0.0, -0.25, 1.6)) -> Pose:
    """Both hands move before the chest."""
    right = (-0.15 + 0.12 * math.sin(4 * time), 0.12 + 0.12 * math.cos(4 * time), -0.28)
    left = (0.25, 0.05 + 0.12 * math.sin(5 * time), -0.25)
    return pose(right, left, at=at)


def follow(
    retriever: Retriever, seconds: float, make: Callable[[float], DetectionFrame], start: float = 0.0
) -> list[tuple[Skeleton, ...]]:
    return [retriever.process(make(start + i / RATE)) for i in range(round(seconds * RATE))]


def only(skeletons: tuple[Skeleton, ...]) -> Skeleton:
    assert len(skeletons) == 1
    return skeletons[0]


def error(found: np.ndarray, truth: np.ndarray) -> float:
    return float(np.linalg.norm(found - truth, axis=1).mean())


def test_joints_are_found_behind_the_skin_that_the_camera_sees() -> None:
    # Of a detector that sees joints where they are, not beside them as MediaPipe does.
    retriever = Retriever(replace(AT_ONCE, detector="other"))
    errors, hands = [], []
    images = follow(retriever, 1.5, lambda t: frame(t, signing(t), noise=0.004, jitter=0.35))
    for i, found in enumerate(images):
        truth, skeleton = signing(i / RATE), only(found)
        errors.append(error(skeleton.body.points[ARMS], truth.body[ARMS]))
        hands.append(error(skeleton.left_hand.points, truth.left_hand))
        hands.append(error(skeleton.right_hand.points, truth.right_hand))
    assert np.mean(errors[15:]) < 0.012
    assert np.mean(hands[30:]) < 0.015


@pytest.mark.parametrize(("missing", "imagined"), [(0.66, True), (0.0, False)])
def test_two_thirds_of_the_depth_may_be_missing_or_the_shape_of_the_hands(
    missing: float, imagined: bool
) -> None:
    retriever = Retriever(AT_ONCE)
    scene = {"noise": 0.004, "missing": missing, "imagined": imagined}
    found = follow(retriever, 0.7, lambda t: frame(t, signing(t), **scene))
    skeleton, truth = only(found[-1]), signing(20 / RATE)
    assert error(skeleton.body.points[ARMS], truth.body[ARMS]) < 0.03
    assert error(skeleton.right_hand.points, truth.right_hand) < 0.02


@pytest.mark.slow
def test_sigma_tells_how_far_joints_are_off() -> None:
    ratios = []
    for seed in range(6):
        at = (0.3 * math.sin(seed), -0.25, 1.3 + 0.15 * seed)
        retriever = Retriever(AT_ONCE)
        for i in range(20):
            time = i / RATE + seed
            truth = signing(time, at)
            skeleton = only(retriever.process(frame(time, truth, noise=0.002 * at[2] ** 2, jitter=1.0)))
            off = skeleton.body.points[ARMS] - truth.body[ARMS]
            ratios.append(off / skeleton.body.sigma[ARMS])
    spread = float(np.sqrt(np.mean(np.array(ratios) ** 2)))
    assert 0.3 < spread < 1.5


def test_a_hand_that_the_detector_hardly_believes_in_is_less_certain_sideways() -> None:
    def doubtful(time: float) -> DetectionFrame:
        shown = frame(time, signing(time), noise=0.003)
        hand = shown.people[0].right_hand.copy()
        hand[:, 2] = 0.6
        return replace(shown, people=(replace(shown.people[0], right_hand=hand),))

    sure = only(follow(Retriever(AT_ONCE), 0.3, lambda t: frame(t, signing(t), noise=0.003))[-1])
    unsure = only(follow(Retriever(AT_ONCE), 0.3, doubtful)[-1])
    assert (unsure.right_hand.sigma[:, 0] > 1.3 * sure.right_hand.sigma[:, 0]).all()
    np.testing.assert_allclose(unsure.left_hand.sigma, sure.left_hand.sigma)


def test_an_elbow_behind_the_hand_is_found_by_the_lengths_of_the_arm() -> None:
    retriever = Retriever(AT_ONCE)

    def moving(time: float) -> Pose:
        swing = min(time / 1.5, 1.0)
        return pose((-0.55 + 0.2 * swing, 0.12 + 0.12 * swing, -0.05 - 0.2 * swing), (0.4, 0.35, -0.1))

    last = follow(retriever, 2.0, lambda t: frame(t, moving(t), noise=0.002))[-1]
    off = only(last).body.points[ROW["RElbow"]] - moving(2.0).body[ROW["RElbow"]]
    assert float(np.linalg.norm(off)) < 0.05


def without_left_hand(image: DetectionFrame) -> DetectionFrame:
    person = replace(image.people[0], left_hand=np.zeros((0, 3)), left_hand_world=None)
    return replace(image, people=(person,))


def test_what_is_not_seen_is_held_for_a_while_with_growing_doubt_and_then_lost() -> None:
    retriever = Retriever(AT_ONCE)
    follow(retriever, 0.5, lambda t: frame(t, signing(t)))
    without_hands = [frame(0.5 + i / RATE, signing(0.5)) for i in range(12)]
    seen = [only(retriever.process(without_left_hand(image))).left_hand for image in without_hands]
    assert (seen[0].status == KeypointStatus.HELD).all()
    assert (seen[1].sigma > seen[0].sigma).all()
    assert (seen[-1].status == KeypointStatus.LOST).all()
    assert np.isnan(seen[-1].points).all()


def test_a_held_hand_goes_where_its_wrist_goes() -> None:
    retriever = Retriever(replace(AT_ONCE, max_sigma=0.2))
    still, moved = pose((-0.2, 0.1, -0.25), (0.25, 0.1, -0.25)), pose((-0.2, 0.1, -0.25), (0.25, 0.0, -0.25))
    follow(retriever, 0.4, lambda t: frame(t, still))
    for i in range(5):
        skeleton = only(retriever.process(without_left_hand(frame(0.4 + i / RATE, moved))))
    step = skeleton.left_hand.points.mean(axis=0) - still.left_hand.mean(axis=0)
    assert step[1] == pytest.approx(-0.1, abs=0.03)


@pytest.mark.parametrize("value", [0.0, math.nan, -1.0])
def test_without_depth_nothing_is_invented_and_it_recovers(value: float) -> None:
    retriever = Retriever(AT_ONCE)
    follow(retriever, 0.3, lambda t: frame(t, signing(t)))
    image = frame(0.3, signing(0.3))
    blind = replace(image, depth=np.full_like(image.depth, value))
    for i in range(40):
        found = retriever.process(replace(blind, stamp=0.3 + i / RATE))
    assert not any((skeleton.body.status == KeypointStatus.MEASURED).any() for skeleton in found)
    last = follow(retriever, 0.5, lambda t: frame(t, signing(t)), start=2.0)[-1]
    assert error(only(last).body.points[ARMS], signing(2.0 + 14 / RATE).body[ARMS]) < 0.025


def test_half_a_person_is_seen_as_far_as_they_are_in_the_image() -> None:
    found = follow(Retriever(AT_ONCE), 0.2, lambda t: frame(t, signing(t, at=(-0.85, -0.25, 1.6))))
    body = only(found[-1]).body
    assert body.status[ROW["LShoulder"]] == KeypointStatus.MEASURED
    assert body.status[ROW["RWrist"]] == KeypointStatus.LOST
    assert np.isnan(body.points[ROW["RWrist"]]).all()


def test_shoulders_that_hands_hide_from_the_first_image_on_are_not_put_before_the_head() -> None:
    image, truth = frame(0.0, signing(0.0)), signing(0.0)
    rows = [ROW[name] for name in ("RShoulder", "LShoulder", "Neck")]
    depth = image.depth.copy()
    for column, row in np.rint(CAMERA.project(truth.body[rows])).astype(int):
        depth[row - 25 : row + 25, column - 25 : column + 25] = truth.body[ROW["Neck"], 2] - 0.4
    found = only(Retriever(AT_ONCE).process(replace(image, depth=depth))).body
    assert np.abs(found.points[rows, 2] - truth.body[rows, 2]).max() < 0.1
    assert (found.status[rows] == KeypointStatus.OPTIMISED).all()


def test_a_hand_whose_pixels_see_the_wall_alone_is_not_put_there() -> None:
    image, truth = frame(0.0, signing(0.0)), signing(0.0)
    depth = image.depth.copy()
    for column, row in np.rint(CAMERA.project(truth.right_hand)).astype(int):
        depth[row - 12 : row + 12, column - 12 : column + 12] = 3.5
    found = only(Retriever(AT_ONCE).process(replace(image, depth=depth))).right_hand.points
    assert not (np.linalg.norm(found - truth.right_hand, axis=1) > 0.5).any()


def test_who_walks_by_behind_the_signer_is_the_same_person_afterwards() -> None:
    """Half hidden, some of their keypoints have the depth of who hides them."""
    retriever, seen = Retriever(AT_ONCE), []
    for i in range(45):
        time = i / RATE
        near = frame(time, signing(time))
        x = -0.8 + 1.6 * i / 44
        far = frame(time, signing(time, at=(x, -0.25, 2.5)))
        depth = np.fmin(near.depth, far.depth)
        hidden = abs(x) < 0.2
        people = near.people if hidden else (*near.people, *far.people)
        found = retriever.process(replace(near, depth=depth, people=people))
        seen.append(tuple(skeleton.track_id for skeleton in found))
    assert seen[0] == seen[-1] == (0, 1)


def test_ten_people_keep_their_ids() -> None:
    places = [(x, -0.2, z) for z in (2.2, 3.4) for x in (-0.9, -0.45, 0.0, 0.45, 0.9)]

    def make(time: float) -> DetectionFrame:
        people = [pose((-0.2, 0.3, -0.15), (0.2, 0.3, -0.15), at=at) for at in places]
        image = frame(time, *people)
        return replace(image, people=image.people[:: 1 if int(time * RATE) % 2 else -1])

    retriever = Retriever(RetrieverParameters(max_depth=6.0))
    found = follow(retriever, 0.27, make)
    ids = [tuple(skeleton.track_id for skeleton in skeletons) for skeletons in found[3:]]
    assert ids == [tuple(range(10))] * len(ids)
    nearest = min(found[-1], key=lambda skeleton: float(np.linalg.norm(skeleton.body.points[1])))
    assert [skeleton.track_id for skeleton in found[-1] if skeleton.is_signer] == [nearest.track_id]


LARGER = CameraModel(width=400, height=300, fx=375.0, fy=375.0, cx=199.5, cy=149.5)
BENT = replace(CAMERA, distortion_model="plumb_bob", distortion=np.array([0.1, -0.05, 0.001, 0.001, 0.0]))


@pytest.mark.parametrize(
    ("begins", "camera", "track"),
    [(100.0, CAMERA, 1), (-0.3, LARGER, 0), (-0.3, BENT, 0)],
    ids=["time that runs backwards", "another resolution", "a lens that bends rays"],
)
def test_in_mid_stream_time_begins_anew_with_new_ids_and_the_camera_changes_with_none(
    begins: float, camera: CameraModel, track: int
) -> None:
    retriever = Retriever(AT_ONCE)
    follow(retriever, 0.3, lambda t: frame(t, signing(t)), start=begins)
    found = only(follow(retriever, 0.4, lambda t: frame(t, signing(t), camera=camera))[-1])
    assert found.track_id == track
    truth = signing(11 / RATE)
    assert error(found.body.points[ARMS], truth.body[ARMS]) < 0.025
    assert error(found.face.points, face(truth)) < 0.012
    assert found.body_frame is not None
    np.testing.assert_allclose(found.body_frame.rotation @ [1, 0, 0], [0, 0, -1], atol=0.2)
    np.testing.assert_allclose(found.body_frame.rotation @ [0, 1, 0], [1, 0, 0], atol=0.1)


def test_a_locked_signer_stays_when_somebody_nearer_comes() -> None:
    retriever = Retriever(AT_ONCE)
    far, near = signing(0.0, at=(-0.4, -0.25, 2.2)), signing(0.0, at=(0.4, -0.25, 1.4))
    first = only(retriever.process(frame(0.0, far)))
    retriever.lock_signer(first.track_id)
    found = retriever.process(frame(0.1, far, near))
    assert [skeleton.track_id for skeleton in found if skeleton.is_signer] == [first.track_id]
    assert retriever.process(replace(frame(5.0, near), people=(person_2d(near),)))[0].is_signer is False
    retriever.lock_signer(None)
    assert retriever.process(frame(9.0, near))[0].is_signer is True


@pytest.mark.parametrize("points", [18, 15], ids=["COCO", "MPI"])
def test_every_layout_of_bodies_is_taken(points: int) -> None:
    body = np.zeros((points, 3))
    body[:8] = person_2d(signing(0.0)).body[:8]
    image = replace(frame(0.0, signing(0.0)), people=(Person2D(body=body),))
    skeleton = only(Retriever(AT_ONCE).process(image))
    status = dict(zip(ARMS, skeleton.body.status[ARMS].tolist(), strict=True))
    # The right forearm points at the camera, 12 cm before its own elbow.
    assert status.pop(ROW["RElbow"]) == KeypointStatus.HELD
    assert set(status.values()) == {KeypointStatus.MEASURED}
    # MPI's first keypoint is the top of the head, which is no nose.
    assert (skeleton.body.confidence[ROW["Nose"]] > 0.0) == (points == 18)


@pytest.mark.slow
def test_memory_is_bounded_over_thousands_of_images() -> None:
    retriever = Retriever(replace(AT_ONCE, optimise_limbs=False))
    image = frame(0.0, signing(0.0))
    seen = (Person2D(body=image.people[0].body),)

    def play(start: int, end: int) -> int:
        for i in range(start, end):
            # They leave for longer than they are remembered, and come back as somebody else.
            gone = i % 200 > 150
            retriever.process(replace(image, stamp=i / 10.0, people=() if gone else seen))
        return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()

    before = play(0, 800)
    assert play(800, 2000) - before < 300_000  # [bytes]: a skeleton kept for each image would be 12 MB


def test_nobody_is_somebody_of_whom_nothing_is_seen_or_who_is_seen_in_one_image_alone() -> None:
    image = frame(0.0, signing(0.0))
    assert follow(Retriever(), 0.3, lambda t: frame(t)) == [()] * 9
    assert Retriever(AT_ONCE).process(replace(image, people=(Person2D(),))) == ()
    assert Retriever().process(image) == ()
    assert len(Retriever(AT_ONCE).process(image)) == 1


@pytest.mark.parametrize(
    ("stamp", "size", "code"),
    [(math.nan, (240, 320), "bad_stamp"), (math.inf, (240, 320), "bad_stamp"), (0.0, (10, 10), "wrong_size")],
)
def test_what_is_no_image_of_a_time_is_refused(stamp: float, size: tuple[int, int], code: str) -> None:
    with refused(code):
        DetectionFrame(stamp, (), np.zeros(size, np.float32), CAMERA)


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"min_confidence": 1.5}, "out_of_range"),
        ({"hold_time": math.nan}, "out_of_range"),
        ({"max_depth": "far"}, "wrong_type"),
        ({"skin_offset": 1}, "wrong_type"),
        ({"smoothing": True}, "wrong_type"),
        ({"signer_rule": "loudest"}, "unknown_choice"),
        ({"min_depth": 3.0, "max_depth": 2.0}, "bad_range"),
    ],
)
def test_what_is_no_value_of_a_parameter_is_refused(changes: dict[str, object], code: str) -> None:
    with refused(code):
        RetrieverParameters(**changes)  # type: ignore[arg-type]
