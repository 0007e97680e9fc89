# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
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


def run(line: str) -> Result:
    return CliRunner(env={"COLUMNS": "400"}).invoke(app, line.split())


def lines(text: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.splitlines()]


def test_a_capture_says_what_it_made_and_how_well(bag: Path, tmp_path: Path) -> None:
    table = tmp_path / "lut"
    result = run(f"capture {bag} --gloss SIGNO --lut {table} --notes Teacher_A. --hands right")
    assert result.exit_code == 0, result.output
    for words in ("SIGNO: right", "palm error p95", "stretch", "Teacher_A.", f"wrote {table / 'SIGNO.png'}"):
        assert words in result.output
    (palm,) = (row for row in result.output.splitlines() if "palm error p95" in row)
    assert palm.split()[-4:] == ["good:", "at", "most", "50"]
    assert "same zone of middle" in result.output
    assert (table / "SIGNO.png").is_file()
    assert run(f"validate {table}").exit_code == 0
    assert run(f"record --gloss SIGNO --lut {table}").output.startswith("exists: SIGNO.json")


def test_a_sign_of_another_language_by_another_robot_goes_to_their_table(bag: Path, data_home: Path) -> None:
    wanted = f"capture {bag} --gloss SIGNO --language ase --robot gr1t2"
    result = run(f"{wanted} --no-draw --hands right --json")
    assert result.exit_code == 0, result.output
    assert lines(result.stdout)[0]["similar"]  # of the signs of that table
    sign, humanoid = Lut.open(language="ase", robot="gr1t2")["SIGNO"], load_humanoid("gr1t2")
    assert sign.language == "ase"
    assert set(humanoid.arm("right")) <= set(sign.joints) <= set(humanoid.commanded_joints)
    assert sign.quality["palm_error_p95_deg"] < 30.0
    assert (data_home / "teo" / "lut" / "ase" / "gr1t2" / "SIGNO.json").is_file()
    assert run(wanted).output.startswith("exists: SIGNO.json")
    assert "unknown_language" in run(f"capture {bag} --gloss SIGNO --language xxx").output
    assert "unknown_robot" in run(f"capture {bag} --gloss SIGNO --robot nobody").output


def test_several_signs_are_listed_and_what_is_suggested_works(tmp_path: Path) -> None:
    later = [(start + 3.0, end + 3.0, place) for start, end, place in SIGN]
    bag = write_bag(tmp_path / "two.mcap", signing(moves=[*SIGN, *later], duration=6.2, rate=15.0))
    line = f"capture {bag} --gloss SIGNO --lut {tmp_path} --no-draw"
    refused = run(line)
    assert refused.exit_code == 1
    assert "several_signs" in refused.output
    suggested = refused.output.split("Take one: ")[1].split(";")[0]
    assert suggested.startswith("--start")
    assert run(f"{line} {suggested}").exit_code == 0


def test_without_a_table_a_sign_goes_to_the_users_own_and_is_found_there_first(
    bag: Path, data_home: Path
) -> None:
    own = data_home / "teo" / "lut"
    taken = run(f"capture {bag} --gloss CASA --no-draw")
    assert taken.exit_code == 1
    assert taken.output.startswith("exists")
    assert run(f"capture {bag} --gloss CASA --no-draw --replace").exit_code == 0
    assert [path.name for path in own.iterdir()] == ["CASA.json"]
    assert str(own / "CASA.json") in run("show CASA").output


def test_a_program_reads_what_became_of_a_sign_and_how_it_stands_at_each_gate(
    bag: Path, tmp_path: Path
) -> None:
    made = run(f"capture {bag} --gloss SIGNO --lut {tmp_path} --json")
    (outcome,) = lines(made.stdout)
    assert (outcome["gloss"], outcome["code"]) == ("SIGNO", "captured")
    assert outcome["files"] == [str(tmp_path / "SIGNO.json"), str(tmp_path / "SIGNO.png")]
    assert outcome["quality"] == Lut.open(tmp_path)["SIGNO"].quality
    assert outcome["gates"] and all(gate["passed"] for gate in outcome["gates"])
    said = lines(made.stderr)
    assert {line["event"] for line in said} == {"progress"}
    assert "drawing" in [line["what"] for line in said]


