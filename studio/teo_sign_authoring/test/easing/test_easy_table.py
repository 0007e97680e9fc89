# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a word is given as an easier posture is played without touching, and looks like no other sign."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_sign_authoring.easing.easy_words import EasyTable
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign
from teo_signs.tokens import Token

# Two that are told apart by their handshape alone, and one that is slow for its turn of the palm.
_GLOSSES = ("OCTAVO", "NOVENO", "CONCEPTO", "CASA", "MANO")


@pytest.fixture(scope="module")
def table(robot: Robot, shipped: Lut) -> EasyTable:
    return EasyTable(robot, {gloss: shipped[gloss] for gloss in _GLOSSES})


def stretch(robot: Robot, sign: Sign) -> float:
    planner = Planner({sign.gloss: sign}, robot=robot, least_standing="sketched")
    return planner.plan([Token(gloss=sign.gloss)]).stretch


def test_a_posture_that_drifts_to_another_sign_is_taken_for_it(table: EasyTable, shipped: Lut) -> None:
    one, other = shipped["OCTAVO"], shipped["NOVENO"]
    assert one.joints == other.joints
    found = [
        table.taken_for_another(one, one.knots + share * (other.knots - one.knots))
        for share in (0.0, 0.3, 0.7, 1.0)
    ]
    assert found == ["", "", "NOVENO", "NOVENO"]


def test_alternatives_of_the_table_look_more_like_their_own_sign_than_any_other(
    robot: Robot, shipped: Lut
) -> None:
    table = EasyTable(robot, shipped)
    words = [shipped[gloss] for gloss in sorted(shipped)[::9] if shipped[gloss].kind == "lexical"]
    taken = {
        sign.gloss: other
        for sign in words
        for knots in sign.alternatives
        if (other := table.taken_for_another(sign, knots))
    }
    assert taken == {}


def test_a_slow_word_becomes_quicker_and_its_palm_turns_by_at_least_sixty_percent(
    table: EasyTable, robot: Robot, shipped: Lut
) -> None:
    sign = shipped["CONCEPTO"]
    eased = table.eased(sign)
    (knots,) = eased.alternatives
    assert stretch(robot, eased) < 0.8 * stretch(robot, dataclasses.replace(sign, alternatives=()))

    def turn(knots: np.ndarray) -> float:
        ends = (dict(zip(sign.joints, row.tolist(), strict=True)) for row in (knots[0], knots[-1]))
        first, last = (robot.placement(robot.configuration(q), "right_palm")[:3, :3] for q in ends)
        return float(np.arccos((np.trace(first.T @ last) - 1.0) / 2.0))

    assert turn(knots) >= 0.6 * turn(sign.knots) - np.radians(1.0)
