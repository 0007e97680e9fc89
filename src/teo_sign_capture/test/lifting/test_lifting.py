# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Clips made of the true skeletons of the synthetic signer, lifted and compared with them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_sign_capture.lifting.clip import lift_clip
from teo_sign_capture.lifting.depth_smoothing import smooth_depth
from teo_sign_capture.recordings.pose_file import Points, PoseClip, read_pose_file
from teo_sign_capture.recordings.skeleton_bag import read_skeletons
from teo_sign_capture.recordings.video import pose_file
from teo_sign_capture.tracks.body_axes import in_body_axes
from teo_sign_capture.tracks.hand_shape import palm_axes
from teo_sign_capture.tracks.skeleton_track import ELBOW, WRIST, SkeletonTrack
from teo_signs.errors import LutError

BAG = Path(__file__).resolve().parents[4] / "bags" / "signer_d435"
# [pixel/m] Of a person at 1.5 m before a camera of 640 pixels.
PIXELS = 550.0
# [m] Below the shoulders; wrists under it hang.
RAISED = -0.36


@pytest.fixture(scope="module")
def truth() -> SkeletonTrack:
    return read_skeletons(BAG, topic="/truth/skeletons")


@pytest.fixture(scope="module")
def lifted(truth: SkeletonTrack) -> SkeletonTrack:
    return lift_clip(picture(truth))


