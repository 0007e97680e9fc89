# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The postures in which letters are easy to reach are read as the letters; spelling with them takes less."""

from __future__ import annotations

import dataclasses
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from teo_description.hand_geometry import HandGeometry
from teo_description.robot import Robot
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, joint_limits
from teo_sign_authoring.alphabet.spelling_arm import shift_off_face
from teo_sign_authoring.easing.easy_letters import ease_letters, with_easy_posture
from teo_sign_capture.retarget.knots import least_clearance
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.errors import LutError
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign

ALPHABET = load_language(DEFAULT_LANGUAGE).alphabet


@pytest.fixture(scope="module")
def robot() -> Robot:
    return Robot.load()


@cache
def letters() -> dict[str, Sign]:
    lut = Lut.open()
    return {letter: lut[letter] for letter in ALPHABET.frequencies}


def eased(sign: Sign) -> Sign:
    return dataclasses.replace(sign, knots=sign.alternatives[0], alternatives=())


def test_every_letter_has_an_easy_posture_of_the_same_movement() -> None:
    for letter, sign in letters().items():
        (other,) = sign.alternatives
        offset = other - sign.knots
        same = np.broadcast_to(offset[0], offset.shape)
        np.testing.assert_allclose(offset, same, atol=2e-6, err_msg=letter)


def test_the_palm_is_turned_and_moved_by_little(robot: Robot) -> None:
    for letter, sign in letters().items():
        for row, other in zip(sign.knots, sign.alternatives[0], strict=True):
            palm, moved = (
                robot.placement(robot.configuration(pose), "right_palm")
                for pose in (dict(zip(sign.joints, q.tolist(), strict=True)) for q in (row, other))
            )
            turn = Rotation.from_matrix(palm[:3, :3].T @ moved[:3, :3]).magnitude()
            assert np.degrees(turn) < 30.0, letter
            assert np.linalg.norm(palm[:3, 3] - moved[:3, 3]) < 0.12, letter


def test_the_elbow_hangs_about_as_it_was_captured(robot: Robot) -> None:
    for letter, sign in letters().items():
        for row, other in zip(sign.knots[[0, -1]], sign.alternatives[0][[0, -1]], strict=True):
            before, now = (
                robot.joint_placements(robot.configuration(pose), ("FrontalRightElbow",))[0][:3, 3]
                for pose in (dict(zip(sign.joints, q.tolist(), strict=True)) for q in (row, other))
            )
            assert before[1] - now[1] < 0.08, letter  # to the right
            assert now[2] - before[2] < 0.08, letter  # up


def test_extended_fingers_stay_extended_and_folded_ones_folded() -> None:
    for letter, sign in letters().items():
        before, after = (np.degrees(q[0, 8:]) for q in (sign.knots, sign.alternatives[0]))
        assert (after[before < 15.0] < 25.0).all(), letter
        assert (after[before > 60.0] > 40.0).all(), letter


def test_letters_that_look_alike_look_no_more_alike_in_any_posture(robot: Robot) -> None:
    alike = [pair for pair in nearest_pairs(robot, letters().values()) if pair.seen < 2.5]
    assert len(alike) > 4
    for pair in alike:
        for first in (letters()[pair.first], eased(letters()[pair.first])):
            for second in (letters()[pair.second], eased(letters()[pair.second])):
                (now,) = nearest_pairs(robot, [first, second])
                assert now.seen > pair.seen - 0.01, pair


def test_any_two_easy_postures_differ_by_more_than_is_just_seen(robot: Robot) -> None:
    assert nearest_pairs(robot, [eased(sign) for sign in letters().values()])[0].seen > 1.24


def test_nothing_touches_hides_the_face_or_leaves_its_limits(robot: Robot) -> None:
    hand = HandGeometry(robot)
    for letter, sign in letters().items():
        other = sign.alternatives[0]
        limits = joint_limits(sign.joints)
        assert (other >= limits.lower).all() and (other <= limits.upper).all(), letter
        assert least_clearance(robot, sign.joints, other[[0, -1]]) > 0.014, letter
        assert np.linalg.norm(shift_off_face(robot, other)) < 0.03, letter
        for row, captured in zip(other[[0, -1]], sign.knots[[0, -1]], strict=True):
            before = hand.thumb_clearances(hand.points(captured[6:])).min()
            assert hand.thumb_clearances(hand.points(row[6:])).min() > min(before, 0.0) - 0.004, letter


def test_ways_between_letters_take_less_time() -> None:
    limits = MotionLimits.of_robot()

    def expected(signs: dict[str, Sign]) -> float:
        time = 0.0
        for one, share in ALPHABET.frequencies.items():
            for other, other_share in ALPHABET.frequencies.items():
                columns = [COMMANDED_JOINTS.index(joint) for joint in signs[other].joints]
                way = signs[other].knots[0] - signs[one].knots[-1]
                time += share * other_share * float(limits.least_times(way, columns).max())
        return time / sum(ALPHABET.frequencies.values()) ** 2

    assert expected({letter: eased(sign) for letter, sign in letters().items()}) < 0.77 * expected(letters())


def test_a_table_without_all_letters_is_refused_by_name(robot: Robot) -> None:
    with pytest.raises(LutError, match="none for A, B") as caught:
        ease_letters(robot, ALPHABET, {})
    assert caught.value.code == "unknown_sign"


def test_no_offset_gives_no_alternative() -> None:
    sign = letters()["A"]
    assert with_easy_posture(sign, np.zeros(12)).alternatives == ()
    np.testing.assert_array_equal(with_easy_posture(sign, np.full(12, 0.1)).alternatives[0], sign.knots + 0.1)
