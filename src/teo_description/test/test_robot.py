# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import re

import numpy as np
import pytest

from teo_description import DescriptionError
from teo_names import HOME, RIGHT_ARM, RIGHT_HAND


def test_joints_not_named_are_at_home(robot):
    assert np.array_equal(robot.configuration({}), robot.configuration(HOME))


@pytest.mark.parametrize(
    ("ask", "arguments", "code", "said"),
    [
        ("configuration", [{"Elbow": 0.1}], "unknown_joint", "Elbow"),
        ("configuration", [{"RightIndexFingerDistal": 0.1}], "unknown_joint", "RightIndexFingerDistal"),
        ("configuration", [{"AxialNeck": math.nan}], "not_finite", "AxialNeck"),
        ("configuration", [{"AxialNeck": -math.inf}], "not_finite", "AxialNeck"),
        ("jacobian", [np.zeros(58), "right_palm", ["Shoulder"]], "unknown_joint", "Shoulder"),
        ("placement", [np.zeros(58), "palm"], "unknown_frame", "right_palm"),
        ("placement", [np.zeros(40), "right_palm"], "wrong_shape", "(58,)"),
        ("placement", [np.zeros((58, 1)), "right_palm"], "wrong_shape", "(58,)"),
    ],
)
def test_what_is_no_posture_or_frame_of_the_robot_is_refused_by_name(robot, ask, arguments, code, said):
    with pytest.raises(DescriptionError, match=re.escape(said)) as caught:
        getattr(robot, ask)(*arguments)
    assert caught.value.code == code


def test_a_placement_stays_as_it_was_when_the_robot_moves_on(robot):
    before = robot.placement(robot.configuration({}), "right_palm")
    copy = before.copy()
    robot.placement(robot.configuration({"FrontalRightElbow": -1.0}), "right_palm")
    assert np.array_equal(before, copy)


@pytest.mark.parametrize("frame", ["right_palm", "RightIndexFingerTip", "RightThumbFingerTip"])
def test_jacobian_is_the_derivative_of_the_placement(robot, random_positions, frame):
    joints = ("AxialTrunk", "FrontalTrunk", *RIGHT_ARM, *RIGHT_HAND, "FrontalLeftElbow")
    step = 1e-6
    for _ in range(5):
        positions = random_positions()
        jacobian = robot.jacobian(robot.configuration(positions), frame, joints)
        assert jacobian.shape == (6, len(joints))
        for column, name in enumerate(joints):
            ends = [
                robot.placement(
                    robot.configuration({**positions, name: positions[name] + sign * step}), frame
                )
                for sign in (1, -1)
            ]
            slope = (ends[0] - ends[1]) / (2 * step)
            turning = slope[:3, :3] @ ((ends[0] + ends[1]) / 2)[:3, :3].T
            assert jacobian[:3, column] == pytest.approx(slope[:3, 3], abs=1e-7)
            assert jacobian[3:, column] == pytest.approx(
                [turning[2, 1], turning[0, 2], turning[1, 0]], abs=1e-7
            )


def test_camera_looks_forward_from_the_head(robot):
    optical = robot.placement(robot.configuration({}), "camera_optical_frame")
    assert optical[:3, 2] == pytest.approx([1, 0, 0], abs=1e-9)
    assert optical[:3, 1] == pytest.approx([0, 0, -1], abs=1e-9)
