# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers and the signs of TEO's own demonstration."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_sign_authoring.alphabet.demonstration import demonstrated_signs, flexions
from teo_signs.look_up_table import Lut, Sign, default_lut_directory

TABLE = default_lut_directory()
STRAIGHT = {"1": 1, "2": 2, "3": 3, "4": 4, "5": 4, "6": 1, "7": 2, "8": 3, "9": 4, "10": 4}


@cache
def sign(gloss: str) -> Sign:
    return Lut.open(TABLE)[gloss]


def column(gloss: str, joints: tuple[str, ...]) -> np.ndarray:
    return np.degrees(sign(gloss).knots[:, [sign(gloss).joints.index(joint) for joint in joints]])


@pytest.mark.parametrize("digit", STRAIGHT)
def test_numbers_count_with_straight_fingers_from_the_index_on(digit: str) -> None:
    fingers = column(digit, RIGHT_HAND)[0, 2:]
    assert (fingers[: STRAIGHT[digit]] < 10.0).all()
    assert (fingers[STRAIGHT[digit] :] > 75.0).all()
    assert (sign(digit).handedness == "both") == (int(digit) > 5)
    assert np.ptp(sign(digit).knots, axis=0).max() == 0.0 and sign(digit).duration > 0.3  # held


def test_counting_shows_the_back_of_hands_beside_each_other_and_the_palm_of_one(robot: Robot) -> None:
    for digit in map(str, range(1, 11)):
        q = robot.configuration(sign(digit).pose(0))
        right = robot.placement(q, "right_palm")
        facing = 1.0 if digit == "1" else -1.0  # the films of 1 show its palm
        assert facing * right[0, 2] > 0.7, digit
        assert robot.clearance(q).distance > 0.02
        if int(digit) > 5:
            left = robot.placement(q, "left_palm")
            assert left[0, 2] < -0.7
            assert 0.2 < left[1, 3] - right[1, 3] < 0.5
            assert (column(digit, LEFT_HAND)[0, 2:] < 10.0).all()


# What DILSE's clips show: the fingers that are straight at the beginning and at the end.
@pytest.mark.parametrize(
    ("number", "begins", "ends"),
    [
        ("11", "1000", "1000"),
        ("12", "0000", "1100"),
        ("13", "0000", "1110"),
        ("14", "1011", "1111"),
        ("15", "1011", "1111"),
        ("16", "1111", "1000"),
        ("17", "1111", "1100"),
        ("18", "1111", "1110"),
        ("19", "1111", "1111"),
        ("20", "1100", "0000"),
        ("30", "1110", "0111"),
        ("40", "1111", "0111"),
        ("50", "1111", "0111"),
        ("100", "1000", "0000"),
    ],
)
def test_larger_numbers_open_and_close_the_fingers_that_the_dictionary_shows(
    number: str, begins: str, ends: str
) -> None:
    fingers = column(number, RIGHT_HAND)[:, 2:]
    for row, expected in ((fingers[0], begins), (fingers[-1], ends)):
        assert "".join("1" if bend < 20.0 else "0" for bend in row) == expected


def test_sixteen_to_nineteen_begin_as_ten_and_part_into_the_unit(robot: Robot) -> None:
    for number in ("16", "17", "18", "19"):
        apart = []
        for knot in (0, -1):
            q = robot.configuration(sign(number).pose(knot))
            apart.append(robot.placement(q, "left_palm")[1, 3] - robot.placement(q, "right_palm")[1, 3])
        assert apart[1] - apart[0] > 0.08


def test_tens_turn_the_palm_from_the_signer_to_the_side(robot: Robot) -> None:
    for number in ("20", "30", "40", "50"):
        first, last = (
            robot.placement(robot.configuration(sign(number).pose(knot)), "right_palm")[:3, 2]
            for knot in (0, -1)
        )
        assert first[0] < -0.7
        assert last[1] > 0.7


def test_hand_motors_become_flexions_by_the_documented_line() -> None:
    # Fingers: 7 deg at 0 mm, 85 deg at 20 mm; thumb: -90 deg at 0 mm, 90 deg at 10 mm.
    assert np.degrees(flexions((0, 0, 0, 0, 0, 0))) == pytest.approx([0, -90, 7, 7, 7, 7])
    assert np.degrees(flexions((90, 10, 20, 20, 20, 20))) == pytest.approx([90, 90, 85, 85, 85, 85])
    assert column("NOMBRE", RIGHT_HAND)[0] == pytest.approx([40.0, -54.0, 7.0, 7.0, 77.2, 77.2], abs=1e-3)


@pytest.mark.parametrize(
    ("gloss", "times", "right", "left"),
    [
        (
            "HOLA",
            [0.0, 0.75, 1.25],
            [[-56.0, 9.9, 21.8, -99.6, 33.5, -26.1], [-59.6, 9.9, 21.8, -83.6, 33.5, -17.6]],
            None,
        ),
        ("MI", [0.0, 0.5], [[-55.0, -5.0, 57.0, -99.6, -56.5, 6.7]], None),
        (
            "NOMBRE",
            [0.0, 1.75, 2.25],
            [[-65.0, 0.0, 50.0, -99.6, -20.0, 6.7], [-51.0, 2.0, 50.0, -80.0, -30.0, 15.0]],
            [-35.0, 7.0, -35.0, -85.0, 0.0, 0.0],
        ),
    ],
)
def test_demonstrated_signs_are_the_published_poses_and_times_and_made_again_the_same(
    robot: Robot, gloss: str, times: list[float], right: list[list[float]], left: list[float] | None
) -> None:
    (again,) = (made for made in demonstrated_signs(robot) if made.gloss == gloss)
    kept = sign(gloss)
    assert kept.times.tolist() == times  # with the demonstration's pause at the end
    np.testing.assert_allclose(column(gloss, RIGHT_ARM)[: len(right)], right, atol=1e-3)
    if left is not None:
        np.testing.assert_allclose(column(gloss, LEFT_ARM)[0], left, atol=1e-3)
    assert again.joints == kept.joints
    np.testing.assert_allclose(again.knots, kept.knots, atol=0.01)
    np.testing.assert_allclose(again.times, kept.times, atol=1e-6)
    for moment in np.linspace(0.0, kept.duration, 12):
        pose = {
            joint: np.interp(moment, kept.times, values)
            for joint, values in zip(kept.joints, kept.knots.T, strict=True)
        }
        assert robot.clearance(robot.configuration(pose)).distance > 0.004
