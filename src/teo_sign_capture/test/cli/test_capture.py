# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a teacher sees of `lut capture` and `lut record`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from made_bags import OUT, SIGN, signing, write_bag
from typer.testing import CliRunner, Result

from teo_description.humanoid import load_humanoid
from teo_lut_executor.cli.lut import app
from teo_signs.look_up_table import Lut


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    return write_bag(tmp_path / "take.mcap", signing(rate=15.0))


def run(*arguments: str | Path) -> Result:
    return CliRunner(env={"COLUMNS": "200"}).invoke(app, [str(argument) for argument in arguments])


def test_a_capture_says_what_it_made_and_how_well(bag: Path, tmp_path: Path) -> None:
    table = tmp_path / "lut"
    result = run(
        "capture", bag, "--gloss", "SIGNO", "--lut", table, "--notes", "Teacher A.", "--hands", "right"
    )
    assert result.exit_code == 0, result.output
    for words in ("SIGNO: right", "palm error p95", "stretch", "Teacher A.", f"wrote {table / 'SIGNO.png'}"):
        assert words in result.output
    assert (table / "SIGNO.png").is_file()
    assert run("validate", table).exit_code == 0
    again = run("capture", bag, "--gloss", "SIGNO", "--lut", table)
    assert again.exit_code == 1
    assert again.output.startswith("exists: SIGNO.json")
    assert run("record", "--gloss", "SIGNO", "--lut", table).output.startswith("exists: SIGNO.json")


def test_a_sign_is_captured_for_another_robot(bag: Path, tmp_path: Path) -> None:
    result = run(
        "capture",
        bag,
        "--gloss",
        "SIGNO",
        "--robot",
        "gr1t2",
        "--lut",
        tmp_path,
        "--no-draw",
        "--hands",
        "right",
    )
    assert result.exit_code == 0, result.output
    sign = Lut.open(tmp_path, robot="gr1t2")["SIGNO"]
    humanoid = load_humanoid("gr1t2")
    assert set(humanoid.arm("right")) <= set(sign.joints) <= set(humanoid.commanded_joints)
    assert sign.quality["palm_error_p95_deg"] < 30.0
    assert "unknown_robot" in run("capture", bag, "--gloss", "SIGNO", "--robot", "nobody").output


def test_several_signs_are_listed_and_what_is_suggested_works(tmp_path: Path) -> None:
    later = [(start + 3.0, end + 3.0, place) for start, end, place in SIGN]
    bag = write_bag(tmp_path / "two.mcap", signing(moves=[*SIGN, *later], duration=6.2, rate=15.0))
    refused = run("capture", bag, "--gloss", "SIGNO", "--lut", tmp_path, "--no-draw")
    assert refused.exit_code == 1
    assert "several_signs" in refused.output
    suggested = refused.output.split("Take one: ")[1].split(";")[0].split()
    assert suggested[0] == "--start"
    assert run("capture", bag, "--gloss", "SIGNO", "--lut", tmp_path, "--no-draw", *suggested).exit_code == 0


def test_without_a_table_a_sign_goes_to_the_users_own_and_is_found_there_first(
    bag: Path, data_home: Path
) -> None:
    own = data_home / "teo" / "lut"
    assert run("capture", bag, "--gloss", "SIGNO", "--no-draw").exit_code == 0
    assert [path.name for path in own.iterdir()] == ["SIGNO.json"]
    assert str(own / "SIGNO.json") in run("show", "SIGNO").output
    taken = run("capture", bag, "--gloss", "CASA", "--no-draw")
    assert taken.exit_code == 1
    assert taken.output.startswith("exists")
    assert run("capture", bag, "--gloss", "CASA", "--no-draw", "--replace").exit_code == 0
    assert Lut.open().path("CASA") == own / "CASA.json"


@pytest.mark.slow
def test_a_folder_ends_with_a_table_of_failures_and_resumes(tmp_path: Path) -> None:
    folder, table = tmp_path / "recordings", tmp_path / "lut"
    write_bag(folder / "HOLA.mcap", signing(rate=15.0))
    write_bag(folder / "NADA.mcap", signing(moves=[], rate=15.0))
    first = run("capture", folder, "--lut", table, "--jobs", "1", "--no-draw")
    assert first.exit_code == 1
    assert "1 captured, 0 as before, 1 failed" in first.output
    assert "no_motion" in first.output
    (folder / "NADA.mcap").unlink()
    second = run("capture", folder, "--lut", table, "--jobs", "1", "--no-draw")
    assert second.exit_code == 0
    assert "0 captured, 1 as before, 0 failed" in second.output
    assert Lut.open(table).glosses() == ("HOLA",)


