# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joints with mass: they follow, carry what Pinocchio says they carry, and push what is in their way."""

import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin
import pytest

from teo_description.humanoid import load_humanoid
from teo_names import BODY_JOINTS, COMMANDED_JOINTS, urdf_text
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.plants.physics import PhysicsPlant

BODY = len(BODY_JOINTS)


@pytest.fixture
def plant():
    return PhysicsPlant(load_humanoid("teo"))


def go(plant, home, goal, seconds=2.0, rest=0.5):
    """Drive joints along a smooth step and let them settle; returns the greatest error of the body [rad]."""
    target = home.copy()
    for name, angle in goal.items():
        target[COMMANDED_JOINTS.index(name)] = angle
    errors = []
    for s in np.linspace(0.0, 1.0, round(seconds * 100))[1:]:
        place = 10 * s**3 - 15 * s**4 + 6 * s**5
        speed = (30 * s**2 - 60 * s**3 + 30 * s**4) / seconds
        asked = MotionState(home + place * (target - home), speed * (target - home), np.zeros_like(home))
        errors.append(np.abs(plant.step(asked, 0.01).positions - asked.positions)[:BODY].max())
    for _ in range(round(rest * 100)):
        plant.step(MotionState.at_rest(target), 0.01)
    return max(errors), target


def test_it_stands_at_home_and_touches_nothing(plant, home):
    for _ in range(100):
        state = plant.step(MotionState.at_rest(home), 0.01)
    assert np.abs(state.positions - home).max() < 1e-3
    assert not plant.contacts()


def test_raised_arms_are_followed_and_carried_as_pinocchio_says(plant, home):
    goal = {
        "FrontalLeftShoulder": -1.0,
        "SagittalLeftShoulder": 0.4,
        "FrontalLeftElbow": -1.0,
        "FrontalTrunk": 0.2,
        "FrontalRightElbow": -1.2,
    }
    error, _ = go(plant, home, goal)
    assert error < 0.02
    model = pin.buildModelFromXML(urdf_text())
    posture = pin.neutral(model)
    for name, angle in zip(COMMANDED_JOINTS, plant.positions, strict=True):
        posture[model.joints[model.getJointId(name)].idx_q] = angle
    weight = pin.computeGeneralizedGravity(model, model.createData(), posture)
    carried = np.array([weight[model.joints[model.getJointId(name)].idx_v] for name in BODY_JOINTS])
    assert np.abs(carried).max() > 10.0
    # Dry friction carries its share, 0.7 N m in the URDF.
    np.testing.assert_allclose(plant.torques[:BODY], carried, atol=0.75)


def test_phalanges_follow_their_tendon(plant, home):
    go(plant, home, {"LeftIndexFinger": 1.0, "RightThumbFinger": 0.3})
    angles = {plant._model.joint(i).name: plant._data.qpos[plant._model.jnt_qposadr[i]] for i in range(58)}
    for joint in ET.fromstring(urdf_text()).iter("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            driven = angles[mimic.get("joint")]
            told = float(mimic.get("multiplier")) * driven + float(mimic.get("offset"))
            assert abs(angles[joint.get("name")] - told) < 0.01
    assert angles["LeftIndexFinger"] == pytest.approx(1.0, abs=0.01)


def test_arms_that_are_driven_into_each_other_push_and_are_kept_back(plant, home):
    inward = {
        "FrontalLeftElbow": -1.5,
        "FrontalRightElbow": -1.5,
        "AxialLeftShoulder": -0.88,
        "AxialRightShoulder": 0.97,
    }
    _, target = go(plant, home, inward)
    contact = max(plant.contacts(), key=lambda each: each.force)
    assert {"Left" in contact.first, "Left" in contact.second} == {True, False}
    assert contact.force > 5.0
    assert np.abs(plant.positions - target)[:BODY].max() > 0.02


def test_a_hand_says_what_it_was_told_as_the_real_one_does(plant, home):
    thumb = {"RightHandAbductor": 1.4, "RightThumbFinger": 1.4, "RightIndexFinger": 1.4}
    _, target = go(plant, home, thumb)
    assert plant.step(MotionState.at_rest(target), 0.01).positions[BODY:].tolist() == target[BODY:].tolist()
    assert np.abs(plant.torques[BODY:]).max() <= 0.73 + 1e-9
