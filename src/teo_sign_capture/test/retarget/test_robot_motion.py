# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from refusals import refused
from robot_person import JOINTS, keypoints, mirrored_points, part, track_of, turn_head
from scipy.spatial.transform import Rotation

from teo_description.humanoid import load_humanoid
from teo_names import HEAD, LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_sign_capture.recordings.skeleton_bag import read_skeletons
from teo_sign_capture.retarget.arm_kinematics import mirrored
from teo_sign_capture.retarget.robot_motion import retarget_motion
from teo_sign_capture.tracks.signer_motion import measure_person, signer_motion
from teo_sign_capture.tracks.skeleton_track import Keypoints

SHIPPED = Path(__file__).resolve().parents[4] / "bags" / "signer_d435"
TIMES = np.arange(31) / 15.0
RIGHT, LEFT = RIGHT_ARM + RIGHT_HAND, LEFT_ARM + LEFT_HAND


def retargeted(robot, track, **options):
    return retarget_motion(robot, signer_motion(track, **options))


# [s] From when to when each of three handshapes is held.
HELD = [0.0, 0.45, 0.75, 1.25, 1.55, 2.0]


@pytest.fixture(scope="module")
def played():
    """What TEO does itself: both hands from before the chest to the face, not alike."""
    knots = {
        "right": [[-45, -12, 10, -80, 20, 0], [-74, 10, 11, -80, 48, 1], [-60, -20, 30, -60, 0, 10]],
        "left": [[-50, -10, 10, -75, 10, 5], [-55, -5, 30, -70, 20, 5], [-45, -12, 10, -80, 20, 0]],
    }
    # Flat, a claw, thumb and little finger; open, the index alone, index and middle.
    hands = {
        "right": [[0, -25, 7, 7, 7, 7], [10, -60, 48, 48, 48, 48], [0, -70, 80, 80, 80, 7]],
        "left": [[0, -70, 7, 7, 7, 7], [45, -15, 7, 80, 80, 80], [70, -15, 7, 7, 80, 80]],
    }
    columns = []
    for side in ("right", "left"):
        held = np.repeat(hands[side], 2, axis=0)
        arm, hand = (
            np.radians([np.interp(TIMES, at, knot) for knot in np.transpose(rows)]).T
            for at, rows in (([0.0, 1.0, 2.0], knots[side]), (HELD, held))
        )
        columns += [
            np.stack([mirrored(load_humanoid(), row) for row in arm]) if side == "left" else arm,
            hand,
        ]
    return np.concatenate(columns, axis=1)


@pytest.fixture(scope="module")
def points(robot, played):
    return keypoints(robot, JOINTS, played)


@pytest.fixture(scope="module")
def both(robot, points):
    return retargeted(robot, track_of(TIMES, points), handedness="both")


def palms(robot, joints, positions, side="right"):
    rows = [robot.configuration(dict(zip(joints, row.tolist(), strict=True))) for row in positions]
    return np.stack([robot.placement(q, f"{side}_palm") for q in rows])


def test_teo_does_again_what_teo_has_done(robot, played, both):
    assert both.joints == JOINTS
    arms = [joint.endswith(("Shoulder", "Elbow", "Wrist")) for joint in JOINTS]
    fingers = [index for index, joint in enumerate(JOINTS) if "Finger" in joint and "Thumb" not in joint]
    assert np.degrees(np.abs(both.positions - played)[:, arms]).max() < 12.0
    off = np.degrees(np.abs(both.positions - played)[:, fingers])
    still = np.abs(TIMES[:, None] - np.mean(np.reshape(HELD[1:-1], (2, 2)), axis=1)).min(axis=1) > 0.35
    assert off[still].max() < 8.0
    assert off.max() < 25.0
    for side in ("right", "left"):
        wanted, found = (palms(robot, JOINTS, motion, side) for motion in (played, both.positions))
        assert 1000.0 * np.linalg.norm(wanted[:, :3, 3] - found[:, :3, 3], axis=1).max() < 20.0
        turned = (wanted[:, :3, 2] * found[:, :3, 2]).sum(axis=1)
        assert np.degrees(np.arccos(np.clip(turned, -1, 1))).max() < 3.0