def picture(
    truth: SkeletonTrack,
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

    def part(true: Array, *, guessed: bool) -> Points:
        size = pixels / (1.0 - true[..., 0] / distance)
        places = true * size[..., None] + random.normal(0.0, noise, true.shape)
        places[..., 0] = np.nan
        if guessed:
            places[..., 0] = (
                0.8 * (true - true[:, :1])[..., 0] + random.normal(0.0, 0.006, true.shape[:2])
            ) / 5.0
        return Points(places=places, confidence=np.ones(true.shape[:2]))

    return PoseClip(
        rate=1.0 / float(np.median(np.diff(truth.times))),
        body=part(truth.body.positions, guessed=False),
        left_hand=part(truth.left_hand.positions, guessed=depth),
        right_hand=part(truth.right_hand.positions, guessed=depth),
        source="made of the truth",
        layout="any",
    )


def sides(truth: SkeletonTrack, lifted: SkeletonTrack, points: dict[str, int]) -> Array:
    """Distances of a point of both sides from where it is, while the hand is raised [m]."""
    found = []
    for side, point in points.items():
        raised = truth.body.positions[:, WRIST[side], 2] > RAISED
        found.append(lifted.body.positions[raised, point] - truth.body.positions[raised, point])
    return np.concatenate(found)


def hand_errors(truth: SkeletonTrack, lifted: SkeletonTrack) -> tuple[Array, Array]:
    """Mean distance of the points from the wrist [m], and angle between the palms' normals [rad]."""
    away, angles = [], []
    for side, mirror in (("right", 1.0), ("left", -1.0)):
        raised = truth.body.positions[:, WRIST[side], 2] > RAISED
        true, found = (track.hand(side).positions[raised] * [1.0, mirror, 1.0] for track in (truth, lifted))
        difference = (found - found[:, :1]) - (true - true[:, :1])
        away.append(np.linalg.norm(difference, axis=2).mean(axis=1))
        cosine = (palm_axes(true)[..., 2] * palm_axes(found)[..., 2]).sum(axis=1)
        angles.append(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return np.concatenate(away), np.concatenate(angles)


def test_arms_come_back_to_a_few_centimetres_from_afar(truth: SkeletonTrack, lifted: SkeletonTrack) -> None:
    for points, usual in ((ELBOW, 0.045), (WRIST, 0.060)):
        away = np.linalg.norm(sides(truth, lifted, points), axis=1)
        assert np.median(away) < usual
        assert np.percentile(away, 90.0) < 2.0 * usual


def test_arms_come_back_to_five_centimetres_from_two_metres(truth: SkeletonTrack) -> None:
    lifted = lift_clip(picture(truth, distance=2.0))
    for points in (ELBOW, WRIST):
        away = np.linalg.norm(sides(truth, lifted, points), axis=1)
        assert np.median(away) < 0.05
        assert np.percentile(away, 90.0) < 0.09


def test_hands_keep_their_shape_and_the_way_the_palm_faces(
    truth: SkeletonTrack, lifted: SkeletonTrack
) -> None:
    away, angle = hand_errors(truth, lifted)
    assert np.median(away) < 0.018
    assert np.median(angle) < math.radians(10.0)
    assert np.percentile(angle, 90.0) < math.radians(25.0)


def test_without_a_guess_of_depth_most_palms_still_face_the_right_way(truth: SkeletonTrack) -> None:
    away, angle = hand_errors(truth, lift_clip(picture(truth, depth=False)))
    assert np.median(away) < 0.030
    assert np.median(angle) < math.radians(20.0)


def test_the_size_of_the_picture_does_not_matter(truth: SkeletonTrack) -> None:
    small = lift_clip(picture(truth, noise=0.0, pixels=1.0))
    large = lift_clip(picture(truth, noise=0.0, pixels=3000.0))
    np.testing.assert_allclose(small.body.positions, large.body.positions, atol=1e-9)
    # The unit of the depths is found to a tenth.
    np.testing.assert_allclose(small.right_hand.positions, large.right_hand.positions, atol=5e-3)


def test_what_is_said_to_be_unsure_is_unsure(truth: SkeletonTrack) -> None:
    """Depths are off by about their deviation: neither boasting nor of no use."""
    lifted = lift_clip(picture(truth, distance=2.0))
    ratios = []
    for side, wrist in WRIST.items():
        raised = truth.body.positions[:, WRIST[side], 2] > RAISED
        off = lifted.body.positions[raised, wrist] - truth.body.positions[raised, wrist]
        ratios.append(np.linalg.norm(off, axis=1) / (np.sqrt(3.0) * lifted.body.sigma[raised, wrist]))
    rms = float(np.sqrt((np.concatenate(ratios) ** 2).mean()))
    assert 0.3 < rms < 1.8


def test_hands_end_their_arms(lifted: SkeletonTrack) -> None:
    for side, wrist in WRIST.items():
        np.testing.assert_allclose(
            lifted.hand(side).positions[:, 0], lifted.body.positions[:, wrist], atol=1e-9
        )


def test_no_hand_is_inside_the_trunk(lifted: SkeletonTrack) -> None:
    wrists = lifted.body.positions[:, list(WRIST.values())].reshape(-1, 3)
    before = (np.abs(wrists[:, 1]) < 0.12) & (wrists[:, 2] > -0.40) & (wrists[:, 2] < 0.05)
    assert before.any()
    assert (wrists[before, 0] > 0.05).all()


def test_points_that_were_not_seen_stay_lost(truth: SkeletonTrack) -> None:
    clip = picture(truth)
    confidence = clip.right_hand.confidence.copy()
    confidence[20:30] = 0.0
    places = clip.right_hand.places.copy()
    places[20:30] = np.nan
    hand = Points(places=places, confidence=confidence)
    body = clip.body.confidence.copy()
    body[40:44, ELBOW["left"]] = 0.0
    shown = clip.body.places.copy()
    shown[40:44, ELBOW["left"]] = np.nan
    lifted = lift_clip(
        PoseClip(
            rate=clip.rate,
            body=Points(places=shown, confidence=body),
            left_hand=clip.left_hand,
            right_hand=hand,
            source="holes",
            layout="any",
        )
    )
    lost = ~np.isfinite(lifted.right_hand.positions).all(axis=2)
    assert lost[20:30].all()
    assert not lost[:20].any()
    assert (lifted.right_hand.status[20:30] == 0).all()
    assert not np.isfinite(lifted.body.positions[40:44, ELBOW["left"]]).any()
    assert np.isfinite(lifted.body.positions[40:44, WRIST["left"]]).all()


def without(clip: PoseClip, lost: Sequence[int], *, left_hand: bool, frames: int) -> PoseClip:
    """The beginning of a clip, with points of the body and the left hand never seen."""

    def part(points: Points, hidden: Sequence[int]) -> Points:
        places, confidence = points.places[:frames].copy(), points.confidence[:frames].copy()
        places[:, hidden], confidence[:, hidden] = np.nan, 0.0
        return Points(places=places, confidence=confidence)

    return PoseClip(
        rate=clip.rate,
        body=part(clip.body, lost),
        left_hand=part(clip.left_hand, () if left_hand else range(21)),
        right_hand=part(clip.right_hand, ()),
        source=clip.source,
        layout=clip.layout,
    )


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
    truth: SkeletonTrack, lost: tuple[int, ...], left_hand: bool, frames: int
) -> None:
    lifted = lift_clip(without(picture(truth), lost, left_hand=left_hand, frames=frames))
    away = lifted.right_hand.positions - truth.right_hand.positions[:frames]
    assert np.median(np.linalg.norm(away, axis=2)) < 0.15
    assert np.isfinite(lifted.left_hand.positions).any() == left_hand


def test_a_person_turned_by_the_axes_of_the_trunk_is_the_same_person(lifted: SkeletonTrack) -> None:
    """What is lifted is given in the axes of the trunk, with the origin between the shoulders."""
    again = in_body_axes(
        times=lifted.times,
        body=lifted.body,
        left_hand=lifted.left_hand,
        right_hand=lifted.right_hand,
        face=lifted.face,
        source="again",
        recorded=None,
        up=(0.0, 0.0, 1.0),
    )
    np.testing.assert_allclose(again.body.positions, lifted.body.positions, atol=0.02)


@pytest.mark.parametrize("turn", range(0, 360, 20))
def test_who_turns_the_back_to_the_camera_is_refused(
    truth: SkeletonTrack, tmp_path: Path, turn: float
) -> None:
    """By the signer's skeleton turned on the spot; sideways, from 70 to 110 deg, is left to chance."""
    parts = [truth.body, truth.left_hand, truth.right_hand]
    places = np.concatenate([part.positions for part in parts], axis=1)
    turned = Rotation.from_euler("z", turn, degrees=True).apply(places.reshape(-1, 3)).reshape(places.shape)
    points = np.zeros((*places.shape[:2], 4))
    points[..., 0], points[..., 1] = 320.0 + 300.0 * turned[..., 1], 240.0 - 300.0 * turned[..., 2]
    points[..., 3] = np.isfinite(turned).all(axis=2)
    file = tmp_path / "turned.pose"
    file.write_bytes(pose_file(15.0, np.nan_to_num(points), (640, 480)))
    if abs(turn - 180.0) <= 70.0:
        with pytest.raises(LutError) as error:
            read_pose_file(file)
        assert error.value.code == "seen_from_behind"
    elif abs(turn - 180.0) >= 110.0:
        assert read_pose_file(file).body.seen.any()


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
