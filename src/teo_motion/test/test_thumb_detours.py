# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Hands between two handshapes, judged by a collision library along the whole way."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from thumb_capsules import thumb_gap

from teo_common.arrays import Array
from teo_description.hand_geometry import TOUCH, hand_table
from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_motion.collision.thumb_detours import with_clear_thumbs
from teo_motion.planner import Planner
from teo_motion.sentence.composition import Route
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_names import COMMANDED_JOINTS, LEFT_HAND, RIGHT_HAND
from teo_signs.look_up_table import Lut
from teo_signs.tokens import parse_printed

REST = load_humanoid().ready

PAIRS = 24
LOOKS = 25  # of each straight way: a finger folds by 3 deg between two, a table of places is off by 0.3 mm
_OFF = 3e-4  # [m]
SIDES = {"Right": RIGHT_HAND, "Left": LEFT_HAND}


def columns(side: str) -> list[int]:
    return [COMMANDED_JOINTS.index(name) for name in SIDES[side]]


def deepest(robot: Robot, shapes: Array, side: str) -> float:
    """Least gap on the straight ways from shape to shape [m]. Shape (n, 6)."""
    shares: Array = np.linspace(0.0, 1.0, LOOKS)[:, None]
    return min(
        thumb_gap(robot, hand, side)
        for first, last in pairwise(shapes)
        for hand in first + shares * (last - first)
    )


def straight(first: Array, last: Array, side: str) -> Route:
    """A route of two waypoints, at which all but one hand rests."""
    targets = np.stack([REST, REST])
    targets[:, columns(side)] = first, last
    start, strokes = State.still(targets[0]), np.zeros(1, np.intp)
    return Route(targets=targets, nominal=np.ones(1), strokes=strokes, spans=(), start=start)


def handshapes(lut: Lut) -> Array:
    """Those with which the package's signs begin and end. Shape (n, 6)."""
    of_hand = [
        (sign, [sign.joints.index(name) for name in RIGHT_HAND])
        for sign in lut.values()
        if set(RIGHT_HAND) <= set(sign.joints)
    ]
    ends = [sign.knots[knot, hand] for sign, hand in of_hand for knot in (0, -1)]
    return np.unique(np.round(ends, 6), axis=0)


def test_thumbs_that_would_pass_through_a_finger_go_another_way_and_others_go_straight(
    robot: Robot, lut: Lut
) -> None:
    limits, table = MotionLimits.of_robot(), hand_table(robot)
    shapes, dice = handshapes(lut), np.random.default_rng(5)
    through = 0
    for number in range(PAIRS):
        side = ("Right", "Left")[number % 2]
        hand = columns(side)
        ends = shapes[dice.choice(len(shapes), 2, replace=False)]
        given = straight(*ends, side)
        route = with_clear_thumbs(given, table, limits)
        assert np.array_equal(route.targets[[0, -1]], given.targets)
        assert np.isnan(np.delete(route.targets[1:-1], hand, axis=1)).all(), "all else goes on freely"
        before = deepest(robot, ends, side)
        if before > -TOUCH + _OFF:
            assert len(route.targets) == 2
        else:
            assert deepest(robot, route.targets[:, hand], side) > -TOUCH - _OFF
        through += before < -TOUCH - _OFF
    assert through >= 4


@pytest.mark.parametrize(
    "sentence",
    [
        # Between words, in one that changes its handshape, to and from a letter whose thumb lies close.
        "QUÉ_DICE BUENO VEHÍCULO J-A",
        # On a way that the arms go round, which is timed anew for that.
        "SERPIENTE CONTENER MUCHO RENUNCIAR",
    ],
)
def test_in_a_sentence_no_thumb_is_in_a_finger_at_any_time(robot: Robot, lut: Lut, sentence: str) -> None:
    plan = Planner(lut, robot=robot).plan(parse_printed(sentence))
    hands = plan.positions[:, columns("Right")]
    moved = hands[1:][(np.diff(hands, axis=0) != 0.0).any(axis=1)][::2]
    assert min(thumb_gap(robot, hand, "Right") for hand in moved) > -TOUCH - _OFF