def lines(text: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.splitlines()]


def test_a_program_reads_what_became_of_a_sign_and_how_it_stands_at_each_gate(
    bag: Path, tmp_path: Path
) -> None:
    made = run("capture", bag, "--gloss", "SIGNO", "--lut", tmp_path, "--json")
    (outcome,) = lines(made.stdout)
    assert (outcome["gloss"], outcome["code"]) == ("SIGNO", "captured")
    assert outcome["files"] == [str(tmp_path / "SIGNO.json"), str(tmp_path / "SIGNO.png")]
    assert outcome["quality"] == Lut.open(tmp_path)["SIGNO"].quality
    assert outcome["gates"] and all(gate["passed"] for gate in outcome["gates"])
    said = lines(made.stderr)
    assert {line["event"] for line in said} == {"progress"}
    assert "drawing" in [line["what"] for line in said]


@pytest.mark.slow
def test_a_trial_leaves_the_table_alone_and_knows_what_it_holds(
    bag: Path, tmp_path: Path, data_home: Path
) -> None:
    own, trial = data_home / "teo" / "lut", tmp_path / "trial"
    assert run("capture", bag, "--gloss", "SIGNO", "--no-draw").exit_code == 0
    (outcome,) = lines(run("capture", bag, "--gloss", "SEÑA", "--trial", trial, "--json").stdout)
    assert outcome["files"] == [str(trial / "SEÑA.json"), str(trial / "SEÑA.png")]
    assert outcome["similar"][0] == {"gloss": "SIGNO", "seen": 0.0}
    assert [path.name for path in own.iterdir()] == ["SIGNO.json"]
    # A sign that is there already may be tried again.
    assert run("capture", bag, "--gloss", "SIGNO", "--trial", trial, "--no-draw").exit_code == 0


def test_a_gloss_may_be_typed_in_lower_case(tmp_path: Path) -> None:
    refused = run("capture", tmp_path / "nowhere.mp4", "--gloss", "seña", "--lut", tmp_path, "--json")
    (outcome,) = lines(refused.stdout)
    assert (outcome["code"], outcome["gloss"]) == ("no_bag", "SEÑA")


def test_a_program_reads_why_a_sign_is_refused(tmp_path: Path) -> None:
    # Between two places before the body: the recording begins and ends within the sign.
    moves = [(-1.0, -0.5, OUT), (0.3, 0.9, (0.28, -0.06, 0.02)), (1.1, 1.7, OUT)]
    bag = write_bag(tmp_path / "take.mcap", signing(moves=moves, duration=2.0, rate=15.0))
    refused = run("capture", bag, "--gloss", "SIGNO", "--hands", "right", "--lut", tmp_path, "--json")
    assert refused.exit_code == 1
    (outcome,) = lines(refused.stdout)
    assert outcome["code"] == "no_rest"
    assert [gate["code"] for gate in outcome["gates"] if not gate["passed"]] == ["no_rest"]
    (wrong,) = lines(run("capture", "--json").stdout)
    assert (wrong["code"], wrong["gloss"], wrong["gates"]) == ("bad_arguments", "", [])


@pytest.mark.slow
def test_a_program_reads_a_line_for_each_sign_of_a_folder(tmp_path: Path) -> None:
    folder = tmp_path / "recordings"
    write_bag(folder / "HOLA.mcap", signing(rate=15.0))
    write_bag(folder / "NADA.mcap", signing(moves=[], rate=15.0))
    result = run("capture", folder, "--lut", tmp_path / "lut", "--jobs", "1", "--no-draw", "--json")
    assert {one["gloss"]: one["code"] for one in lines(result.stdout)} == {
        "HOLA": "captured",
        "NADA": "no_motion",
    }
    assert [(line["done"], line["total"]) for line in lines(result.stderr)] == [(0, 2), (1, 2), (2, 2)]


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("BAG",),
        ("FOLDER", "--start", "1"),
        ("FOLDER", "FOLDER"),
        ("FOLDER", "--manifest", "signs.csv"),
        ("BAG", "--gloss", "HOLA", "--manifest", "signs.csv"),
    ],
)
def test_options_that_do_not_go_together_are_refused(
    bag: Path, tmp_path: Path, arguments: tuple[str, ...]
) -> None:
    (tmp_path / "folder").mkdir()
    places = {"BAG": bag, "FOLDER": tmp_path / "folder"}
    result = run("capture", *(places.get(argument, argument) for argument in arguments), "--lut", tmp_path)
    assert result.exit_code == 1
    assert result.output.startswith("bad_arguments")
