# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused
from robot_person import part
from scipy.spatial.transform import Rotation

from teo_sign_capture.tracks.skeleton_track import Keypoints, SkeletonTrack, in_body_axes

TIMES = np.arange(60) / 30.0
UP = (0.0, 0.0, 1.0)
HIPS = np.array([0.0, 0.0, -0.5])


def person(frames=60):
    """Shoulders, hips and a right hand that moves, in the axes of the body itself [m]."""
    body = np.full((frames, 25, 3), np.nan)
    body[:, 2], body[:, 5] = (0.0, -0.18, 0.0), (0.0, 0.18, 0.0)
    body[:, 9], body[:, 12] = (0.0, -0.12, -0.5), (0.0, 0.12, -0.5)
    body[:, 8] = (0.0, 0.0, -0.5)
    hand = np.tile((0.3, -0.1, 0.05), (frames, 21, 1))
    hand[..., 2] += 0.1 * np.sin(2.0 * np.pi * 2.0 * np.arange(frames) / 30.0)[:, None]
    return body, hand


def track_of(body, hand, up=UP):
    frames = len(body)
    return in_body_axes(
        times=TIMES[:frames],
        body=part(body),
        left_hand=Keypoints.lost(frames, 21),
        right_hand=part(hand),
        face=Keypoints.lost(frames, 70),
        source="clip",
        recorded=None,
        up=up,
    )


@settings(max_examples=20)
@given(
    turn=st.tuples(*[st.floats(-3.0, 3.0)] * 3),
    shift=st.tuples(*[st.floats(-4.0, 4.0)] * 3),
)
def test_where_a_person_stands_and_faces_changes_nothing(turn, shift):
    body, hand = person()
    rotation = Rotation.from_rotvec(turn)
    moved = [(rotation.apply(points.reshape(-1, 3)) + shift).reshape(points.shape) for points in (body, hand)]
    assert track_of(*moved).right_hand.positions == pytest.approx(hand, abs=1e-9)


def test_a_person_who_sways_does_not_make_the_hands_sway():
    body, hand = person()
    angle = np.radians(4.0) * np.sin(2.0 * np.pi * 0.4 * TIMES)
    sway = Rotation.from_euler("x", angle[:, None])
    moved = []
    for points in (body, hand):
        about_hips = points - HIPS
        turned = np.einsum("tij,tkj->tki", sway.as_matrix(), about_hips) + HIPS
        moved.append(turned + np.stack([0.0 * TIMES, 0.02 * np.sin(TIMES), 0.0 * TIMES], axis=1)[:, None])
    track = track_of(*moved)
    inside = slice(10, -10)  # at the ends a Gaussian sees one side
    assert track.right_hand.positions[inside] == pytest.approx(hand[inside], abs=0.004)
    # The trunk's own sway is not lost, but told.
    assert np.ptp(track.trunk[:, 0]) == pytest.approx(np.ptp(angle), rel=0.15)


def test_an_arm_that_lifts_its_shoulder_does_not_tilt_the_axes():
    body, hand = person()
    body[:, 2, 2] += 0.05
    track = track_of(body, hand)
    # Half of the lift is in the origin; a tilt of the line of the shoulders would move the hand by 4 cm more.
    assert track.right_hand.positions == pytest.approx(hand - (0.0, 0.0, 0.025), abs=0.003)


def test_hips_that_are_not_seen_are_replaced_by_up():
    body, hand = person()
    body[:, (8, 9, 12)] = np.nan
    assert track_of(body, hand).right_hand.positions == pytest.approx(hand, abs=1e-9)


def test_a_gap_of_the_shoulders_is_bridged_and_a_lost_hand_stays_lost():
    body, hand = person()
    body[20:30, 2] = np.nan
    hand[40] = np.nan
    track = track_of(body, hand)
    assert np.isfinite(track.right_hand.positions[20:30]).all()
    assert np.isnan(track.right_hand.positions[40]).all()


@pytest.mark.parametrize(
    ("right", "left"),
    [
        (np.nan, (0.0, 0.18, 0.0)),
        ((0.0, -0.18, 0.0), np.nan),
        ((0.0, 0.0, -0.1), (0.0, 0.0, 0.1)),  # along the trunk
    ],
)
def test_a_person_whose_shoulders_are_not_seen_is_refused(right, left):
    body, hand = person()
    body[:, 2], body[:, 5] = right, left
    with refused("no_torso", r"clip: .*shoulders"):
        track_of(body, hand)


def track(times, trunk=None):
    """A person of whom nothing is seen."""
    sizes = {"body": 25, "left_hand": 21, "right_hand": 21, "face": 70}
    parts = {name: Keypoints.lost(len(times), size) for name, size in sizes.items()}
    times = np.asarray(times, float)
    return SkeletonTrack(times=times, source="clip", recorded=None, trunk=trunk, **parts)


def test_a_part_of_a_track_holds_both_ends_and_begins_at_zero():
    whole = track(np.arange(10) * 0.1, trunk=np.arange(30.0).reshape(10, 3))
    whole.right_hand.positions[:] = np.arange(10)[:, None, None]
    part = whole.between(0.3 - 1e-9, 0.6 + 1e-9)
    assert part.times == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert part.right_hand.positions[:, 0, 0] == pytest.approx([3, 4, 5, 6])
    assert part.trunk[:, 0] == pytest.approx([9, 12, 15, 18])
    assert part.hand("right") is part.right_hand
    assert part.hand("left") is part.left_hand


def test_a_part_without_frames_says_how_long_the_track_is():
    with refused("empty_track", r"clip: .* 0\.90 s"):
        track(np.arange(10) * 0.1).between(2.0, 3.0)


@pytest.mark.parametrize(
    ("code", "times"),
    [
        ("empty_track", ()),
        *(
            ("bad_stamps", times)
            for times in ((0.0, 0.1, 0.1), (0.0, 0.2, 0.1), (0.0, np.nan, 0.2), (np.inf,))
        ),
    ],
)
def test_times_that_do_not_go_on_are_refused(code, times):
    with refused(code):
        track(times)


def test_shoulders_that_tremble_do_not_make_the_hands_tremble():
    body, hand = person()
    noisy = body.copy()
    noisy[:, (2, 5)] += np.random.default_rng(0).normal(0.0, 0.01, (60, 2, 3))
    assert np.std(track_of(noisy, hand).right_hand.positions - hand) < 0.004
