# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which handshape a person's hand has, and the robot's hand that has it too."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from robot_person import bent_hand

from teo_common.arrays import Array
from teo_description.hand_geometry import TOUCH, hand_table, thumb_gaps
from teo_description.robot import Robot
from teo_sign_capture.retarget.hand_motion import follow_hand
from teo_sign_capture.retarget.handshapes import (
    ShapedHand,
    held_shapes,
    shape_chances,
    with_known_shapes,
    written_shape,
)
from teo_sign_capture.tracks.signer_motion import SignerArm, signer_arm

TIMES = np.arange(45) / 30.0
STRAIGHT = np.zeros((4, 3))
# Where the thumb's tip is from the index's knuckle: along the hand, to the little finger's side, out of the
# palm, in lengths of a finger.
BESIDE, OUT, OVER = (0.26, -0.31, 0.42), (-0.05, -0.78, 0.39), (0.05, 0.35, 0.55)

Bends = Sequence[tuple[float, float, float]]


def person(bends: Sequence[Bends], tip: tuple[float, float, float], length: float = 0.08) -> SignerArm:
    """A right hand whose fingers, from index to little finger, are bent so in each frame [deg]."""
    points = np.stack([bent_hand(fingers, length) for fingers in bends])
    for hand in points:
        base, end = np.array([0.03, -0.03, 0.01]), hand[5] + length * np.array(tip)
        hand[1:5] = base + np.linspace(0.0, 1.0, 4)[:, None] * (end - base)
    return signer_arm("right", np.zeros((len(points), 3, 3)), points, STRAIGHT)


def known(robot: Robot, arm: SignerArm) -> tuple[Array, ShapedHand]:
    """Axes that follow the hand alone, and the hand that has known shapes; axes in degrees."""
    times, chances = TIMES[: len(arm.local)], shape_chances({"right": arm})["right"]
    followed = follow_hand(hand_table(robot), times, arm)
    return np.degrees(followed.axes), with_known_shapes(robot, times, chances, followed)


@pytest.mark.parametrize(
    ("bends", "tip", "name"),
    [
        ([(0, 0, 0)] * 4, BESIDE, "flat"),
        ([(0, 0, 0)] * 4, OUT, "open"),
        # As detectors see it, half open.
        ([(70, 75, 35)] * 4, OVER, "fist"),
        ([(5, 8, 5), *[(70, 80, 40)] * 3], OVER, "index"),
        ([(5, 8, 5)] * 2 + [(70, 80, 40)] * 2, OVER, "two"),
    ],
)
def test_a_shape_that_is_seen_badly_is_shown_well(
    robot: Robot, bends: Bends, tip: tuple[float, float, float], name: str
) -> None:
    _, found = known(robot, person([bends] * 45, tip))
    (held,) = held_shapes(TIMES, found.chances)
    assert held.name == name
    assert held.chance > 0.6
    off = np.degrees(np.abs(found.axes[22] - written_shape(name)))
    assert off[2:].max() < 10.0
    assert off[:2].max() < 25.0


FOLDED = [(70, 80, 40)] * 3
INDEX_OUT = person([[(5, 8, 5), *FOLDED]] * 45, OVER)


def test_a_hand_that_is_seen_badly_has_the_shape_of_the_other() -> None:
    """An index that points at the camera looks bent: crooked, if it were alone."""
    seen_badly = person([[(14, 55, 36), *FOLDED]] * 45, OVER)
    alone = shape_chances({"left": seen_badly})["left"]
    beside = shape_chances({"right": INDEX_OUT, "left": seen_badly})
    (alone_held,), (held,) = held_shapes(TIMES, alone), held_shapes(TIMES, beside["left"])
    assert (alone_held.name, held.name) == ("hook", "index")
    assert held_shapes(TIMES, beside["right"])[0].name == "index"


def test_hands_that_surely_differ_keep_their_shapes() -> None:
    flat = person([[(0, 0, 0)] * 4] * 45, BESIDE)
    found = shape_chances({"right": INDEX_OUT, "left": flat})
    assert [held_shapes(TIMES, found[side])[0].name for side in ("right", "left")] == ["index", "flat"]
    assert all((chances.sum(axis=1) <= 1.0 + 1e-9).all() for chances in found.values())


def test_a_hand_like_no_other_stays_as_it_is(robot: Robot) -> None:
    straight, folded = (0, 0, 0), (85, 95, 60)
    alone, found = known(robot, person([[straight, folded, straight, folded]] * 45, OUT))
    assert found.chances.sum(axis=1).max() < 0.05
    assert np.abs(np.degrees(found.axes) - alone)[:, 2:].max() < 4.0
    assert held_shapes(TIMES, found.chances) == ()


def test_fingers_that_flutter_go_on(robot: Robot) -> None:
    flutter = 15.0 * (1.0 - np.cos(2.0 * np.pi * 3.0 * TIMES))
    alone, found = known(
        robot, person([[(angle, angle / 2.0, 0.0)] * 4 for angle in flutter.tolist()], BESIDE)
    )
    ways = [np.abs(np.diff(axes[:, 2:], axis=0)).sum(axis=0) for axes in (alone, np.degrees(found.axes))]
    assert (ways[1] > 0.7 * ways[0]).all()


def test_one_shape_follows_another(robot: Robot) -> None:
    first, second = [(0.0, 0.0, 0.0)] * 4, [(85.0, 95.0, 60.0)] * 4
    shares = np.clip((TIMES - 0.6) / 0.2, 0.0, 1.0)[:, None, None]
    bends = (1.0 - shares) * np.array(first) + shares * np.array(second)
    _, found = known(robot, person([list(map(tuple, hand)) for hand in bends.tolist()], BESIDE))
    names = [shape.name for shape in held_shapes(TIMES, found.chances)]
    assert names[0] == "flat"
    assert names[-1] in {"fist", "thumb"}


def test_thumbs_keep_out_of_the_fingers(robot: Robot) -> None:
    random = np.random.default_rng(3)
    hands = random.uniform((0, 0, 0), (90, 100, 60), (45, 4, 3))
    _, found = known(robot, person([list(map(tuple, hand)) for hand in hands.tolist()], OVER))
    assert thumb_gaps(hand_table(robot), found.axes).min() >= -TOUCH - 1e-6
