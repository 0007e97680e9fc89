# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The real robot's topics, against what its repositories say of them."""

import math

import numpy as np
import pytest

from teo_description.humanoid import load_humanoid
from teo_names import COMMANDED_JOINTS, HOME
from teo_sim_driver.position_direct import position_direct

# axesNames of wholeBody.ini of teo-configuration-files, and of the Dextra's Synapse.cpp, board by board.
BOARDS = {
    "/teo/head/position_direct": "AxialNeck FrontalNeck",
    "/teo/trunk/position_direct": "AxialTrunk FrontalTrunk",
    "/teo/leftArm/position_direct": "FrontalLeftShoulder SagittalLeftShoulder AxialLeftShoulder "
    "FrontalLeftElbow AxialLeftWrist FrontalLeftWrist",
    "/teo/rightArm/position_direct": "FrontalRightShoulder SagittalRightShoulder AxialRightShoulder "
    "FrontalRightElbow AxialRightWrist FrontalRightWrist",
    "/teo/leftHand/position_direct": "LeftHandAbductor LeftThumbFinger LeftIndexFinger LeftMiddleFinger "
    "LeftRingFinger LeftPinkyFinger",
    "/teo/rightHand/position_direct": "RightHandAbductor RightThumbFinger RightIndexFinger "
    "RightMiddleFinger RightRingFinger RightPinkyFinger",
}


def told(**angles):
    """What the boards are told at HOME but for some joints [rad]."""
    positions = np.array([{**HOME, **angles}[name] for name in COMMANDED_JOINTS])
    return {each.topic: each for each in position_direct(load_humanoid("teo"), positions)}


def as_the_board_hears(message, joint):
    """controlBoard_nws_ros2 makes degrees of every axis that calls itself revolute."""
    return math.degrees(message.positions[message.names.index(joint)])


def test_every_board_is_told_of_its_axes_in_its_order():
    assert {topic: " ".join(each.names) for topic, each in told().items()} == BOARDS


@pytest.mark.parametrize(
    ("board", "joint", "degrees", "heard"),
    [
        # The arm of "hello" and the trunk, as the robot was told them in degrees.
        ("rightArm", "FrontalRightShoulder", -56.0, -56.0),
        ("trunk", "FrontalTrunk", 10.0, 10.0),
        # Millimetres of tendon, of which all are wound or half, and degrees of the servo.
        ("rightHand", "RightIndexFinger", 85.0, 20.0),
        ("rightHand", "RightThumbFinger", 0.0, 5.0),
        ("rightHand", "RightHandAbductor", 90.0, 90.0),
    ],
)
def test_a_board_hears_degrees_and_millimetres_of_tendon(board, joint, degrees, heard):
    message = told(**{joint: math.radians(degrees)})[f"/teo/{board}/position_direct"]
    assert as_the_board_hears(message, joint) == pytest.approx(heard, abs=1e-9)