def test_errors_are_those_of_the_robots_own_kinematics(robot, points, both):
    track = track_of(TIMES, points)
    hand = track.right_hand.positions
    along = hand[:, (9, 13)].mean(axis=1) - hand[:, 0]
    reached = palms(robot, both.joints, both.positions)[:, :3, 0]
    cosine = (along * reached).sum(axis=1) / np.linalg.norm(along, axis=1)
    assert both.finger_error[:, 0] == pytest.approx(np.arccos(np.clip(cosine, -1, 1)), abs=1e-3)
    for error in (both.place_error, both.palm_error, both.finger_error, both.flexion_error):
        assert error.shape == (31, 2)
        assert (error >= 0.0).all()


def test_limits_and_distance_are_kept(robot, both):
    limits = joint_limits(both.joints)
    assert (both.positions >= limits.lower - 1e-9).all()
    assert (both.positions <= limits.upper + 1e-9).all()
    distances = [
        robot.clearance(robot.configuration(dict(zip(both.joints, row.tolist(), strict=True)))).distance
        for row in both.positions
    ]
    assert both.clearance == pytest.approx(np.array(distances), abs=1e-6)
    assert both.clearance.min() >= 0.010


def nearest_on_ways(robot, motion):
    """Smallest distance between parts on the straight ways between frames, looked at every 2 deg [m]."""
    least = np.inf
    for first, second in pairwise(motion.positions):
        for share in np.linspace(0.0, 1.0, 2 + int(np.degrees(np.abs(second - first).max()) / 2.0)):
            row = first + share * (second - first)
            pose = dict(zip(motion.joints, row.tolist(), strict=True))
            least = min(least, robot.clearance(robot.configuration(pose)).distance)
    return least


def test_a_person_of_another_size_gives_the_same_motion(robot, points, both):
    found = retargeted(robot, track_of(TIMES, [0.5 * one for one in points]), handedness="both")
    assert np.degrees(np.abs(found.positions - both.positions)).max() < 6.0


def test_a_person_in_a_mirror_gives_the_mirrored_motion(robot, points, both):
    found = retargeted(robot, track_of(TIMES, mirrored_points(points)), handedness="both")
    for joints, others in ((RIGHT_ARM, LEFT_ARM), (RIGHT_HAND, LEFT_HAND)):
        ours, theirs = (
            motion.positions[:, [motion.joints.index(joint) for joint in names]]
            for motion, names in ((found, joints), (both, others))
        )
        if joints == RIGHT_ARM:
            theirs = np.stack([mirrored(load_humanoid(), row) for row in theirs])
        assert np.degrees(np.abs(ours - theirs)).max() < 3.0


@pytest.mark.parametrize(("side", "joints", "column"), [("right", RIGHT, 0), ("left", LEFT, 1)])
def test_one_hand_leaves_the_other_out(robot, points, side, joints, column):
    seen = list(points)
    seen[1 + column] = np.full_like(seen[1 + column], np.nan)  # left comes before right
    found = retargeted(robot, track_of(TIMES, seen), handedness=side)
    assert found.joints == joints
    assert np.isfinite(found.place_error[:, column]).all()
    assert np.isnan(found.place_error[:, 1 - column]).all()


def test_a_finger_at_a_persons_chin_is_at_teos_chin(robot):
    track = read_skeletons(SHIPPED, topic="/truth/skeletons").between(2.6, 3.5)
    found = retargeted(robot, track, handedness="right")
    person = np.linalg.norm(track.right_hand.positions[:, 12] - track.face.positions[:, 8], axis=1)
    touching = np.flatnonzero(person < 0.04)
    assert len(touching) > 2
    for frame in touching:
        q = robot.configuration(dict(zip(found.joints, found.positions[frame].tolist(), strict=True)))
        tip = robot.placement(q, "RightMiddleFingerTip")[:3, 3]
        # The chin's surface; the person's tip is 3 cm before it, the gap that TEO keeps is 1 cm.
        assert 1000.0 * np.linalg.norm(tip - (0.1015, 0.0, 0.640)) < 60.0


def test_a_hand_that_would_go_into_the_body_is_moved_off_and_says_by_how_much(robot, points):
    body, left, right, face = (one.copy() for one in points)
    into = np.array([0.0, 0.0, 0.40]) - right.mean(axis=1)  # the middle of the chest
    right += into[:, None]
    body[:, 4] += into
    found = retargeted(robot, track_of(TIMES, (body, left, right, face)), handedness="right")
    assert found.clearance.min() >= 0.010
    # The chest is 12 cm deep before its middle.
    assert np.median(found.place_error[:, 0]) > 0.05


