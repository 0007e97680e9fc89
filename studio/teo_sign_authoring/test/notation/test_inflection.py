# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Inflected forms: a verb goes from who acts to whom it is done to, and pain is where it is."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from teo_description.robot import Robot
from teo_sign_authoring.notation.score_file import BODY_PLACES, read_score
from teo_sign_authoring.notation.score_retarget import score_sign
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, Sign, default_lut_directory

TABLE = default_lut_directory()
# Where persons are, seen from TEO, as every grammar of LSE draws them: oneself, before oneself, at the right.
LOCI = {"1": np.array([0.0, 0.0]), "2": np.array([1.0, 0.0]), "3": np.array([0.5, -1.0])}
AGREEING = ("AYUDAR", "DAR", "INVITAR", "PEDIR", "PREGUNTAR")
BACKWARD = ("INVITAR",)

SCORE = """\
gloss: PRUEBA
standing: sketched
source: made up
hands: right
steps:
  - right: {shape: flat, place: space, palm: in, fingers: front up}
forms:
  along: persons
  only: ["2>1"]
  steps:
    - right: {shape: flat, place: giver, palm: up, fingers: front}
    - time: 0.5
      right: {place: receiver 2 up}
"""


@cache
def sign(gloss: str) -> Sign:
    return Lut.open(TABLE)[gloss]


def palms(robot: Robot, one: Sign) -> np.ndarray:
    """Places of the right palm at the knots [m]."""
    return np.array(
        [
            robot.placement(robot.configuration(one.pose(knot)), "right_palm")[:3, 3]
            for knot in range(len(one.times))
        ]
    )


@pytest.mark.parametrize("gloss", AGREEING)
def test_the_hand_goes_from_who_acts_to_whom_it_is_done_to(robot: Robot, gloss: str) -> None:
    forms = sign(gloss).forms
    assert {"1>2", "2>1", "1>3", "3>1"} <= set(forms)
    for inflection in forms:
        giver, receiver = inflection.split(">")
        if gloss in BACKWARD:
            giver, receiver = receiver, giver
        places = palms(robot, sign(gloss).inflected(inflection))
        # PREGUNTAR rocks back: the way is to where the hand is farthest from its beginning.
        farthest = places[np.linalg.norm(places - places[0], axis=1).argmax()]
        way, wanted = (farthest - places[0])[:2], LOCI[receiver] - LOCI[giver]
        assert np.linalg.norm(way) > 0.04, inflection
        cosine = way @ wanted / np.linalg.norm(way) / np.linalg.norm(wanted)
        assert np.degrees(np.arccos(cosine)) < 45.0, inflection


@pytest.mark.parametrize(("name", "verb"), [("DAME", "DAR"), ("AYÚDAME", "AYUDAR")])
def test_give_me_and_help_me_are_forms_of_their_verbs(name: str, verb: str) -> None:
    form = sign(verb).forms["2>1"]
    np.testing.assert_allclose(sign(name).knots, form.knots, atol=2e-6)
    np.testing.assert_allclose(sign(name).times, form.times)


def test_pain_is_shown_at_the_place_that_hurts(robot: Robot) -> None:
    tips = {}
    for gloss in BODY_PLACES:
        form = sign("DOLER").inflected(gloss)
        q = robot.configuration(form.pose(0))
        tips[gloss] = robot.placement(q, "RightIndexFingerTip")[:3, 3]
    assert set(sign("DOLER").forms) == set(BODY_PLACES)
    height = {gloss: tip[2] for gloss, tip in tips.items()}
    downwards = [height[gloss] for gloss in ("CABEZA", "OJO", "BOCA", "GARGANTA", "PECHO", "BARRIGA")]
    assert downwards == sorted(downwards, reverse=True)
    assert tips["CORAZÓN"][1] > tips["PECHO"][1] + 0.03  # the heart is on the left
    assert tips["OREJA"][1] < tips["OJO"][1] - 0.03


def test_forms_keep_clear_of_the_body(robot: Robot, shipped: Lut) -> None:
    inflected = [sign.inflected(inflection) for sign in shipped.values() for inflection in sign.forms]
    assert len(inflected) > 30
    for one in inflected:
        for moment in np.linspace(0.0, one.duration, 9):
            pose = {
                joint: np.interp(moment, one.times, values)
                for joint, values in zip(one.joints, one.knots.T, strict=True)
            }
            assert robot.clearance(robot.configuration(pose)).distance > 0.004, one.gloss


def write(folder: Path, text: str, name: str = "PRUEBA") -> Path:
    path = folder / f"{name}.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_forms_are_said_once_and_may_have_a_second_name(robot: Robot, tmp_path: Path) -> None:
    made = score_sign(robot, read_score(write(tmp_path, SCORE)))
    assert set(made.forms) == {"2>1"}
    places = palms(robot, made.inflected("2>1"))
    assert places[0, 0] - places[-1, 0] > 0.10  # from the front to the chest
    second = "gloss: DADO\nstanding: sketched\nsource: made up\nsigns: [PRUEBA]\ninflection: '2>1'\n"
    again = score_sign(robot, read_score(write(tmp_path, second, "DADO")))
    np.testing.assert_allclose(again.knots, made.forms["2>1"].knots, atol=1e-9)
    with pytest.raises(LutError, match="2>1"):
        read_score(write(tmp_path, second.replace("2>1", "1>2"), "DADO"))


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("along: persons", "along: moods", "along"),
        ('only: ["2>1"]', 'only: ["2>2"]', "only"),
        ("place: giver", "place: nowhere", "nowhere"),
    ],
)
def test_forms_that_are_not_right_are_refused_by_name(tmp_path: Path, old: str, new: str, named: str) -> None:
    with refused("bad_score") as refusal:
        read_score(write(tmp_path, SCORE.replace(old, new)))
    assert named in str(refusal.value)
