# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.person_layout import BODY, HANDS, LEFT_HAND, RIGHT_HAND
from teo_skeleton_retriever.lifting.clip import (
    ELBOW,
    HIP,
    SHOULDER,
    SIDES,
    WRIST,
    Points,
    PoseClip,
    smooth_depth,
)
from teo_skeleton_retriever.lifting.hand_axes import MIDDLE, palm_axes
from teo_skeleton_retriever.lifting.hands import without_flips
from teo_skeleton_retriever.lifting.lifted_person import LiftedPerson, lift_clip

BAG = Path(__file__).resolve().parents[4] / "bags" / "signer_d435"
RATE = 15.0  # [Hz] of the bag
# [pixel/m] Of a person at 1.5 m before a camera of 640 pixels.
PIXELS = 550.0
# [m] Below the shoulders; wrists under it hang.
RAISED = -0.36
# [m] Shoulders are seen so far above their joints, hips below: MediaPipe's in rendered people.
OFF_JOINTS = 0.015
KEYPOINTS = RIGHT_HAND.stop


@pytest.fixture(scope="module")
def truth() -> FloatArray:
    """Body and hands of who faces the camera: forward, left, up of the shoulders [m]. Shape (T, 67, 3)."""
    frames = []
    with AnyReader([BAG]) as reader:
        connections = [one for one in reader.connections if one.topic == "/truth/skeletons"]
        for connection, _, data in reader.messages(connections=connections):
            message: Any = reader.deserialize(data, connection.msgtype)
            (person,) = message.skeletons
            points = [
                p.position for part in ("body", "left_hand", "right_hand") for p in getattr(person, part)
            ]
            # The camera's axes are right, down and away from it.
            frames.append([(-point.z, point.x, -point.y) for point in points])
    found = np.array(frames)
    found -= found[:, list(SHOULDER.values())].mean(axis=1, keepdims=True)
    return found


def picture(
    truth: FloatArray,
    *,
    distance: float = math.inf,
    depth: bool = True,
    noise: float = 1.5,
    pixels: float = PIXELS,
) -> PoseClip:
    """What a detector of points sees of a person.

    Args:
        truth: The person.
        distance: Of the camera [m].
        depth: Whether it guesses depths of a hand's points: to 6 mm, four fifths of it, in an own unit.
        noise: Deviation of a point [pixel].
        pixels: Of a metre at the shoulders.
    """
    random = np.random.default_rng(0)
    body = truth[:, BODY].copy()
    body[:, list(SHOULDER.values()), 2] += OFF_JOINTS
    body[:, list(HIP.values()), 2] -= OFF_JOINTS

    def part(true: FloatArray, *, guessed: bool) -> Points:
        size = pixels / (1.0 - true[..., 0] / distance)
        places = true * size[..., None] + random.normal(0.0, noise, true.shape)
        places[..., 0] = np.nan
        if guessed:
            along = (true - true[:, :1])[..., 0]
            places[..., 0] = (0.8 * along + random.normal(0.0, 0.006, along.shape)) / 5.0
        return Points(places=places, confidence=np.ones(true.shape[:2]))

    return PoseClip(
        rate=RATE,
        body=part(body, guessed=False),
        left_hand=part(truth[:, LEFT_HAND], guessed=depth),
        right_hand=part(truth[:, RIGHT_HAND], guessed=depth),
        source="made of the truth",
    )


@pytest.fixture(scope="module")
def lifted(truth: FloatArray) -> LiftedPerson:
    return lift_clip(picture(truth))


@pytest.fixture(scope="module")
def from_near(truth: FloatArray) -> LiftedPerson:
    return lift_clip(picture(truth, distance=2.0))


def raised(truth: FloatArray, side: str) -> FloatArray:
    return truth[:, WRIST[side], 2] > RAISED


def distances(truth: FloatArray, person: LiftedPerson, points: dict[str, int]) -> FloatArray:
    """Of a point of both sides from where it is, while the hand is raised [m]."""
    away = [(person.positions[:, row] - truth[:, row])[raised(truth, side)] for side, row in points.items()]
    return np.linalg.norm(np.concatenate(away), axis=1)


