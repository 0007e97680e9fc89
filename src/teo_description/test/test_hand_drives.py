# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from teo_description import DescriptionError
from teo_description.hand_setpoints import hand_setpoints
from teo_description.humanoid import load_humanoid
from teo_names import ALL_JOINTS, BODY_JOINTS, LEFT_HAND, RIGHT_HAND, joint_limits, urdf_text


@pytest.mark.parametrize(
    ("drive", "rpm"),
    # The spool without load: the rows of the data sheet that are nearest, and 450 rpm of a 75.81:1 gearbox.
    [
        ("spool_380", 45.0 * 297.92 / 379.17),
        ("spool_1000", 13.0 * 986.41 / 968.41),
        ("spool_380_high_power", 450.0 * 75.81 / 379.17),
        ("spool_1000_high_power", 450.0 * 75.81 / 968.41),
    ],
)
def test_a_finger_at_its_limit_winds_its_tendon_as_fast_as_the_loaded_spool(drive, rpm):
    names = LEFT_HAND + RIGHT_HAND
    pose = joint_limits(names, hand_drive=drive)
    middle = (pose.lower + pose.upper) / 2.0
    step = 1e-3
    teo = load_humanoid("teo")
    wound = hand_setpoints(teo, middle + step * pose.velocity) - hand_setpoints(teo, middle)
    spool = rpm / 60.0 * 2.0 * math.pi * 4.5
    for side in (0, 6):
        assert wound[side + 2 : side + 6] / step == pytest.approx(34.0 / 45.0 * spool, rel=1e-6)
        # The thumb's tendon is never wound faster than its own motor can.
        assert wound[side + 1] / step <= 34.0 / 45.0 * spool * (1.0 + 1e-9)


@pytest.mark.parametrize(("drive", "ratio"), [("spool_380", 379.17), ("spool_1000", 968.41)])
def test_hands_accelerate_as_their_motors_do_on_the_way_to_the_loaded_speed(drive, ratio):
    teo = load_humanoid("teo")
    finger = teo.file.controllers.servos.hand
    # 12 N of the 50 with which the motor stalls pull the spring and the finger; 7 rad/s^2 are the body's.
    mean = (1.0 - 12.0 / 50.0) * finger.torque / finger.inertia * (379.17 / ratio) / 2.0
    hands = teo.quickness(drive)[teo.columns(LEFT_HAND + RIGHT_HAND)]
    assert (hands * 7.0 <= 1.05 * mean).all()
    assert (hands * 7.0 >= 0.9 * mean).all()
    assert (np.delete(teo.quickness(drive), teo.columns(LEFT_HAND + RIGHT_HAND)) == 1.0).all()


@pytest.mark.parametrize("drive", load_humanoid("teo").hand_drives)
def test_a_drive_changes_the_speed_of_the_hands_alone_and_no_axis_outruns_fingers_and_body(drive):
    usual, limits = joint_limits(ALL_JOINTS), joint_limits(ALL_JOINTS, hand_drive=drive)
    assert np.array_equal(usual.lower, limits.lower)
    assert np.array_equal(usual.upper, limits.upper)
    body = joint_limits(BODY_JOINTS, hand_drive=drive).velocity
    assert np.array_equal(body, joint_limits(BODY_JOINTS).velocity)
    fingers = joint_limits(("RightIndexFinger",), hand_drive=drive).velocity[0]
    assert limits.velocity.max() == pytest.approx(max(fingers, body.max()))


def test_a_description_with_another_drive_differs_in_velocities_alone():
    def bare(text: str) -> str:
        return ET.canonicalize(text, strip_text=True, exclude_attrs=["velocity"])

    other = urdf_text("spool_1000")
    assert other != urdf_text()
    assert bare(other) == bare(urdf_text())


def test_phalanges_that_follow_a_joint_are_as_fast_as_they_are_led():
    joints = {joint.attrib["name"]: joint for joint in ET.fromstring(urdf_text("spool_1000")).iter("joint")}
    for joint in joints.values():
        mimic = joint.find("mimic")
        if mimic is not None:
            leader = float(joints[mimic.attrib["joint"]].find("limit").attrib["velocity"])
            share = abs(float(mimic.attrib["multiplier"]))
            assert float(joint.find("limit").attrib["velocity"]) == pytest.approx(leader * share)


def test_an_unknown_drive_is_refused_with_those_that_there_are():
    with pytest.raises(DescriptionError, match="spool_380, spool_380_high_power, spool_1000") as caught:
        joint_limits(hand_drive="spool_300")
    assert caught.value.code == "unknown_hand_drive"
