# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The URDF against the Denavit-Hartenberg chains that TEO's own Cartesian controller uses.

The rows below are those of teo-configuration-files, share/contexts/kinematics (trunk, arms, head, legs):
standard (distal) convention, metres and degrees. Nothing here comes from the package under test.
"""

from __future__ import annotations

import numpy as np
import pytest

TRUNK = [(0, 0.1932, 0, -90), (-90, 0, 0, 0)]  # joint offset, D, A, alpha
ARM = [
    (0, 0, 0, -90),
    (-90, 0, 0, -90),
    (-90, -0.32901, 0, -90),
    (0, 0, 0, 90),
    (0, -0.215, 0, -90),
    (-90, 0, -0.09, 0),
]
HEAD_TRUNK = [(0, 0.1932, 0, -90), (0, 0, 0, 90)]
HEAD = [(0, 0.4675, 0, -90), (0, 0, 0, 90)]
SHIN = {"Left": -0.0175, "Right": 0.0175}

ARM_JOINTS = [
    "Frontal{}Shoulder",
    "Sagittal{}Shoulder",
    "Axial{}Shoulder",
    "Frontal{}Elbow",
    "Axial{}Wrist",
    "Frontal{}Wrist",
]
LEG_JOINTS = [
    "Axial{}Hip",
    "Sagittal{}Hip",
    "Frontal{}Hip",
    "Frontal{}Knee",
    "Frontal{}Ankle",
    "Sagittal{}Ankle",
]

POSES = 100
TOLERANCE = 1e-9  # [m]


def link(angle, offset, d, a, alpha):
    theta, alpha = angle + np.radians(offset), np.radians(alpha)
    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d], [0, 0, 0, 1]]
    )


def chain(rows, angles):
    pose = np.eye(4)
    for row, angle in zip(rows, angles, strict=True):
        pose = pose @ link(angle, *row)
    return pose


def arm_chain(positions, side):
    shoulder = np.eye(4)
    shoulder[:3, 3] = 0.305, 0.0, 0.34692 if side == "Left" else -0.34692
    trunk = chain(TRUNK, [positions["AxialTrunk"], positions["FrontalTrunk"]])
    return trunk @ shoulder @ chain(ARM, [positions[name.format(side)] for name in ARM_JOINTS])


def head_chain(positions):
    trunk = chain(HEAD_TRUNK, [positions["AxialTrunk"], positions["FrontalTrunk"]])
    return trunk @ chain(HEAD, [positions["AxialNeck"], positions["FrontalNeck"]])


def leg_chain(positions, side):
    sign = 1 if side == "Left" else -1
    hip = np.array([[0, -1, 0, 0], [1, 0, 0, sign * 0.146], [0, 0, 1, -0.092], [0, 0, 0, 1]])
    rows = [
        (0, 0, 0, 90),
        (90, 0, 0, 90),
        (0, 0, -0.33, 0),
        (0, SHIN[side], -0.3, 0),
        (0, 0, 0, -90),
        (0, 0, -0.123005, 0),
    ]
    return hip @ chain(rows, [positions[name.format(side)] for name in LEG_JOINTS])


CHAINS = {
    "left arm to the sensor plate": ("left_sensor_plate", lambda positions: arm_chain(positions, "Left")),
    "right arm to the sensor plate": ("right_sensor_plate", lambda positions: arm_chain(positions, "Right")),
    "head": ("FrontalNeck_link", head_chain),
    "left leg to the sole": ("left_sole", lambda positions: leg_chain(positions, "Left")),
    "right leg to the sole": ("right_sole", lambda positions: leg_chain(positions, "Right")),
}


@pytest.mark.parametrize("name", CHAINS)
def test_urdf_places_each_chain_where_the_published_chain_does(robot, random_positions, name):
    frame, published = CHAINS[name]
    turn = None
    for _ in range(POSES):
        positions = random_positions()
        ours, theirs = robot.placement(robot.configuration(positions), frame), published(positions)
        assert ours[:3, 3] == pytest.approx(theirs[:3, 3], abs=TOLERANCE)
        # Their last frame is turned against ours by the same rotation at every pose.
        difference = ours[:3, :3].T @ theirs[:3, :3]
        turn = difference if turn is None else turn
        assert difference == pytest.approx(turn, abs=TOLERANCE)


def test_shoulders_and_soles_are_where_the_published_lengths_put_them_at_home(robot):
    q = robot.configuration({})
    assert robot.placement(q, "SagittalRightShoulder_link")[:3, 3] == pytest.approx([0, -0.34692, 0.4982])
    # The Lacquey tool point of the configuration files, 97.5 mm beyond the plate, is at z = -0.2333.
    assert robot.placement(q, "right_sensor_plate")[2, 3] - 0.0975 == pytest.approx(-0.2333, abs=1e-4)
    assert robot.placement(q, "left_sole")[2, 3] == pytest.approx(-0.845, abs=1e-4)
