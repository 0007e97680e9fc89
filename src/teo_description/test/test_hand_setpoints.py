# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from teo_description import DescriptionError
from teo_description.hand_setpoints import hand_setpoints, setpoint_axes
from teo_description.humanoid import load_humanoid
from teo_names import HOME, LEFT_HAND, RIGHT_HAND, joint_limits

HANDS = LEFT_HAND + RIGHT_HAND
TEO = load_humanoid("teo")
LEFT_AXES, RIGHT_AXES = setpoint_axes(TEO, "left"), setpoint_axes(TEO, "right")
HOME_SETPOINTS = [0.0, 10.0 / 3.0, 0.0, 0.0, 0.0, 0.0]  # abductor, thumb, fingers


def test_the_letter_t_of_teos_own_demonstration_comes_back():
    letter_t = [57.3, 5.4, 14.9, 4.7, 1.5, 0.0]  # deg, then mm
    angles = [axis.angle(value) for axis, value in zip(RIGHT_AXES, letter_t, strict=True)]
    everything = np.array([HOME[name] for name in LEFT_HAND] + angles)
    np.testing.assert_allclose(hand_setpoints(TEO, everything), HOME_SETPOINTS + letter_t, atol=1e-9)


def test_the_joint_limits_are_the_ends_of_the_devices_ranges():
    limits = joint_limits(HANDS)
    np.testing.assert_allclose(hand_setpoints(TEO, limits.lower), 0.0, atol=1e-9)
    np.testing.assert_allclose(hand_setpoints(TEO, limits.upper), [90.0, 10.0, *[20.0] * 4] * 2, atol=1e-9)


@pytest.mark.parametrize("degrees", [6.9, 85.1, math.nan, math.inf])
def test_an_angle_outside_the_range_is_refused(degrees):
    positions = np.array([HOME[name] for name in HANDS])
    positions[HANDS.index("RightIndexFinger")] = math.radians(degrees)
    with pytest.raises(DescriptionError) as refusal:
        hand_setpoints(TEO, positions)
    assert refusal.value.code == "outside_hand_range"
    assert "RightIndexFinger" in str(refusal.value)


@pytest.mark.parametrize(
    ("joint", "degrees", "setpoint"),
    [
        ("RightPinkyFinger", 46.0, 10.0),
        ("LeftThumbFinger", 0.0, 5.0),
        ("RightThumbFinger", 7.2, 5.4),
        ("LeftHandAbductor", 57.3, 57.3),
    ],
)
def test_an_angle_is_a_tendon_travel_or_a_servo_angle(joint, degrees, setpoint):
    axis = next(axis for axis in LEFT_AXES + RIGHT_AXES if axis.joint == joint)
    assert axis.setpoint(math.radians(degrees)) == pytest.approx(setpoint, abs=1e-9)
    assert math.degrees(axis.angle(setpoint)) == pytest.approx(degrees)


@pytest.mark.parametrize("millimetres", [-0.1, 20.1, math.nan])
def test_a_setpoint_outside_the_range_is_refused(millimetres):
    with pytest.raises(DescriptionError, match="RightIndexFinger") as refusal:
        RIGHT_AXES[2].angle(millimetres)
    assert refusal.value.code == "outside_hand_range"