def hand_errors(truth: FloatArray, person: LiftedPerson) -> tuple[FloatArray, FloatArray]:
    """Mean distance of the points from the wrist [m], and angle between the palms' normals [deg]."""
    away, angles = [], []
    for side, mirror in (("right", 1.0), ("left", -1.0)):
        rows = HANDS[side[0].upper()]
        true, found = (
            points[raised(truth, side), rows] * [1.0, mirror, 1.0] for points in (truth, person.positions)
        )
        away.append(np.linalg.norm((found - found[:, :1]) - (true - true[:, :1]), axis=2).mean(axis=1))
        cosine = (palm_axes(true)[..., 2] * palm_axes(found)[..., 2]).sum(axis=1)
        angles.append(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
    return np.concatenate(away), np.concatenate(angles)


def test_arms_come_back_to_a_few_centimetres(
    truth: FloatArray, lifted: LiftedPerson, from_near: LiftedPerson
) -> None:
    for person, points, median, most in (
        (lifted, ELBOW, 0.050, 0.08),
        (lifted, WRIST, 0.040, 0.06),
        (from_near, ELBOW, 0.065, 0.09),
        (from_near, WRIST, 0.050, 0.08),
    ):
        away = distances(truth, person, points)
        assert np.median(away) < median
        assert np.percentile(away, 90.0) < most


def turned(points: FloatArray, angle: float) -> FloatArray:
    """A person turned to their own right [rad]."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return points @ np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def with_imagined_depths(clip: PoseClip, truth: FloatArray) -> PoseClip:
    """Depths of the body as MediaPipe imagines them: 2.6 times too large, arms off by 7 cm for a second."""
    random = np.random.default_rng(1)
    places = clip.body.places.copy()
    off = random.normal(0.0, 0.07, (len(truth) // 15 + 1, places.shape[1])).repeat(15, axis=0)[: len(truth)]
    off[:, list(SHOULDER.values())] = random.normal(0.0, 0.01, (len(truth), 2))
    places[..., 0] = (truth[:, BODY, 0] + off) / 0.38 * PIXELS
    return replace(clip, body=replace(clip.body, places=places))


@pytest.mark.parametrize("degrees", [-40.0, 25.0])
def test_a_signer_who_stands_turned_is_lifted_as_one_who_faces_the_camera(
    truth: FloatArray, degrees: float
) -> None:
    angle = math.radians(degrees)
    shown = turned(truth, angle)
    clip = picture(shown)
    flat, found = lift_clip(clip), lift_clip(with_imagined_depths(clip, shown))
    # Told by the detector, the hands are before the trunk where they were.
    straight = found._replace(positions=turned(found.positions, -angle))
    away = distances(truth, straight, WRIST)
    assert np.median(away) < 0.08
    assert np.median(away) < 0.6 * np.median(distances(truth, flat, WRIST))
    shoulders = found.positions[:, SHOULDER["left"]] - found.positions[:, SHOULDER["right"]]
    assert np.degrees(np.arctan2(shoulders[:, 0], shoulders[:, 1])).mean() == pytest.approx(degrees, abs=6.0)


def test_imagined_depths_of_who_faces_the_camera_do_no_harm(truth: FloatArray, lifted: LiftedPerson) -> None:
    found = lift_clip(with_imagined_depths(picture(truth), truth))
    for points in (WRIST, ELBOW):
        assert np.median(distances(truth, found, points)) < np.median(distances(truth, lifted, points)) + 0.01


def test_shoulders_whose_depths_are_known_in_one_frame_of_two_are_lifted(truth: FloatArray) -> None:
    clip = with_imagined_depths(picture(truth), truth)
    places = clip.body.places.copy()
    places[11, list(SHOULDER.values()), 0] = np.nan
    clip = replace(clip, body=replace(clip.body, places=places))
    found = lift_clip(
        clip.with_parts(lambda part, _: Points(places=part.places[10:12], confidence=part.confidence[10:12]))
    )
    assert np.isfinite(found.positions[:, [*SHOULDER.values(), *WRIST.values()]]).all()


def test_hands_keep_their_shape_and_the_way_the_palm_faces(truth: FloatArray, lifted: LiftedPerson) -> None:
    away, angle = hand_errors(truth, lifted)
    assert np.median(away) < 0.018
    assert np.median(angle) < 10.0
    assert np.percentile(angle, 90.0) < 25.0


def test_without_a_guess_of_depth_most_palms_still_face_the_right_way(truth: FloatArray) -> None:
    away, angle = hand_errors(truth, lift_clip(picture(truth, depth=False)))
    assert np.median(away) < 0.030
    assert np.median(angle) < 20.0


def test_the_size_of_the_picture_does_not_matter(truth: FloatArray) -> None:
    small, large = (lift_clip(picture(truth, noise=0.0, pixels=pixels)).positions for pixels in (1.0, 3000.0))
    # The unit of the depths is found to a tenth, which turns hands, and by these the arms.
    np.testing.assert_allclose(small[:, BODY], large[:, BODY], atol=2e-3)
    np.testing.assert_allclose(small[:, RIGHT_HAND], large[:, RIGHT_HAND], atol=5e-3)


def test_what_is_said_to_be_unsure_is_unsure(truth: FloatArray, from_near: LiftedPerson) -> None:
    """Depths are off by about their deviation: neither boasting nor of no use."""
    sigma = np.concatenate([from_near.sigma[raised(truth, side), row] for side, row in WRIST.items()])
    ratios = distances(truth, from_near, WRIST) / (np.sqrt(3.0) * sigma)
    assert 0.3 < float(np.sqrt((ratios**2).mean())) < 1.8


def test_hands_end_their_arms_and_none_is_inside_the_trunk(lifted: LiftedPerson) -> None:
    for side in SIDES:
        hand = lifted.positions[:, HANDS[side[0].upper()]]
        np.testing.assert_allclose(hand[:, 0], lifted.positions[:, WRIST[side]], atol=1e-9)
    wrists = lifted.positions[:, list(WRIST.values())].reshape(-1, 3)
    before = (np.abs(wrists[:, 1]) < 0.12) & (wrists[:, 2] > -0.40) & (wrists[:, 2] < 0.05)
    assert before.any()
    assert (wrists[before, 0] > 0.05).all()


def flipped(hand: Points, frames: Sequence[int]) -> Points:
    """A hand of which the detector took the back for the palm: the fingers point as before."""
    places = hand.places.copy()
    for frame in frames:
        wrist, middle = places[frame, 0], places[frame, [MIDDLE, MIDDLE + 4]].mean(axis=0)
        axis = (middle - wrist) / np.linalg.norm(middle - wrist)
        ways = places[frame] - wrist
        places[frame] = wrist + 2.0 * (ways @ axis)[:, None] * axis - ways
    return Points(places=places, confidence=hand.confidence)


def palm_errors(truth: FloatArray, person: LiftedPerson, frames: Sequence[int]) -> FloatArray:
    """Between the ways the right palm faces and was found to, in the frames in which it was [deg]."""
    true, found = (
        palm_axes(points[list(frames), RIGHT_HAND])[..., 2] for points in (truth, person.positions)
    )
    cosine = (true * found).sum(axis=1)
    return np.degrees(np.arccos(np.clip(cosine[np.isfinite(cosine)], -1.0, 1.0)))


def test_frames_in_which_the_detector_takes_the_back_of_a_hand_for_its_palm_are_left_out(
    truth: FloatArray,
) -> None:
    clip, wrong = picture(truth), (20, 21, 30, 41)
    person = lift_clip(replace(clip, right_hand=flipped(clip.right_hand, wrong)))
    # Seen from its edge, a hand that was turned about its fingers looks much as it did.
    assert (palm_errors(truth, person, wrong) < 45.0).all()
    lost = ~np.isfinite(person.positions[:, RIGHT_HAND]).all(axis=(1, 2))
    assert lost[[20, 21, 41]].all()
    assert lost.sum() <= len(wrong) + 2
    assert np.isfinite(person.positions[list(wrong), WRIST["right"]]).all()


def test_frames_in_which_the_detector_takes_front_for_back_are_turned_round(truth: FloatArray) -> None:
    clip, wrong = picture(truth), (20, 21, 30, 41, 75, 86)
    places = clip.right_hand.places.copy()
    places[list(wrong), :, 0] *= -1.0
    person = lift_clip(replace(clip, right_hand=replace(clip.right_hand, places=places)))
    errors = palm_errors(truth, person, wrong)
    assert len(errors) == len(wrong)
    assert np.median(errors) < 25.0
    assert (errors < 60.0).all()


def test_a_palm_that_turns_over_for_good_is_believed() -> None:
    angles = np.radians([0.0, 5.0, 0.0, 60.0, 120.0, 175.0, 180.0, 180.0, 175.0, 180.0])
    palms = np.stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))], axis=1)
    times = np.arange(len(angles)) / 20.0
    assert without_flips(palms, times).all()
    at_once = palms[[0, 1, 2, 0, 1, 5, 6, 7, 8, 9]]
    assert without_flips(at_once, times).all()
    assert without_flips(palms[:0], times[:0]).shape == (0,)


def hidden(points: Points, frames: slice, rows: Sequence[int] | range) -> Points:
    """Points of which some are not seen in some frames."""
    places, confidence = points.places.copy(), points.confidence.copy()
    places[frames, rows], confidence[frames, rows] = np.nan, 0.0
    return Points(places=places, confidence=confidence)


def test_points_that_were_not_seen_stay_lost(truth: FloatArray) -> None:
    clip, elbow = picture(truth), ELBOW["left"]
    body, hand = (
        hidden(clip.body, slice(40, 44), [elbow]),
        hidden(clip.right_hand, slice(20, 30), range(21)),
    )
    person = lift_clip(replace(clip, body=body, right_hand=hand))
    known = np.isfinite(person.positions).all(axis=2)
    assert (person.status[known] == 3).all()
    assert (person.status[~known] == 0).all()
    assert not known[20:30, RIGHT_HAND].any()
    assert known[:20, RIGHT_HAND].all()
    assert not known[40:44, elbow].any()
    assert known[40:44, WRIST["left"]].all()
    assert not known[:, KEYPOINTS:].any()  # a face


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("lost", "left_hand", "frames"),
    [
        ((3, 6), True, 30),
        ((0, 1, 3, 4, 6, 7, 8, 9, 12, 15, 16, 17, 18), True, 30),
        ((6, 7), False, 30),
        ((), True, 2),
    ],
    ids=["no elbows", "shoulders and hands only", "no left arm", "two frames"],
)
def test_whatever_is_missing_the_right_hand_is_lifted(
    truth: FloatArray, lost: tuple[int, ...], left_hand: bool, frames: int
) -> None:
    clip = picture(truth[:frames])
    body = hidden(clip.body, slice(None), lost)
    left = clip.left_hand if left_hand else hidden(clip.left_hand, slice(None), range(21))
    person = lift_clip(replace(clip, body=body, left_hand=left))
    away = person.positions[:, RIGHT_HAND] - truth[:frames, RIGHT_HAND]
    assert np.median(np.linalg.norm(away, axis=2)) < 0.15
    assert np.isfinite(person.positions[:, LEFT_HAND]).any() == left_hand


def test_depths_are_smoothed_by_how_sure_they_are() -> None:
    times = np.arange(60) / 30.0
    true = 0.1 * np.sin(2.0 * np.pi * times)
    random = np.random.default_rng(3)
    sigmas = np.where(np.arange(60) % 3 == 0, 0.2, 0.005)
    measured = true + random.normal(0.0, 1.0, 60) * sigmas
    measured[10:13] = np.nan
    smooth = smooth_depth(measured[:, None], sigmas[:, None], period=1.0 / 30.0, acceleration=6.0)[:, 0]
    assert np.abs(smooth - true).max() < 0.02
    straight = smooth_depth(
        np.array([[0.0], [np.nan], [2.0]]), np.full((3, 1), 1e-6), period=1.0, acceleration=1.0
    )
    np.testing.assert_allclose(straight[:, 0], [0.0, 1.0, 2.0], atol=1e-9)
