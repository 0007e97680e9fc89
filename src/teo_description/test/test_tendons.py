# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from teo_description import DescriptionError
from teo_description.teo.tendons import LEFT_AXES, RIGHT_AXES
from teo_names import LEFT_HAND, RIGHT_HAND, joint_limits


@pytest.mark.parametrize(
    ("joint", "degrees", "setpoint"),
    [
        ("LeftIndexFinger", 7.0, 0.0),
        ("LeftIndexFinger", 85.0, 20.0),
        ("RightPinkyFinger", 46.0, 10.0),
        ("RightThumbFinger", -90.0, 0.0),
        ("LeftThumbFinger", 0.0, 5.0),
        ("RightThumbFinger", 7.2, 5.4),
        ("RightThumbFinger", 90.0, 10.0),
        ("LeftHandAbductor", 0.0, 0.0),
        ("LeftHandAbductor", 57.3, 57.3),
        ("RightHandAbductor", 90.0, 90.0),
    ],
)
def test_an_angle_is_a_tendon_travel_or_a_servo_angle(joint, degrees, setpoint):
    axis = next(axis for axis in LEFT_AXES + RIGHT_AXES if axis.joint == joint)
    assert axis.setpoint(math.radians(degrees)) == pytest.approx(setpoint, abs=1e-9)
    assert math.degrees(axis.angle(setpoint)) == pytest.approx(degrees)


def test_the_joint_limits_are_the_ends_of_the_devices_ranges():
    for joints, axes in ((LEFT_HAND, LEFT_AXES), (RIGHT_HAND, RIGHT_AXES)):
        limits = joint_limits(joints)
        assert tuple(axis.joint for axis in axes) == joints
        np.testing.assert_allclose([axis.angle(0.0) for axis in axes], limits.lower)
        np.testing.assert_allclose([axis.angle(axis.travel) for axis in axes], limits.upper)


@pytest.mark.parametrize("degrees", [6.9, 85.1, math.nan, math.inf])
def test_an_angle_outside_the_range_is_refused(degrees):
    with pytest.raises(DescriptionError, match="RightIndexFinger") as refusal:
        RIGHT_AXES[2].setpoint(math.radians(degrees))
    assert refusal.value.code == "outside_hand_range"


@pytest.mark.parametrize("millimetres", [-0.1, 20.1, math.nan])
def test_a_setpoint_outside_the_range_is_refused(millimetres):
    with pytest.raises(DescriptionError, match="RightIndexFinger") as refusal:
        RIGHT_AXES[2].angle(millimetres)
    assert refusal.value.code == "outside_hand_range"
