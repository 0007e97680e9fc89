# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs that TEO is too slow for become smaller and shorter, and stay what they are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from nearest_parts import touching
from thumb_capsules import thumb_gap

from teo_description.hand_geometry import TOUCH
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.sentence.sign_size import SignSize
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS, RIGHT_ARM, RIGHT_HAND
from teo_signs.lexicon import SignedToken
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

HANGING = load_humanoid().hanging

JOINTS = (*RIGHT_ARM, *RIGHT_HAND)
# The right hand before the chest, clear of the body; fingers open.
BEFORE = np.array(
    [-0.7, -0.3, 0.0, -1.2, 0.0, 0.0, *(HANGING[COMMANDED_JOINTS.index(name)] for name in RIGHT_HAND)]
)


def fitted(robot: Robot, sign: Sign, *, scale: float = 1.0, least: float = 0.6) -> Sign:
    size = SignSize(robot, limits=MotionLimits.of_robot(), least=least)
    token = Token(gloss=sign.gloss, kind=Kind.LEXICAL, duration_scale=scale)
    signed = [SignedToken(token=token, sign=sign)]
    (item,) = size.fitted(signed, signed)
    assert item.sign is not None
    return item.sign


def swung(joint: str, angles: list[float]) -> list[np.ndarray]:
    knots = np.tile(BEFORE, (len(angles), 1))
    knots[:, JOINTS.index(joint)] = angles
    return list(knots)


def test_a_sign_within_reach_of_its_time_keeps_its_size(robot: Robot, make_sign: Callable[..., Sign]) -> None:
    slow = make_sign("X", swung("FrontalRightElbow", [-1.2, -0.9]), [0.0, 1.0], joints=JOINTS)
    assert fitted(robot, slow) is slow


def test_a_sign_that_is_too_fast_is_drawn_together_in_the_same_shape(
    robot: Robot, make_sign: Callable[..., Sign]
) -> None:
    fast = make_sign("X", swung("FrontalRightElbow", [-1.4, -0.8, -1.0]), [0.0, 0.2, 0.4], joints=JOINTS)
    smaller = fitted(robot, fast)
    way = smaller.knots[:, 3]
    assert np.diff(way) == pytest.approx(0.6 * np.diff(fast.knots[:, 3])), "as small as allowed, no smaller"
    assert (way.min() + way.max()) / 2.0 == pytest.approx(-1.1), "around its centre"
    np.testing.assert_array_equal(np.delete(smaller.knots, 3, axis=1), np.delete(fast.knots, 3, axis=1))
    assert fitted(robot, fast, scale=5.0) is fast, "there is time enough"
    assert fitted(robot, fast, least=1.0) is fast


def test_a_palm_that_turns_turns_nearly_as_far(robot: Robot, make_sign: Callable[..., Sign]) -> None:
    turning = make_sign("X", swung("AxialRightWrist", [-1.0, 1.0]), [0.0, 0.2], joints=JOINTS)
    turned = np.ptp(fitted(robot, turning).knots[:, JOINTS.index("AxialRightWrist")])
    assert np.degrees(2.0 - turned) / 2.0 <= 15.0 + 1e-6, "at each end within what is just seen"
    assert turned < 2.0


def test_a_hand_that_opens_once_opens_wholly_and_one_that_wiggles_wiggles_less(
    robot: Robot, make_sign: Callable[..., Sign]
) -> None:
    opening = make_sign("X", swung("RightIndexFinger", [1.4, 0.2]), [0.0, 0.2], joints=JOINTS)
    np.testing.assert_array_equal(fitted(robot, opening).knots, opening.knots)
    wiggle = make_sign("X", swung("RightIndexFinger", [0.2, 0.8, 0.2]), [0.0, 0.2, 0.4], joints=JOINTS)
    assert np.ptp(fitted(robot, wiggle).knots[:, JOINTS.index("RightIndexFinger")]) < 0.6


def test_fingers_that_fold_one_after_the_other_move_together_for_a_while(
    robot: Robot, make_sign: Callable[..., Sign]
) -> None:
    knots = np.tile(BEFORE, (5, 1))
    fingers = [JOINTS.index(f"Right{name}Finger") for name in ("Index", "Middle", "Ring", "Pinky")]
    for step, column in enumerate(fingers, start=1):
        knots[step:, column] = 1.4
    sign = make_sign("X", list(knots), np.arange(5) * 0.2, joints=JOINTS)
    flowing = fitted(robot, sign)
    np.testing.assert_allclose(flowing.knots[[0, -1]], sign.knots[[0, -1]])
    slowest = [np.abs(np.diff(one.knots, axis=0)).max(axis=1).sum() for one in (sign, flowing)]
    assert slowest[1] < 0.75 * slowest[0]
    half = [np.argmax(flowing.knots[:, column] > 0.75) for column in fingers]
    assert half == sorted(half) and len(set(half)) == 4, "and still one after the other"


@pytest.mark.parametrize("gloss", ["NEVERA", "A_VECES", "LÁPIZ_DE_COLOR"])
def test_a_smaller_sign_has_no_thumb_in_a_finger_where_it_begins_and_ends(
    robot: Robot, lut: Lut, gloss: str
) -> None:
    smaller = fitted(robot, lut[gloss])
    hand = [smaller.joints.index(name) for name in RIGHT_HAND]
    for knot in (0, -1):
        assert thumb_gap(robot, smaller.knots[knot, hand], "Right") >= -TOUCH - 3e-4


def test_what_is_repeated_four_times_is_repeated_twice(robot: Robot, make_sign: Callable[..., Sign]) -> None:
    angles = [-1.2, -0.8] * 4 + [-1.2, -1.2]
    sign = make_sign("X", swung("FrontalRightElbow", angles), np.arange(10) * 0.2, joints=JOINTS)
    less = fitted(robot, sign)
    turns = np.sign(np.diff(less.knots[:, 3]))
    assert turns.tolist() == [1, -1, 1, -1, 0], "twice there and back, and its hold"
    assert less.duration == pytest.approx(5 * 0.2)


@pytest.mark.slow
def test_contacts_of_the_table_are_kept(robot: Robot, lut: Lut) -> None:
    """Where a word touches the body or the other hand, it does so when it is smaller."""
    contacts = lost = 0
    for gloss in sorted(lut)[::6]:
        sign = lut[gloss]
        if sign.kind != "lexical":
            continue
        smaller = fitted(robot, sign, scale=0.5)
        if smaller is sign or len(smaller.knots) != len(sign.knots):
            continue
        for before, after in zip(sign.knots, smaller.knots, strict=True):
            poses = [dict(zip(sign.joints, row.tolist(), strict=True)) for row in (before, after)]
            assert robot.clearance(robot.configuration(poses[1])).distance >= 0.0, gloss
            distances = [touching(robot, pose) for pose in poses]
            if distances[0] < 0.025:
                contacts += 1
                lost += distances[1] >= distances[0] + 0.016  # 0.05 rad is the same contact
    # Fingers that flutter less are nearest elsewhere (JUGAR): nine of the 1,559 contacts of all words.
    assert contacts > 5 and lost <= 0.02 * contacts
