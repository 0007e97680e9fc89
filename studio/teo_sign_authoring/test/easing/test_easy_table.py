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
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Token

# Two that are told apart by their handshape alone, and one that is slow for its turn of the palm.
_GLOSSES = ("OCTAVO", "NOVENO", "CONCEPTO", "CASA", "MANO")


@pytest.fixture(scope="module")
def signs() -> dict[str, Sign]:
    lut = Lut.open(default_lut_directory())
    return {gloss: lut[gloss] for gloss in _GLOSSES}


@pytest.fixture(scope="module")
def table(signs: dict[str, Sign]) -> EasyTable:
    return EasyTable(Robot.load(), signs)


def stretch(sign: Sign) -> float:
    planner = Planner({sign.gloss: sign}, robot=Robot.load(), least_standing="sketched")
    return planner.plan([Token(gloss=sign.gloss)]).stretch


def test_a_posture_that_drifts_to_another_sign_is_taken_for_it(
    table: EasyTable, signs: dict[str, Sign]
) -> None:
    one, other = signs["OCTAVO"], signs["NOVENO"]
    assert one.joints == other.joints
    found = [
        table.taken_for_another(one, one.knots + share * (other.knots - one.knots))
        for share in (0.0, 0.3, 0.7, 1.0)
    ]
    assert found == ["", "", "NOVENO", "NOVENO"]


def test_alternatives_of_the_table_look_more_like_their_own_sign_than_any_other() -> None:
    lut = Lut.open(default_lut_directory())
    table = EasyTable(Robot.load(), lut)
    words = [lut[gloss] for gloss in sorted(lut)[::5] if lut[gloss].kind == "lexical"]
    taken = {
        sign.gloss: other
        for sign in words
        for knots in sign.alternatives
        if (other := table.taken_for_another(sign, knots))
    }
    assert taken == {}


def test_a_slow_word_becomes_quicker_and_its_palm_turns_by_at_least_sixty_percent(
    table: EasyTable, signs: dict[str, Sign]
) -> None:
    sign = signs["CONCEPTO"]
    eased = table.eased(sign)
    (knots,) = eased.alternatives
    assert stretch(eased) < 0.8 * stretch(dataclasses.replace(sign, alternatives=()))
    robot = Robot.load()

    def turn(knots: np.ndarray) -> float:
        first, last = (
            robot.placement(
                robot.configuration(dict(zip(sign.joints, row.tolist(), strict=True))), "right_palm"
            )[:3, :3]
            for row in (knots[0], knots[-1])
        )
        return float(np.arccos((np.trace(first.T @ last) - 1.0) / 2.0))

    assert turn(knots) >= 0.6 * turn(sign.knots) - np.radians(1.0)
