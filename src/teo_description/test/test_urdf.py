# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from teo_description.humanoid import urdf_hash
from teo_names import (
    ALL_JOINTS,
    HOME,
    LEFT_HAND,
    RIGHT_HAND,
    description_hash,
    joint_limits,
    urdf_text,
)

# Position limits [deg] of teo-configuration-files, share/robots/teo/nodes, typed once more.
PUBLISHED = {
    "AxialNeck": (-60.0, 60.0),
    "FrontalNeck": (-10.0, 10.0),
    "AxialTrunk": (-59.3, 46.3),
    "FrontalTrunk": (-10.1, 90.4),
    "FrontalLeftShoulder": (-96.8, 113.2),
    "SagittalLeftShoulder": (-23.9, 76.5),
    "AxialLeftShoulder": (-51.6, 84.1),
    "FrontalLeftElbow": (-101.1, 96.8),
    "AxialLeftWrist": (-101.3, 76.4),
    "FrontalLeftWrist": (-113.3, 61.3),
    "FrontalRightShoulder": (-98.1, 106.0),
    "SagittalRightShoulder": (-75.5, 22.4),
    "AxialRightShoulder": (-80.1, 57.0),
    "FrontalRightElbow": (-99.6, 98.4),
    "AxialRightWrist": (-80.4, 99.6),
    "FrontalRightWrist": (-115.1, 44.7),
    "AxialLeftHip": (-27.9, 32.8),
    "SagittalLeftHip": (-12.5, 14.2),
    "FrontalLeftHip": (-31.6, 42.3),
    "FrontalLeftKnee": (-61.3, 82.4),
    "FrontalLeftAnkle": (-23.1, 25.4),
    "SagittalLeftAnkle": (-42.5, 19.9),
    "AxialRightHip": (-32.8, 27.9),
    "SagittalRightHip": (-14.2, 12.5),
    "FrontalRightHip": (-31.6, 42.3),
    "FrontalRightKnee": (-61.3, 82.4),
    "FrontalRightAnkle": (-23.1, 25.4),
    "SagittalRightAnkle": (-19.9, 42.5),
}
# dextra-yarp-devices, share/gz-sim/models/dextra_right/dextra_right.sdf, flexion positive.
HAND = {"HandAbductor": (0.0, 90.0), "ThumbFinger": (-90.0, 90.0)} | {
    f"{finger}Finger": (7.0, 85.0) for finger in ("Index", "Middle", "Ring", "Pinky")
}
PUBLISHED |= {side + name: limits for side in ("Left", "Right") for name, limits in HAND.items()}

BODY_MASS = 55.90  # [kg] teo-developer-manual, "55900 g"
LACQUEY_HANDS = 2 * (1.17 - 0.72)  # [kg] in the manual's wrists, not on this robot
DEXTRA_HANDS = 2 * (0.3 + 15 * 0.1)  # [kg] dextra-yarp-devices' placeholders


@pytest.fixture(scope="module")
def tree():
    return ET.fromstring(urdf_text())


def test_limits_are_the_published_ones():
    limits = joint_limits(ALL_JOINTS)
    expected = np.radians([PUBLISHED[name] for name in ALL_JOINTS])
    assert limits.names == ALL_JOINTS
    assert np.array_equal(limits.lower, expected[:, 0])
    assert np.array_equal(limits.upper, expected[:, 1])
    body = np.array([name not in LEFT_HAND + RIGHT_HAND for name in ALL_JOINTS])
    assert np.array_equal(limits.velocity[body], np.full(28, math.radians(50.0)))


def test_limits_come_in_the_order_asked_for_and_cannot_be_changed():
    limits = joint_limits(("FrontalNeck", "AxialNeck"))
    assert limits.upper == pytest.approx(np.radians([10.0, 60.0]))
    with pytest.raises(ValueError, match="read-only"):
        limits.upper[0] = 3.0
    assert joint_limits(()).lower.shape == (0,)


def test_home_is_within_limits_and_names_every_joint():
    limits = joint_limits(ALL_JOINTS)
    home = np.array([HOME[name] for name in ALL_JOINTS])
    assert len(HOME) == 40
    assert (limits.lower <= home).all()
    assert (home <= limits.upper).all()
    fingers = {name for name in ALL_JOINTS if name.endswith("Finger") and "Thumb" not in name}
    assert {HOME[name] for name in fingers} == {math.radians(7.0)}
    thumbs = {"LeftThumbFinger", "RightThumbFinger"}
    assert {HOME[name] for name in thumbs} == {math.radians(-30.0)}
    assert {HOME[name] for name in set(ALL_JOINTS) - fingers - thumbs} == {0.0}


def test_every_joint_of_the_state_is_in_the_urdf_and_only_phalanges_follow(tree):
    moving = [joint for joint in tree.iter("joint") if joint.attrib["type"] == "revolute"]
    led = {joint.attrib["name"]: joint.find("mimic") for joint in moving}
    assert {name for name, mimic in led.items() if mimic is None} == set(ALL_JOINTS)
    following = {name: mimic.attrib for name, mimic in led.items() if mimic is not None}
    assert len(following) == 18
    for name, mimic in following.items():
        assert name.removesuffix("Distal").removesuffix("Middle") == mimic["joint"]
        thumb = (78.0 / 180.0, math.radians(46.0))
        expected = thumb if "Thumb" in name else (1.0, 0.0)
        assert (float(mimic["multiplier"]), float(mimic["offset"])) == pytest.approx(expected, abs=1e-12)


def test_robot_weighs_what_the_manual_says_with_its_hands_exchanged(robot):
    mass = sum(inertia.mass for inertia in robot.model.inertias)
    assert mass == pytest.approx(BODY_MASS - LACQUEY_HANDS + DEXTRA_HANDS, abs=1e-4)


def test_every_inertia_is_that_of_a_possible_body(tree):
    checked = 0
    for link in tree.iter("link"):
        inertial = link.find("inertial")
        if inertial is None:
            continue
        xx, yy, zz, xy, xz, yz = (
            float(inertial.find("inertia").attrib[key]) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        )
        small, middle, large = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        assert small > 0.0, link.attrib["name"]
        assert large <= (small + middle) * (1 + 1e-9), link.attrib["name"]
        assert float(inertial.find("mass").attrib["value"]) > 0.0
        checked += 1
    assert checked == 29 + 2 * 16


def test_shapes_are_primitives_only(tree):
    kinds = {shape.tag for geometry in tree.iter("geometry") for shape in geometry}
    assert kinds == {"box", "cylinder", "sphere"}


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ('velocity="0.87', 'velocity="0.97', True),
        ('effort="30"', 'effort="40"', True),
        ("Units: m, rad", "Units: metre, rad", True),
        ('lower="-1.0471975511965976"', 'lower="-1.0471975511965977"', False),
        ('axis xyz="0 0 1"', 'axis xyz="0 0 -1"', False),
        ('box size="0.1', 'box size="0.2', False),
    ],
)
def test_hash_names_what_joint_angles_are_made_for(old, new, same):
    changed = urdf_text().replace(old, new, 1)
    assert changed != urdf_text()
    assert (urdf_hash(changed) == description_hash()) is same
