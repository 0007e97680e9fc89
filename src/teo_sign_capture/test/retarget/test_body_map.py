# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from robot_person import JOINTS, keypoints, track_of, turn_head
from scipy.spatial.transform import Rotation

from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.body_map import BodyMap, body_boxes, on_skin
from teo_sign_capture.retarget.head_motion import follow_head
from teo_sign_capture.signing_space import MIRROR, find_place
from teo_sign_capture.tracks.head_pose import head_pose
from teo_sign_capture.tracks.signer_motion import measure_person


def someone(robot, size=(1.0, 1.0, 1.0)):
    """A person of TEO's build, made wider or larger: forwards, sideways, up."""
    points = keypoints(robot, JOINTS, np.zeros((3, len(JOINTS))))
    return track_of(np.arange(3) / 30.0, [part * size for part in points])


def map_of(robot, track):
    person = measure_person(track)
    return person, BodyMap(robot, ArmKinematics(robot), person)


@pytest.mark.parametrize("size", [(1.0, 1.0, 1.0), (0.8, 0.5, 0.9), (1.1, 0.6, 1.2)])
def test_every_place_of_articulation_comes_to_lie_on_teos(robot, size):
    person, body = map_of(robot, someone(robot, size))
    boxes = body_boxes(robot)
    for name in ("forehead", "nose", "mouth", "chin", "chest", "belly", "ear", "shoulder"):
        wanted = on_skin(robot.humanoid, boxes, name)
        found = body.place(person.places[name][None])[0]
        if name in ("forehead", "nose", "mouth", "chin", "chest", "belly"):
            wanted = wanted * (1.0, 0.0, 1.0)
        assert 1000.0 * np.linalg.norm(found - wanted) < 12.0, name


def test_the_map_is_the_same_on_both_sides_and_folds_nowhere(robot):
    _, body = map_of(robot, someone(robot, (0.8, 0.5, 0.9)))
    grid = np.stack(
        np.meshgrid(np.linspace(0, 0.5, 6), np.linspace(-0.4, 0.4, 9), np.linspace(-0.4, 0.35, 8)), -1
    )
    points = grid.reshape(-1, 3)
    assert body.place(points * MIRROR) == pytest.approx(body.place(points) * MIRROR, abs=1e-9)
    step = 1e-4
    moved = [body.place(points + step * axis) - body.place(points - step * axis) for axis in np.eye(3)]
    assert np.linalg.det(np.stack(moved, axis=2) / (2.0 * step)).min() > 0.1


def test_far_from_the_body_lengths_grow_with_the_arms_and_stretched_arms_stay_stretched(robot):
    person, body = map_of(robot, someone(robot, (0.7, 0.5, 0.7)))
    chain = ArmKinematics(robot)
    before = np.array([[0.6, 0.0, -0.1], [0.7, 0.0, -0.1]])
    moved = np.diff(body.place(before), axis=0)[0]
    assert moved[0] == pytest.approx(0.1 * chain.reach / person.arm, rel=0.03)
    aside = body.place(np.array([[0.0, -person.shoulder - person.arm, 0.0]]))[0]
    assert aside[1] == pytest.approx(chain.shoulder[1] - chain.reach, abs=0.01)
    # Crown, shoulders and waist keep their heights, and hands that hang still hang.
    shoulders, crown = body.shoulder_height, find_place(robot.humanoid, "head_top").point[2]
    heights = (person.places["head_top"][2], 0.0, -0.7 * person.trunk, -person.arm)
    found = body.place(np.array([(0.9, 0.0, height) for height in heights]))[:, 2]
    assert found == pytest.approx([crown, shoulders, 0.3 * shoulders, shoulders - chain.reach], abs=0.005)


def test_what_is_at_the_head_goes_with_it_and_what_is_far_does_not(robot):
    body_points, left, right, face = keypoints(robot, JOINTS, np.zeros((3, len(JOINTS))))
    # At last 80 deg to the left, farther than TEO's head turns, in half a second.
    turn_head(body_points, face, Rotation.from_euler("z", [[0.0], [0.0], [80.0]], degrees=True).as_matrix())
    track = track_of(0.5 * np.arange(3), (body_points, left, right, face))
    person, body = map_of(robot, track)
    head = follow_head(robot, head_pose(track, person.head_shape), person)
    shoulders = np.array([0.0, 0.0, 0.4982])
    chin, far = face[:, 8] - shoulders, np.tile((0.5, -0.3, -0.1), (3, 1))
    placed = body.place_with_head(np.stack([chin, far], axis=1), head)
    pivot = head.pivot
    turned = head.robot_turns[2] @ (placed[0, 0] - pivot) + pivot
    assert np.degrees(np.arctan2(head.robot_turns[2][1, 0], head.robot_turns[2][0, 0])) == pytest.approx(60.0)
    assert placed[2, 0] == pytest.approx(turned, abs=0.005)
    assert placed[2, 1] == pytest.approx(placed[0, 1], abs=1e-9)
