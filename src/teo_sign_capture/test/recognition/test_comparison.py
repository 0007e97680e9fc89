# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A learner is told what differs: the part of the sign that was changed, and no other."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from made_bags import signing, write_bag
from typer.testing import CliRunner

from teo_description.robot import Robot
from teo_lut_executor.cli.lut import app
from teo_names import RIGHT_HAND
from teo_sign_capture.recognition import HAND, PARTS, Comparison, compare, sign_appearance
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign


@pytest.fixture(scope="module")
def robot() -> Robot:
    return Robot.load()


def sign(gloss: str) -> Sign:
    return Lut.open(default_lut_directory())[gloss]


def largest(compared: Comparison) -> str:
    parts = ("handshape", "orientation", "place", "movement")
    return max(parts, key=lambda part: asdict(compared)[part])


@pytest.mark.parametrize("gloss", ["CASA", "MADRE", "HOLA"])
def test_a_sign_made_as_it_is_differs_in_nothing(robot: Robot, gloss: str) -> None:
    shown = sign_appearance(robot, sign(gloss))
    same = compare(gloss, shown, shown)
    assert same.hands
    assert (same.handshape, same.orientation, same.place, same.movement, same.distance) == (0, 0, 0, 0, 0)


@pytest.mark.parametrize("gloss", ["MADRE", "HOLA"])
def test_a_hand_that_is_closed_where_it_should_be_open_differs_in_handshape(robot: Robot, gloss: str) -> None:
    right = sign(gloss)
    knots = right.knots.copy()
    for finger in RIGHT_HAND[2:]:
        knots[:, right.joints.index(finger)] = 1.4
    closed = replace(right, knots=knots)
    compared = compare(gloss, sign_appearance(robot, closed), sign_appearance(robot, right))
    assert largest(compared) == "handshape"
    assert compared.handshape > 1.0 > compared.movement


@pytest.mark.parametrize(
    ("part", "changed", "by"),
    [
        ("place", PARTS.place, np.array([1.5, 0.0, -1.0])),
        ("movement", PARTS.place, np.sin(np.linspace(0.0, 12.0, 32))[:, None] * [0.0, 3.0, 0.0]),
        ("orientation", PARTS.turns, np.array([2.0, 0.0, 0.0, 0.0, 2.0, 0.0])),
    ],
)
def test_the_part_that_was_changed_is_named(robot: Robot, part: str, changed: slice, by: np.ndarray) -> None:
    meant = sign_appearance(robot, sign("MADRE"))
    shown = meant.copy()
    shown[:, changed] += by
    assert largest(compare("MADRE", shown, meant)) == part


def test_a_sign_of_two_hands_made_with_one_is_named_so(robot: Robot) -> None:
    two = sign_appearance(robot, sign("CASA"))
    one = two.copy()
    one[:, HAND:] = 0.0
    compared = compare("CASA", one, two)
    assert not compared.hands
    assert compared.handshape == 0.0  # the hand that is there is right


def test_recognise_says_what_differs_from_the_sign_that_was_meant(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "take.mcap", signing(rate=15.0))
    result = CliRunner().invoke(app, ["recognise", str(bag), "--meant", "CASA", "--json"])
    assert result.exit_code == 0, result.output
    compared = json.loads(result.stdout)["compared"]
    assert compared["gloss"] == "CASA"
    assert not compared["hands"]  # one hand signs in the recording
    unknown = CliRunner().invoke(app, ["recognise", str(bag), "--meant", "NADIE", "--json"])
    assert json.loads(unknown.stdout)["code"] == "unknown_sign"