@pytest.mark.slow
def test_a_trial_leaves_the_table_alone_and_knows_what_it_holds(bag: Path, tmp_path: Path) -> None:
    table, trial = tmp_path / "lut", tmp_path / "trial"
    line = f"capture {bag} --lut {table}"
    assert run(f"{line} --gloss NUEVA_SEÑA --no-draw").exit_code == 0
    (outcome,) = lines(run(f"{line} --gloss SEÑA --trial {trial} --json").stdout)
    assert outcome["files"] == [str(trial / "SEÑA.json"), str(trial / "SEÑA.png")]
    assert outcome["similar"][0] == {"gloss": "NUEVA_SEÑA", "seen": 0.0}
    assert [path.name for path in table.iterdir()] == ["NUEVA_SEÑA.json"]
    # A sign that is there already may be tried again.
    assert run(f"{line} --gloss NUEVA_SEÑA --trial {trial} --no-draw").exit_code == 0


def test_a_gloss_may_be_typed_in_lower_case(tmp_path: Path) -> None:
    refused = run(f"capture {tmp_path}/nowhere.mp4 --gloss seña --lut {tmp_path} --json")
    (outcome,) = lines(refused.stdout)
    assert (outcome["code"], outcome["gloss"]) == ("no_bag", "SEÑA")


def test_who_reads_why_a_sign_is_refused_may_accept_it(tmp_path: Path) -> None:
    # Between two places before the body: the recording begins and ends within the sign.
    moves = [(-1.0, -0.5, OUT), (0.3, 0.9, (0.28, -0.06, 0.02)), (1.1, 1.7, OUT)]
    bag = write_bag(tmp_path / "take.mcap", signing(moves=moves, duration=2.0, rate=15.0))
    table = tmp_path / "lut"
    line = f"capture {bag} --gloss SIGNO --hands right --lut {table} --no-draw"
    refused = run(f"{line} --json")
    assert refused.exit_code == 1
    (outcome,) = lines(refused.stdout)
    assert outcome["code"] == "no_rest"
    assert [gate["code"] for gate in outcome["gates"] if not gate["passed"]] == ["no_rest"]
    assert "from rest to rest" in outcome["message"]
    assert not table.exists()
    assert run(f"{line} --accept").exit_code == 0
    provenance = Lut.open(table)["SIGNO"].provenance
    assert provenance.standing == "measured"
    assert "begins and ends within it" in provenance.notes


@pytest.mark.slow
def test_a_folder_is_reported_sign_by_sign_to_a_program_and_in_sum_to_a_person(tmp_path: Path) -> None:
    folder = tmp_path / "recordings"
    write_bag(folder / "HOLA.mcap", signing(rate=15.0))
    write_bag(folder / "NADA.mcap", signing(moves=[], rate=15.0))
    line = f"capture {folder} --lut {tmp_path}/lut --jobs 1 --no-draw"
    told = run(f"{line} --json")
    assert {one["gloss"]: one["code"] for one in lines(told.stdout)} == {
        "HOLA": "captured",
        "NADA": "no_motion",
    }
    assert [(said["done"], said["total"]) for said in lines(told.stderr)] == [(0, 2), (1, 2), (2, 2)]
    again = run(line)
    assert again.exit_code == 1
    assert "0 captured, 1 as before, 1 failed" in again.output
    assert "no_motion" in again.output


@pytest.mark.parametrize(
    "arguments",
    [
        "",
        "BAG",
        "FOLDER --start 1",
        "FOLDER FOLDER",
        "FOLDER --manifest a.csv",
        "BAG --gloss A --manifest a.csv",
    ],
)
def test_options_that_do_not_go_together_are_refused(bag: Path, tmp_path: Path, arguments: str) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    given = arguments.replace("BAG", str(bag)).replace("FOLDER", str(folder))
    result = run(f"capture {given} --lut {tmp_path}")
    assert result.exit_code == 1
    assert result.output.startswith("bad_arguments")
    (told,) = lines(run(f"capture {given} --json").stdout)
    assert (told["code"], told["gates"]) == ("bad_arguments", [])
