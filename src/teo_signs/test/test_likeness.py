# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What tells two signs apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_names import LEFT_HAND
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign


@pytest.fixture(scope="module")
def robot() -> Robot:
    return Robot.load()


def turned(sign: Sign, joint: str, angle: float) -> Sign:
    """The sign with a joint turned throughout, under another name [rad]."""
    knots = sign.knots.copy()
    knots[:, sign.joints.index(joint)] += angle
    return replace(sign, gloss=f"{sign.gloss}_B", knots=knots)


def test_two_names_of_one_sign_are_no_pair(robot: Robot, shipped: Lut) -> None:
    assert nearest_pairs(robot, [shipped["COMER"], shipped["COMIDA"]]) == []


def test_words_are_told_apart_by_place_and_letters_are_not(robot: Robot, shipped: Lut) -> None:
    """The whole arm raised by 10 deg: the hand is 3 cm higher, and turned by less than is seen."""
    for gloss, counts in (("NARIZ", True), ("A", False)):
        (pair,) = nearest_pairs(
            robot, [shipped[gloss], turned(shipped[gloss], "FrontalRightShoulder", np.radians(-10.0))]
        )
        assert np.degrees(pair.orientation) == pytest.approx(10.0, abs=0.1)
        assert pair.handshape == pytest.approx(0.0, abs=1e-9)
        assert (pair.place > 0.028) == counts
        assert (pair.seen > 1.0) == counts


def test_the_left_hand_counts_as_much_as_the_right(robot: Robot, shipped: Lut) -> None:
    house = shipped["CASA"]
    (pair,) = nearest_pairs(robot, [house, turned(house, LEFT_HAND[2], np.radians(40.0))])
    assert pair.handshape > 0.015
    assert pair.seen > 1.0


@pytest.mark.slow
def test_no_two_words_of_the_table_look_alike(robot: Robot, shipped: Lut) -> None:
    words = [sign for sign in shipped.values() if sign.kind == "lexical"]
    nearest = nearest_pairs(robot, words)[0]
    # Mouth and nose are pointed at, and lie little more than one place apart.
    assert nearest.seen > 1.0, nearest