@pytest.mark.slow
def test_hands_that_pass_through_each_other_on_teo_are_led_past(robot, points):
    body, left, right, face = (one.copy() for one in points)
    # Both hands to the middle of the chest, changing sides.
    share = np.linspace(-1.0, 1.0, len(TIMES))[:, None]
    for hand, row, sign in ((right, 4, 1.0), (left, 7, -1.0)):
        shift = np.array([0.35, 0.0, 0.40]) + sign * share * (0.0, 0.15, 0.0) - hand.mean(axis=1)
        hand += shift[:, None]
        body[:, row] += shift
    found = retargeted(robot, track_of(TIMES, (body, left, right, face)), handedness="both")
    assert found.clearance.min() >= 0.010
    assert nearest_on_ways(robot, found) > 0.0


@pytest.mark.slow
def test_hands_that_meet_go_through_nothing_between_frames(robot):
    """Fingers that interlock in the shipped recording."""
    track = read_skeletons(SHIPPED, topic="/truth/skeletons")
    found = retargeted(robot, track.between(1.3, 2.5), handedness="both", person=measure_person(track))
    assert nearest_on_ways(robot, found) > 0.0
    arms = [index for index, joint in enumerate(found.joints) if joint in RIGHT_ARM + LEFT_ARM]
    assert np.degrees(np.abs(np.diff(found.positions[:, arms], axis=0))).max() < 40.0  # 15 frames a second
    # Off each other, and no farther away than a hand's length.
    assert np.percentile(found.place_error, 90) < 0.18


def test_a_head_that_turns_takes_part_and_reports_what_it_cannot(robot, points):
    body, left, right, face = (one.copy() for one in points)
    turn_head(body, face, Rotation.from_euler("z", 80.0 * (TIMES > 1.0)[:, None], degrees=True).as_matrix())
    found = retargeted(robot, track_of(TIMES, (body, left, right, face)), handedness="right")
    assert found.joints == RIGHT + HEAD
    assert np.degrees(found.positions[-1, -2]) == pytest.approx(60.0)
    assert np.degrees(found.head_error[-1]) == pytest.approx(20.0, abs=1.0)
    assert np.degrees(found.head_error[0]) < 1.0


def test_a_part_of_a_recording_uses_what_is_known_of_the_person(robot, points, both):
    track = track_of(TIMES, points)
    part = track.between(0.5, 1.5)
    found = retargeted(robot, part, handedness="both", person=measure_person(track))
    inside = (TIMES >= 0.5 - 1e-9) & (TIMES <= 1.5 + 1e-9)
    assert np.degrees(np.abs(found.positions - both.positions[inside])[2:-2]).max() < 5.0


@pytest.mark.parametrize("side", ["right", "left", "both"])
def test_a_hand_that_is_never_seen_is_refused(robot, points, side):
    track = track_of(TIMES, points)
    lost = Keypoints.lost(len(TIMES), 21)
    with refused("no_hand", r"hand .* picture"):
        retargeted(robot, replace(track, left_hand=lost, right_hand=lost), handedness=side)


def test_an_arm_that_is_never_seen_is_refused(robot, points):
    body, left, right, face = (one.copy() for one in points)
    body[:, (3, 6)] = np.nan
    with refused("no_arm", "elbow"):
        retargeted(robot, track_of(TIMES, (body, left, right, face)), handedness="right")


def test_one_frame_is_a_motion(robot, points):
    found = retargeted(robot, track_of(TIMES[:1], [one[:1] for one in points]), handedness="both")
    assert found.positions.shape == (1, len(JOINTS))
    assert found.clearance[0] >= 0.010


def test_gaps_of_a_hand_are_bridged(robot, points, both):
    track = track_of(TIMES, points)
    holed = track.right_hand.positions.copy()
    holed[10:13] = np.nan
    holed[::2, 8] = np.nan  # the index's tip comes and goes
    found = retargeted(robot, replace(track, right_hand=part(holed)), handedness="both")
    assert np.isfinite(found.positions).all()
    assert np.degrees(np.abs(found.positions - both.positions)).max() < 15.0
