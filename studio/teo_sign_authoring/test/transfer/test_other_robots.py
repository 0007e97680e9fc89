# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs on a robot that is built otherwise than TEO, by forward kinematics that no search knows of."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_lut_executor.cli.lut import app
from teo_motion.sentence.posture_choice import postures_of
from teo_sign_authoring.transfer.entry_postures import BodyToBody
from teo_sign_authoring.transfer.language_signs import LanguageSigns
from teo_sign_capture.retarget.handshapes import handshape
from teo_sign_languages import load_language
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, save_sign
from teo_signs.sign import Sign

ROBOT = "gr1t2"


@cache
def robot() -> Robot:
    return Robot.load(ROBOT)


@cache
def table() -> dict[str, Sign]:
    return dict(Lut.open(load_language("ssp").table(ROBOT), robot=ROBOT))


def run(*arguments: str | Path) -> Result:
    return CliRunner(env={"COLUMNS": "200"}).invoke(app, [str(argument) for argument in arguments])


def frame(sign: Sign, name: str, knot: int = 0) -> Array:
    return robot().placement(robot().configuration(sign.pose(knot)), name)


def point(name: str) -> Array:
    return np.array(robot().humanoid.file.places[name].point)


def test_the_table_holds_every_letter_and_all_but_a_few_signs() -> None:
    language = load_language("ssp")
    reference = Lut.open(language.table("teo"))
    assert set(language.alphabet.letters) <= table().keys() <= set(reference)
    assert len(table()) > 0.979 * len(reference)
    assert {sign.robot for sign in table().values()} == {ROBOT}


@pytest.mark.parametrize("gloss", ["CABEZA", "OJO", "BOCA", "PECHO"])
def test_a_sign_at_a_part_of_the_body_is_at_this_robots(gloss: str) -> None:
    places = {"CABEZA": "head_top", "OJO": "eye", "BOCA": "mouth", "PECHO": "chest"}
    hand = robot().humanoid.file.hand
    tips = [hand.palm, *(frames[-1] for frames in hand.fingers.values())]
    sign = table()[gloss]
    nearest = min(
        np.linalg.norm(frame(sign, tip, knot)[:3, 3] - point(places[gloss]))
        for tip in tips
        for knot in range(len(sign.times))
    )
    assert nearest < 0.15


def test_letters_with_a_palm_to_the_front_have_it_and_fingers_up() -> None:
    for letter in ("L", "LL", "U"):
        palm = frame(table()[letter], robot().humanoid.file.hand.palm)
        assert palm[:3, 2] @ (1.0, 0.0, 0.0) > 0.7, letter
        assert palm[:3, 0] @ (0.0, 0.0, 1.0) > 0.7, letter


