# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The postures in which letters are easy to reach are read as the letters; spelling with them takes less."""

from __future__ import annotations

import dataclasses
from functools import cache

import numpy as np
from refusals import refused
from scipy.spatial.transform import Rotation

from teo_description.hand_geometry import HandGeometry
from teo_description.robot import Robot
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS
from teo_sign_authoring.alphabet.spelling_arm import shift_off_face
from teo_sign_authoring.easing.easy_letters import ease_letters
from teo_sign_capture.retarget.knots import least_clearance
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign

ALPHABET = load_language(DEFAULT_LANGUAGE).alphabet


@cache
def letters() -> dict[str, Sign]:
    lut = Lut.open()
    return {letter: lut[letter] for letter in ALPHABET.frequencies}


def eased(sign: Sign) -> Sign:
    return dataclasses.replace(sign, knots=sign.alternatives[0], alternatives=())


def test_an_easy_posture_is_one_small_offset_of_palm_elbow_and_fingers(robot: Robot) -> None:
    for letter, sign in letters().items():
        (easy,) = sign.alternatives
        offset = easy - sign.knots
        same = np.broadcast_to(offset[0], offset.shape)
        np.testing.assert_allclose(offset, same, atol=2e-6, err_msg=letter)  # what moves moves on
        for knot, rows in enumerate(zip(sign.knots, easy, strict=True)):
            poses = [robot.configuration(dict(zip(sign.joints, q.tolist(), strict=True))) for q in rows]
            palm, moved = (robot.placement(q, "right_palm") for q in poses)
            turn = Rotation.from_matrix(palm[:3, :3].T @ moved[:3, :3]).magnitude()
            assert np.degrees(turn) < 30.0, letter
            assert np.linalg.norm(palm[:3, 3] - moved[:3, 3]) < 0.12, letter
            if knot in (0, len(easy) - 1):
                before, now = (robot.joint_placements(q, ("FrontalRightElbow",))[0][:3, 3] for q in poses)
                assert before[1] - now[1] < 0.08, letter  # to the right
                assert now[2] - before[2] < 0.08, letter  # up
        captured, eased_fingers = (np.degrees(q[0, 8:]) for q in (sign.knots, easy))
        assert (eased_fingers[captured < 15.0] < 25.0).all(), letter
        assert (eased_fingers[captured > 60.0] > 40.0).all(), letter


def test_letters_that_look_alike_look_no_more_alike_in_any_posture(robot: Robot) -> None:
    alike = [pair for pair in nearest_pairs(robot, letters().values()) if pair.seen < 2.5]
    assert len(alike) > 4
    for pair in alike:
        for first in (letters()[pair.first], eased(letters()[pair.first])):
            for second in (letters()[pair.second], eased(letters()[pair.second])):
                (now,) = nearest_pairs(robot, [first, second])
                assert now.seen > pair.seen - 0.01, pair
    assert nearest_pairs(robot, [eased(sign) for sign in letters().values()])[0].seen > 1.24


def test_nothing_touches_or_hides_the_face(robot: Robot) -> None:
    hand = HandGeometry(robot)
    for letter, sign in letters().items():
        other = sign.alternatives[0]
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


def test_a_table_without_letters_is_refused(robot: Robot) -> None:
    with refused("unknown_sign", "letters among A, B"):
        ease_letters(robot, ALPHABET, {})
