# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from robot_person import HEAD_OF_BODY, keypoints, track_of, turn_head
from scipy.spatial.transform import Rotation

from teo_names import RIGHT_ARM
from teo_sign_capture.retarget.head_motion import follow_head, follow_trunk
from teo_sign_capture.tracks.head_pose import head_pose, head_shape
from teo_sign_capture.tracks.signer_motion import measure_person

FRAMES = 31
TIMES = np.arange(FRAMES) / 30.0


def nodding(robot, yaw, pitch, hide=()):
    """A person of TEO's size whose head turns and nods about the neck [rad], arms hanging."""
    body, left, right, face = keypoints(robot, RIGHT_ARM, np.radians(np.tile([-5.0] * 6, (FRAMES, 1))))
    turns = Rotation.from_euler("ZY", np.stack([yaw, pitch], axis=1)).as_matrix()
    turn_head(body, face, turns)
    body[:, list(hide)] = np.nan
    return track_of(TIMES, (body, left, right, face)), turns


def followed(robot, track):
    return follow_head(robot, head_pose(track, head_shape(track)), measure_person(track))


def test_a_head_that_turns_and_nods_is_followed_in_every_frame(robot):
    yaw = np.radians(40.0) * np.sin(2.0 * np.pi * TIMES)
    pitch = np.radians(8.0) * np.sin(4.0 * np.pi * TIMES)
    track, turns = nodding(robot, yaw, pitch)
    pose = head_pose(track, head_shape(track))
    away = Rotation.from_matrix(np.swapaxes(turns, 1, 2) @ pose.turns).magnitude()
    assert np.degrees(away).max() < 0.5
    head = follow_head(robot, pose, measure_person(track))
    assert head.moves
    assert head.axes == pytest.approx(np.stack([yaw, pitch], axis=1), abs=0.01)
    assert np.degrees(head.error).max() < 0.5


def test_a_head_that_is_turned_all_the_time_is_not_taken_for_straight(robot):
    track, _ = nodding(robot, np.full(FRAMES, np.radians(30.0)), np.zeros(FRAMES))
    head = followed(robot, track)
    assert np.degrees(head.axes[:, 0]) == pytest.approx(np.full(FRAMES, 30.0), abs=0.5)


def test_a_head_that_only_sways_takes_no_part(robot):
    track, _ = nodding(robot, np.radians(3.0) * np.sin(7.0 * TIMES), np.zeros(FRAMES))
    head = followed(robot, track)
    assert not head.moves
    assert not head.axes.any()


def test_eyes_stand_in_for_ears_that_are_hidden(robot):
    yaw = np.radians(20.0) * np.sin(2.0 * np.pi * TIMES)
    track, turns = nodding(robot, yaw, np.zeros(FRAMES), hide=(17, 18))
    pose = head_pose(track, head_shape(track))
    # What is straight in nodding is known up to a constant.
    since = pose.turns[0].T @ pose.turns
    away = Rotation.from_matrix(np.swapaxes(turns[0].T @ turns, 1, 2) @ since).magnitude()
    assert np.degrees(away).max() < 4.0
    yaws = Rotation.from_matrix(pose.turns).as_euler("ZYX")[:, 0]
    assert yaws == pytest.approx(yaw, abs=0.02)


def test_a_head_that_is_never_seen_is_held_straight(robot):
    body, left, right, face = keypoints(robot, RIGHT_ARM, np.zeros((FRAMES, 6)))
    body[:, HEAD_OF_BODY] = np.nan
    track = track_of(TIMES, (body, left, right, np.full_like(face, np.nan)))
    pose = head_pose(track, head_shape(track))
    assert pose.turns == pytest.approx(np.broadcast_to(np.eye(3), (FRAMES, 3, 3)))
    person = measure_person(track)
    # A face above the shoulders and before the ears, by proportion.
    assert np.isfinite(list(person.places.values())).all()
    assert 0.05 < person.places["chin"][2] < person.places["mouth"][2] < person.places["nose"][2]
    assert not follow_head(robot, pose, person).moves


