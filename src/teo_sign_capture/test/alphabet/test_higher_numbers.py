# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers above ten: what their hands do, and what they are said to rest on."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from teo_description import COMMANDED_JOINTS, HOME, LEFT_ARM, RIGHT_HAND, joint_limits
from teo_description.robot import Robot
from teo_sign_capture.alphabet.higher_numbers import higher_number_signs
from teo_signs.look_up_table import Lut, Sign, default_lut_directory

TABLE = default_lut_directory()
TEENS = tuple(map(str, range(11, 20)))
TENS = ("20", "30", "40", "50", "60", "70", "80", "90", "100")
FINGERS = RIGHT_HAND[2:]


@cache
def sign(gloss: str) -> Sign:
    return Lut.open(TABLE)[gloss]


def columns(one: Sign, joints: tuple[str, ...]) -> np.ndarray:
    return np.degrees(one.knots[:, [one.joints.index(joint) for joint in joints]])


def test_eleven_is_a_one_whose_wrist_shakes() -> None:
    one, eleven = sign("1"), sign("11")
    np.testing.assert_allclose(
        columns(eleven, FINGERS), np.tile(columns(one, FINGERS)[0], (len(eleven.times), 1))
    )
    wrist = columns(eleven, ("FrontalRightWrist",))[:, 0]
    assert np.ptp(wrist) > 5.0
    assert (
        np.sum(np.abs(np.diff(np.sign(np.diff(wrist)[np.diff(wrist) != 0.0]))) > 0.0) == 3
    )  # there and back, twice


@pytest.mark.parametrize("gloss", TEENS[1:])
def test_twelve_to_nineteen_flick_the_straight_fingers_of_their_last_digit_open(gloss: str) -> None:
    digit, number = columns(sign(gloss[1]), FINGERS)[0], columns(sign(gloss), FINGERS)
    np.testing.assert_allclose(number[-1], digit, atol=0.01)
    straight = digit < 10.0
    assert (number[0, straight] > 40.0).all()  # hooked at first
    np.testing.assert_allclose(number[0, ~straight], digit[~straight], atol=0.01)


@pytest.mark.parametrize("gloss", TENS)
def test_tens_are_their_digits_in_order(gloss: str) -> None:
    number = sign(gloss)
    hands = columns(number, RIGHT_HAND)
    held = [hand for hand, after in pairwise(hands) if np.array_equal(hand, after)]
    shown = [hand for index, hand in enumerate(held) if not index or not np.allclose(hand, held[index - 1])]
    expected = [columns(sign(digit), RIGHT_HAND)[0] for digit in gloss[:2]]
    np.testing.assert_allclose(shown, expected, atol=0.01)
    if sign(gloss[0]).handedness == "both":  # its open left hand is no part of 0
        home = [np.degrees(HOME[joint]) for joint in LEFT_ARM]
        np.testing.assert_allclose(columns(number, LEFT_ARM)[-1], home, atol=0.01)
    if gloss == "100":  # two zeros are two
        assert np.ptp(columns(number, ("FrontalRightElbow",))[3:, 0]) > 5.0


def test_only_what_was_seen_stands_above_a_sketch() -> None:
    standings = {gloss: sign(gloss).provenance.standing for gloss in (*TEENS, *TENS)}
    assert {gloss for gloss, standing in standings.items() if standing != "sketched"} == set(TEENS[:4])
    assert all(sign(gloss).provenance.source.startswith("none") for gloss in TENS)


def test_numbers_keep_their_limits_and_clear_of_the_body() -> None:
    robot = Robot.load()
    for gloss in (*TEENS, *TENS):
        one = sign(gloss)
        assert set(one.joints) <= set(COMMANDED_JOINTS)
        limits = joint_limits(one.joints)
        assert (one.knots >= limits.lower - 1e-6).all() and (one.knots <= limits.upper + 1e-6).all()
        for moment in np.linspace(0.0, one.duration, 15):
            pose = {
                joint: np.interp(moment, one.times, values)
                for joint, values in zip(one.joints, one.knots.T, strict=True)
            }
            assert robot.clearance(robot.configuration(pose)).distance > 0.01, gloss


def test_making_them_again_gives_the_same_entries() -> None:
    digits = {str(digit): sign(str(digit)) for digit in range(10)}
    made = higher_number_signs(Robot.load(), digits)
    assert [one.gloss for one in made] == [*TEENS, *TENS]
    for again in made:
        kept = sign(again.gloss)
        assert again.joints == kept.joints
        np.testing.assert_allclose(again.knots, kept.knots, atol=1e-5)
        np.testing.assert_allclose(again.times, kept.times, atol=1e-6)
