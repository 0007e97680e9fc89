# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What holds of every robot that is shipped, over random postures of each."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from teo_description.errors import DescriptionError
from teo_description.hand_geometry import HandGeometry, hand_table, thumb_gaps
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot

MIRROR = np.array([1.0, -1.0, 1.0])


@pytest.fixture(scope="module", params=["teo", "gr1t2", "g1"])
def robot(request):
    try:
        return Robot.load(request.param)
    except DescriptionError as error:
        if error.code != "robot_package_missing":
            raise
        pytest.skip(str(error))


@pytest.fixture
def postures(robot):
    """Twenty postures of the commanded joints, uniform within their limits."""
    limits = robot.humanoid.limits()
    return np.random.default_rng(8).uniform(limits.lower, limits.upper, (20, len(limits.names)))


def test_a_mirrored_posture_is_the_mirror_image_and_twice_the_same(robot, postures):
    humanoid, frames = robot.humanoid, robot.humanoid.file.hand.frames
    names = humanoid.commanded_joints
    once = [humanoid.mirrored_name(name) for name in names]
    assert tuple(humanoid.mirrored_name(name) for name in once) == names
    signs = humanoid.mirror_signs(names)
    assert (signs * humanoid.mirror_signs(once) == 1.0).all()
    others = [humanoid.mirrored_name(frame) for frame in frames]
    for row in postures:
        image = dict(zip(once, (row * signs).tolist(), strict=True))
        here = robot.placements(robot.configurations(row), frames)[:, :3, 3]
        there = robot.placements(robot.configuration(image), others)[:, :3, 3]
        # A millimetre and a half: what the makers' own figures of the left and right arm differ by.
        np.testing.assert_allclose(there, here * MIRROR, atol=1.5e-3)


def test_the_hands_frames_keep_their_distances_whatever_the_arm_does(robot, postures):
    """Palm and knuckles are one rigid body: a frame on the wrong link would move against it."""
    hand = robot.humanoid.file.hand
    frames = [hand.palm, *(row[0] for row in hand.fingers.values())]
    palms = robot.placements(robot.configuration({}), frames)[:, :3, 3]
    apart = np.linalg.norm(palms - palms[0], axis=1)
    for row in postures:
        points = robot.placements(robot.configurations(row), frames)[:, :3, 3]
        np.testing.assert_allclose(np.linalg.norm(points - points[0], axis=1), apart, atol=1e-9)


def test_phalanges_are_as_long_at_every_flexion(robot, postures):
    hand = HandGeometry(robot)
    columns = robot.humanoid.columns(hand.joints)
    for row in postures:
        points = hand.points(row[columns]).fingers
        np.testing.assert_allclose(np.linalg.norm(np.diff(points, axis=1), axis=2), hand.phalanges, atol=1e-8)


def test_the_table_of_a_hand_is_its_forward_kinematics(robot, postures):
    table = hand_table(robot)
    hands = postures[:, robot.humanoid.columns(table.hand.joints)]
    fingers = table.finger_points(hands[:, 2:])
    thumbs = table.thumb_points(hands[:, 0], hands[:, 1])
    for row, finger, thumb in zip(hands, fingers, thumbs, strict=True):
        points = table.hand.points(row)
        np.testing.assert_allclose(finger, points.fingers, atol=2e-4)
        np.testing.assert_allclose(thumb, points.thumb, atol=2e-4)
    gaps = thumb_gaps(table, hands)
    assert gaps.shape == (len(hands),)
    assert np.isfinite(gaps).all()


def test_nothing_touches_at_home_and_while_waiting(robot):
    humanoid = robot.humanoid
    for posture in (humanoid.hanging, humanoid.ready):
        assert robot.clearance(robot.configurations(posture)).distance > 0.01


def test_a_hand_in_the_chest_is_seen(robot):
    """The shapes are where the meshes are: a palm brought to the middle of the trunk overlaps it."""
    humanoid = robot.humanoid
    chest = np.array(humanoid.file.places["chest"].point) - [0.06, 0.0, 0.0]
    arm, limits = humanoid.arm("right"), humanoid.limits(humanoid.arm("right"))
    q, palm = {}, humanoid.file.hand.palm
    values = humanoid.ready[humanoid.columns(arm)].copy()
    for _ in range(100):
        q = dict(zip(arm, values.tolist(), strict=True))
        off = robot.placement(robot.configuration(q), palm)[:3, 3] - chest
        jacobian = robot.jacobian(robot.configuration(q), palm, arm)[:3]
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-3 * np.eye(3), off)
        values = np.clip(values - step, limits.lower, limits.upper)
    assert np.linalg.norm(off) < 0.05
    assert robot.clearance(robot.configuration(q)).distance < -0.01


def test_the_hash_is_the_same_in_every_process_and_of_each_robot_alone():
    names = ("teo", "gr1t2")
    load = "from teo_description.humanoid import load_humanoid as h"
    code = f"{load}; print(*(h(name).description_hash for name in {names}))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, timeout=60)
    hashes = said.stdout.decode().split()
    assert hashes == [load_humanoid(name).description_hash for name in names]
    assert len(set(hashes)) == 2


def test_two_robots_in_one_process_keep_apart():
    teo, other = Robot.load("teo"), Robot.load("gr1t2")
    before = teo.placement(teo.configuration({}), teo.humanoid.file.hand.palm)
    other.clearance(other.configurations(other.humanoid.ready))
    np.testing.assert_array_equal(teo.placement(teo.configuration({}), teo.humanoid.file.hand.palm), before)
    with pytest.raises(DescriptionError, match="expected joints of gr1t2"):
        other.configuration({teo.humanoid.commanded_joints[0]: 0.0})