def whole_face(robot, yaw, rng):
    """A person whose whole face is seen, with a centimetre of noise."""
    body, left, right, face = keypoints(robot, RIGHT_ARM, np.zeros((FRAMES, 6)))
    # Over the front of an ellipsoid of a head's size before the neck, and outwards of it a nose.
    along, around = rng.uniform(-1.2, 1.2, 70), rng.uniform(-0.9, 0.9, 70)
    front = np.stack([np.cos(along) * np.cos(around), np.sin(along), np.sin(around)], axis=1)
    face[:] = np.array([0.0, 0.0, 0.70]) + front * (0.10, 0.08, 0.11)
    turn_head(body, face, Rotation.from_euler("z", yaw[:, None]).as_matrix())
    noise = rng.normal(0.0, 0.006, (FRAMES, len(HEAD_OF_BODY) + 70, 3))
    body[:, HEAD_OF_BODY] += noise[:, : len(HEAD_OF_BODY)]
    face += noise[:, len(HEAD_OF_BODY) :]
    return body, left, right, face


def yaws_of(track):
    return Rotation.from_matrix(head_pose(track, head_shape(track)).turns).as_euler("ZYX")[:, 0]


def test_an_arm_before_the_face_turns_no_head(robot):
    rng = np.random.default_rng(3)
    yaw = np.radians(8.0) * np.sin(2.0 * np.pi * TIMES)
    points = whole_face(robot, yaw, rng)
    # The arm's depth for the left third of the head, as a depth camera has it: 30 to 60 cm before the face.
    hidden = points[3][:, :, 1] > 0.03
    points[3][10:20][hidden[10:20]] += np.array([0.45, 0.0, 0.0]) + rng.normal(0.0, 0.05, 3)
    assert yaws_of(track_of(TIMES, points)) == pytest.approx(yaw, abs=np.radians(5.0))


def test_a_head_that_is_turned_as_no_neck_turns_is_filled_in(robot):
    rng = np.random.default_rng(4)
    yaw = np.radians(10.0) * np.sin(2.0 * np.pi * TIMES)
    points = whole_face(robot, yaw, rng)
    wrong = np.zeros((FRAMES, 1))
    wrong[[6, 12, 18, 19], 0] = [178.0, 169.0, 58.0, -58.0]
    turn_head(points[0], points[3], Rotation.from_euler("z", wrong, degrees=True).as_matrix())
    found = yaws_of(track_of(TIMES, points))
    assert found == pytest.approx(yaw, abs=np.radians(5.0))
    assert np.abs(np.diff(found)).max() * 30.0 <= np.radians(780.0)


def test_keypoints_count_by_their_sigma(robot):
    rng = np.random.default_rng(5)
    yaw = np.radians(15.0) * np.sin(2.0 * np.pi * TIMES)
    points = whole_face(robot, yaw, rng)
    poor = points[3][:, :, 1] > 0.0
    poor[:10] = poor[20:] = False
    points[3][poor] += (0.012, 0.0, 0.0)
    said, unsaid = track_of(TIMES, points), track_of(TIMES, points)
    said.face.sigma[poor] = 0.03
    error = [np.abs(yaws_of(track) - yaw)[10:20].mean() for track in (said, unsaid)]
    assert error[0] < 0.7 * error[1]


def test_a_face_that_is_mostly_held_is_not_followed(robot):
    yaw = np.radians(30.0) * np.sin(2.0 * np.pi * TIMES)
    points = whole_face(robot, yaw, np.random.default_rng(6))
    track = track_of(TIMES, points)
    shape, person = head_shape(track), measure_person(track)
    track.face.status[:20, :60] = 2
    pose = head_pose(track, shape)
    assert not pose.seen[:20].any()
    assert pose.seen[20:].all()
    assert not follow_head(robot, pose, person).moves


def test_a_trunk_follows_within_its_limits_and_reports_the_rest(robot):
    lean = np.radians(np.array([0.0, 10.0, 30.0]))
    side = Rotation.from_euler("x", 12.0, degrees=True).as_rotvec()
    forward = [Rotation.from_euler("y", angle).as_rotvec() for angle in lean]
    trunk = follow_trunk(robot, np.array([*forward, side]))
    assert trunk.moves
    assert trunk.axes[:3, 1] == pytest.approx(lean)
    assert np.degrees(trunk.error) == pytest.approx([0.0, 0.0, 0.0, 12.0], abs=1e-6)
    assert not follow_trunk(robot, np.zeros((4, 3))).moves
