# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_bags import signing, write_bag
from typer.testing import CliRunner, Result

from teo_description.robot import Robot
from teo_lut_executor.cli.lut import app
from teo_names import RIGHT_HAND
from teo_sign_capture.recognition import (
    HAND,
    MOMENTS,
    PARTS,
    Comparison,
    SignIndex,
    compare,
    recording_appearance,
    sign_appearance,
    similar_signs,
    stands_out,
)
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.sign_file import save_sign


@pytest.fixture(scope="module")
def table() -> Lut:
    return Lut.open(default_lut_directory())


@pytest.fixture(scope="module")
def words(table: Lut) -> list[Sign]:
    return [sign for sign in table.values() if sign.kind == "lexical"]


@pytest.fixture
def few(table: Lut, tmp_path: Path) -> Path:
    """A table of five words."""
    for gloss in ("CASA", "TREN", "MADRE", "COMER", "COLEGIO"):
        save_sign(tmp_path / "few", table[gloss])
    return tmp_path / "few"


@pytest.fixture(scope="module")
def index(robot: Robot, words: list[Sign]) -> SignIndex:
    return SignIndex.of_signs(robot, words)


def run(*arguments: str | Path) -> Result:
    return CliRunner(env={"COLUMNS": "200"}).invoke(app, [str(argument) for argument in arguments])


def slowed(sign: Sign) -> Sign:
    """The sign begun at half its pace and ended at one and a half."""
    return replace(sign, times=np.sqrt(sign.times / sign.times[-1]) * sign.times[-1])


@pytest.mark.parametrize("gloss", ["CASA", "TREN", "COLEGIO"])
def test_a_sign_at_another_pace_is_still_itself(
    robot: Robot, table: Lut, index: SignIndex, gloss: str
) -> None:
    found = index.nearest(sign_appearance(robot, slowed(table[gloss])))
    assert found[0].gloss == gloss
    assert len(found) == 5
    assert [match.distance for match in found] == sorted(match.distance for match in found)


def test_two_names_of_one_motion_stand_out_as_one(index: SignIndex, robot: Robot, table: Lut) -> None:
    found = index.nearest(sign_appearance(robot, table["TREN"]))
    assert stands_out(found)
    again = replace(found[0], gloss="TREN_OTRO_NOMBRE")
    assert stands_out((found[0], again, *found[1:]))
    assert not stands_out((found[0], replace(again, distance=found[0].distance + 0.4), *found[1:]))


@settings(max_examples=25)
@given(st.integers(0, 10_000))
def test_the_bound_leaves_out_none_of_the_nearest(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shown = np.cumsum(rng.normal(size=(41, MOMENTS, 3)), axis=1)
    index = SignIndex([str(number) for number in range(40)], shown[:40])
    every = index.nearest(shown[40], 40)
    bounds = index.lower_bounds(shown[40])
    assert all(bounds[int(match.gloss)] <= match.distance + 1e-9 for match in every)
    assert index.nearest(shown[40], 5) == every[:5]


def test_a_warped_distance_is_that_of_the_textbook() -> None:
    """Sakoe and Chiba's recursion, written out, on moments that may be 8 ahead."""
    rng = np.random.default_rng(7)
    first, second = np.cumsum(rng.normal(size=(2, MOMENTS, 4)), axis=1)
    cost = np.square(first[:, None] - second[None]).sum(axis=2)
    total = np.full((MOMENTS + 1, MOMENTS + 1), np.inf)
    total[0, 0] = 0.0
    for row in range(MOMENTS):
        for column in range(max(0, row - 8), min(MOMENTS, row + 9)):
            before = min(total[row, column], total[row, column + 1], total[row + 1, column])
            total[row + 1, column + 1] = cost[row, column] + before
    (match,) = SignIndex(["X"], second[None]).nearest(first)
    assert match.distance == pytest.approx(np.sqrt(total[-1, -1] / MOMENTS))


@pytest.mark.slow
def test_what_was_captured_of_one_take_is_the_first_for_another(robot: Robot, tmp_path: Path) -> None:
    bags = [write_bag(tmp_path / f"{seed}.mcap", signing(seed=seed, rate=15.0)) for seed in range(2)]
    assert "none of the table" in run("recognise", bags[1]).output  # before somebody taught it
    captured = run("capture", bags[0], "--gloss", "INVENTADA", "--no-draw")
    assert captured.exit_code == 0, captured.output
    result = run("recognise", bags[1])
    assert result.exit_code == 0, result.output
    assert result.output.split("\n")[1].split()[0] == "INVENTADA"
    assert "surely INVENTADA" in result.output
    refused = run("recognise", write_bag(tmp_path / "still.mcap", signing(moves=[], rate=15.0)))
    assert refused.exit_code == 1
    assert refused.output.startswith("no_motion")
    left = recording_appearance(robot, signing(), handedness="left")
    assert left.shape == (MOMENTS, 32)


def test_a_new_sign_that_is_nearly_another_is_warned_of(robot: Robot, table: Lut, few: Path) -> None:
    casa = table["CASA"]
    found = similar_signs(robot, casa, few)
    assert "CASA" not in [one.gloss for one in found]  # an entry made anew is not like itself
    same = replace(casa, gloss="HOGAR")
    assert similar_signs(robot, same, few)[0].warning("HOGAR") == "HOGAR is the same motion as CASA."
    knots = casa.knots.copy()
    knots[:, casa.joints.index(RIGHT_HAND[3])] *= 0.5
    near = replace(casa, gloss="HOGAR", knots=knots)
    nearest = similar_signs(robot, near, few)
    assert nearest[0].gloss == "CASA"
    assert "looks nearly like CASA" in str(nearest[0].warning("HOGAR"))
    assert [one.seen for one in nearest] == sorted(one.seen for one in nearest)
    assert not any(one.warning("HOLA") for one in similar_signs(robot, table["HOLA"], few))
    assert similar_signs(robot, casa, few / "nowhere") == ()


def largest(compared: Comparison) -> str:
    parts = ("handshape", "orientation", "place", "movement")
    return max(parts, key=lambda part: asdict(compared)[part])


@pytest.mark.parametrize("gloss", ["MADRE", "HOLA"])
def test_a_hand_that_is_closed_where_it_should_be_open_differs_in_handshape(
    robot: Robot, table: Lut, gloss: str
) -> None:
    right = table[gloss]
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
def test_the_part_that_was_changed_is_named(
    robot: Robot, table: Lut, part: str, changed: slice, by: np.ndarray
) -> None:
    meant = sign_appearance(robot, table["MADRE"])
    shown = meant.copy()
    shown[:, changed] += by
    assert largest(compare("MADRE", shown, meant)) == part


def test_recognise_says_what_differs_from_the_sign_that_was_meant(few: Path, tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "take.mcap", signing(rate=15.0))
    result = run("recognise", bag, "--lut", few, "--meant", "CASA", "--json")
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert len(told["matches"]) == 5
    assert told["compared"]["gloss"] == "CASA"
    assert not told["compared"]["hands"]  # one hand signs in the recording
    unknown = run("recognise", bag, "--lut", few, "--meant", "SIN_SIGNO", "--json")
    assert json.loads(unknown.stdout)["code"] == "unknown_sign"


def test_a_sign_of_two_hands_made_with_one_is_named_so(robot: Robot, table: Lut) -> None:
    two = sign_appearance(robot, table["CASA"])
    one = two.copy()
    one[:, HAND:] = 0.0
    compared = compare("CASA", one, two)
    assert not compared.hands
    assert compared.handshape == 0.0  # the hand that is there is right