@pytest.mark.parametrize("language", ["ssp", "ase"])
@pytest.mark.parametrize(
    ("name", "shoulder", "elbow"),
    [
        ("teo", "FrontalRightShoulder", "FrontalRightElbow"),
        (ROBOT, "right_shoulder_roll_joint", "right_elbow_pitch_joint"),
    ],
)
def test_no_robot_lifts_its_elbow_above_the_shoulder_to_spell(
    name: str, shoulder: str, elbow: str, language: str
) -> None:
    speller = Robot.load(name)
    letters = load_language(language).alphabet.letters
    signs = Lut.open(load_language(language).table(name), language=language, robot=name)
    for letter in letters:
        for knots in postures_of(signs[letter]):
            for row in knots[[0, len(knots) // 2, -1]].tolist():
                q = speller.configuration(dict(zip(signs[letter].joints, row, strict=True)))
                placed = speller.joint_placements(q, (shoulder, elbow))[:, 2, 3]
                assert placed[1] - placed[0] < 0.055, letter  # about an elbow's thickness


@pytest.mark.parametrize(
    ("name", "straight"),
    [
        ("flat", "1111"),
        ("index", "1000"),
        ("two", "1100"),
        ("little", "0001"),
        ("horns", "1001"),
        ("fist", "0000"),
    ],
)
def test_fingers_that_a_handshape_names_are_straight_and_the_others_folded(name: str, straight: str) -> None:
    axes = handshape(robot(), name)
    hand = robot().humanoid.hand("right")
    q = robot().configuration(dict(zip(hand, axes.tolist(), strict=True)))
    file = robot().humanoid.file.hand
    along = robot().placement(q, file.palm)[:3, 0]
    for frames, wanted in zip(file.fingers.values(), straight, strict=True):
        knuckle, tip = (robot().placement(q, frames[end])[:3, 3] for end in (0, -1))
        reach = (tip - knuckle) @ along / np.linalg.norm(tip - knuckle)
        assert (reach > 0.9) == (wanted == "1"), (name, frames[0])


def test_elbows_are_below_the_hands_or_out_of_the_way_as_a_persons() -> None:
    elbow = robot().humanoid.file.collision.right_arm.forearm[0]
    shoulder = robot().humanoid.file.collision.right_arm.upper_arm[0]
    letters = [table()[letter] for letter in load_language("ssp").alphabet.letters]
    heights = [frame(sign, elbow)[2, 3] - frame(sign, shoulder)[2, 3] for sign in letters]
    assert np.median(heights) < 0.0


def test_places_of_one_body_come_to_lie_on_those_of_another() -> None:
    teo = Robot.load()
    body = BodyToBody(teo.humanoid, robot().humanoid)
    for name in ("chin", "ear", "belly", "shoulder", "space"):
        theirs = body(np.array([teo.humanoid.file.places[name].point]))[0]
        assert theirs == pytest.approx(point(name), abs=1e-3), name


def test_a_sign_of_which_only_joints_are_known_says_so_and_is_worth_less() -> None:
    known = Lut.open(load_language("ssp").table("teo"))["MI"]
    sign = LanguageSigns(load_language("ssp"), robot()).sign("MI")
    assert (known.provenance.standing, sign.provenance.standing) == ("recorded", "measured")
    assert "teo" in sign.provenance.method
    palm = frame(sign, robot().humanoid.file.hand.palm)[:3, 3]
    assert np.linalg.norm(palm - point("chest")) < 0.25


def test_a_table_is_made_and_made_on_and_unknown_names_are_refused(tmp_path: Path) -> None:
    first = run("retarget", "--robot", ROBOT, "--out", tmp_path, "--jobs", "1", "1", "MI")
    assert first.exit_code == 0, first.output
    assert sorted(path.name for path in tmp_path.iterdir()) == ["1.json", "MI.json"]
    before = (tmp_path / "MI.json").read_bytes()
    again = run("retarget", "--robot", ROBOT, "--out", tmp_path, "--jobs", "1", "1", "MI")
    assert "0 signs made, 2 there already" in again.output
    assert (tmp_path / "MI.json").read_bytes() == before
    unknown = run("retarget", "--robot", ROBOT, "--out", tmp_path, "NINGUNA")
    assert unknown.exit_code == 1
    assert "unknown_sign" in unknown.output
    assert "unknown_robot" in run("retarget", "--robot", "nobody").output


def test_a_table_of_another_robot_is_neither_added_to_nor_looked_at(tmp_path: Path) -> None:
    save_sign(tmp_path, table()["A"])
    for command in (("retarget", "--out"), ("fit", "--lut")):
        verb, option = command
        refused = run(verb, "--robot", "teo", option, tmp_path, "--jobs", "1", "1", "A")
        assert refused.exit_code == 1
        assert "other_robot" in refused.output
        assert "lut retarget --language ssp --robot teo" in refused.output
    teos = Lut.open(load_language("ssp").table("teo"))
    with pytest.raises(LutError, match="ssp for gr1t2") as mixed:
        save_sign(tmp_path, teos["1"])
    assert mixed.value.code == "other_robot"
    assert [path.name for path in tmp_path.iterdir()] == ["A.json"]
    save_sign(tmp_path, table()["1"])


def test_fit_says_how_far_off_signs_are_and_what_is_refused() -> None:
    result = run("fit", "--robot", ROBOT, "--all", "--jobs", "1", "1", "QUESO")
    assert result.exit_code == 1
    assert "1 of 2" in result.output
    assert "self_collision: QUESO" in result.output
