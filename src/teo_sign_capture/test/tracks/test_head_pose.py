# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from robot_person import keypoints, track_of
from scipy.spatial.transform import Rotation

from teo_description import RIGHT_ARM
from teo_description.robot import Robot
from teo_sign_capture.retarget.head_motion import follow_head, follow_trunk
from teo_sign_capture.tracks.head_pose import head_pose, head_shape
from teo_sign_capture.tracks.person import measure_person

FRAMES = 31
TIMES = np.arange(FRAMES) / 30.0
NECK = np.array([0.0, 0.0, 0.63])


@pytest.fixture(scope="module")
def robot():
    return Robot.load()


def nodding(robot, yaw, pitch, hide=()):
    """A person of TEO's size whose head turns and nods about the neck [rad], arms hanging."""
    body, left, right, face = keypoints(robot, RIGHT_ARM, np.radians(np.tile([-5.0] * 6, (FRAMES, 1))))
    turns = Rotation.from_euler("ZY", np.stack([yaw, pitch], axis=1)).as_matrix()
    for points, rows in ((body, (0, 15, 16, 17, 18)), (face, range(70))):
        points[:, rows] = np.einsum("tij,tkj->tki", turns, points[:, rows] - NECK) + NECK
    body[:, list(hide)] = np.nan
    return track_of(TIMES, (body, left, right, face)), turns


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
    head = follow_head(robot, head_pose(track, head_shape(track)), measure_person(track))
    assert np.degrees(head.axes[:, 0]) == pytest.approx(np.full(FRAMES, 30.0), abs=0.5)


def test_what_a_head_cannot_follow_is_reported(robot):
    pitch = np.radians(25.0) * (TIMES > 0.7)
    track, _ = nodding(robot, np.zeros(FRAMES), pitch)
    head = follow_head(robot, head_pose(track, head_shape(track)), measure_person(track))
    assert np.degrees(head.axes[:, 1]).max() == pytest.approx(10.0)
    assert np.degrees(head.error[-1]) == pytest.approx(15.0, abs=1.0)


def test_a_head_that_only_sways_takes_no_part(robot):
    track, _ = nodding(robot, np.radians(3.0) * np.sin(7.0 * TIMES), np.zeros(FRAMES))
    head = follow_head(robot, head_pose(track, head_shape(track)), measure_person(track))
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
    body[:, (0, 15, 16, 17, 18)] = np.nan
    track = track_of(TIMES, (body, left, right, np.full_like(face, np.nan)))
    pose = head_pose(track, head_shape(track))
    assert pose.turns == pytest.approx(np.broadcast_to(np.eye(3), (FRAMES, 3, 3)))
    person = measure_person(track)
    # A face above the shoulders and before the ears, by proportion.
    assert np.isfinite(list(person.places.values())).all()
    assert 0.05 < person.places["chin"][2] < person.places["mouth"][2] < person.places["nose"][2]
    assert not follow_head(robot, pose, person).moves


def test_a_trunk_follows_within_its_limits_and_reports_the_rest():
    lean = np.radians(np.array([0.0, 10.0, 30.0]))
    side = Rotation.from_euler("x", 12.0, degrees=True).as_rotvec()
    forward = [Rotation.from_euler("y", angle).as_rotvec() for angle in lean]
    trunk = follow_trunk(np.array([*forward, side]))
    assert trunk.moves
    assert trunk.axes[:3, 1] == pytest.approx(lean)
    assert np.degrees(trunk.error) == pytest.approx([0.0, 0.0, 0.0, 12.0], abs=1e-6)
    assert not follow_trunk(np.zeros((4, 3))).moves
