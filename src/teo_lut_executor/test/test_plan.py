# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from teo_description.humanoid import load_humanoid
from teo_lut_executor.cli.plan import app
from teo_names import COMMANDED_JOINTS, joint_limits

REST = load_humanoid().ready

# What it does must not depend on ROS: importing it would fail here.
_RUN = "import sys; sys.modules['rclpy'] = None; from teo_lut_executor.cli.plan import main; main()"


def run(*arguments: str | Path) -> Result:
    return CliRunner(env={"COLUMNS": "100"}).invoke(app, list(map(str, arguments)))


def test_a_sentence_is_planned_to_a_table_and_a_csv(table_directory: Path, tmp_path: Path) -> None:
    csv = tmp_path / "plan.csv"
    arguments = ["TÚ CASA A-N-A 7", "--lut", str(table_directory), "--csv", str(csv)]
    environment = os.environ | {"COLUMNS": "100"}
    command = [sys.executable, "-c", _RUN, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    rows = [line.strip("│┃ ").split() for line in done.stdout.splitlines() if "│" in line]
    cells = [[cell for cell in row if cell != "│"] for row in rows]
    assert [row[:2] for row in cells] == [
        ["TÚ", "lexical"],
        ["CASA", "lexical"],
        ["A", "letter"],
        ["N", "letter"],
        ["A", "letter"],
        ["7", "number"],
    ]
    assert "start [s]" in done.stdout and "duration [s]" in done.stdout
    starts = [float(row[2]) for row in cells]
    assert starts == sorted(starts) and all(float(row[4]) >= 1.0 for row in cells)
    assert "from rest to rest" in done.stdout and "nearest to itself" in done.stdout
    assert "% of its limit" in done.stdout

    lines = csv.read_text().splitlines()
    assert lines[0] == ",".join(("time", *COMMANDED_JOINTS))
    content = np.loadtxt(lines[1:], delimiter=",")
    np.testing.assert_allclose(content[:, 0], np.arange(len(content)) / 100.0)
    limits = joint_limits()
    assert (content[:, 1:] >= limits.lower - 1e-8).all() and (content[:, 1:] <= limits.upper + 1e-8).all()
    np.testing.assert_allclose(content[[0, -1], 1:], [REST, REST], atol=1e-8)
    speed = np.abs(np.diff(content[:, 1:], axis=0)) * 100.0
    assert (speed <= limits.velocity + 1e-6).all()
    assert list(tmp_path.glob(".plan*")) == []


@pytest.mark.parametrize(
    ("sentence", "options", "said"),
    [
        ("¿TÚ CASA?", [], "head: forward "),
        ("TÚ CASA", ["--negated"], "head: shake "),
        ("TÚ CASA?", ["--type", "statement", "--affirmed"], None),
    ],
)
def test_the_form_of_a_sentence_is_shown_with_the_head(
    table_directory: Path, sentence: str, options: list[str], said: str | None
) -> None:
    done = run(sentence, "--lut", table_directory, *options)
    assert done.exit_code == 0, done.stderr
    (*_, last) = done.stdout.splitlines()
    assert last.startswith(said) if said else "head" not in done.stdout


def test_a_left_handed_signer_moves_the_left_arm(table_directory: Path, tmp_path: Path) -> None:
    moved: dict[str, set[str]] = {}
    for name, options in (("right", []), ("left", ["--left"])):
        done = run("TÚ", "--lut", table_directory, "--csv", tmp_path / f"{name}.csv", *options)
        assert done.exit_code == 0, done.stderr
        content = np.loadtxt((tmp_path / f"{name}.csv").read_text().splitlines()[1:], delimiter=",")[:, 1:]
        joints = zip(COMMANDED_JOINTS, np.ptp(content, axis=0) > 0.01, strict=True)
        moved[name] = {joint for joint, moves in joints if moves}
    assert moved["right"] and not any("Left" in joint for joint in moved["right"])
    assert moved["left"] == {joint.replace("Right", "Left") for joint in moved["right"]}


def test_slower_limits_give_a_slower_plan(table_directory: Path) -> None:
    def duration(*options: str) -> float:
        done = run("TÚ", "--lut", table_directory, *options)
        (line,) = [line for line in done.stdout.splitlines() if "from rest to rest" in line]
        return float(line.split()[0])

    assert duration("--acceleration", "1.0", "--jerk", "5.0") > duration() + 1.0


@pytest.mark.parametrize(
    ("sentence", "options", "status", "said"),
    [
        ("TÚ Ω", [], 1, "unknown_sign: "),
        ("", [], 1, "empty_sentence: "),
        ("A--N", [], 1, "bad_gloss: "),
        ("TÚ", ["--jerk", "0"], 1, "bad_limits: "),
        ("TÚ", ["--hand-drive", "hydraulic"], 1, "bad_limits: hand_drive: expected one of spool_380"),
        ("TÚ", ["--jerk", "many"], 2, "valid number"),
        ("TÚ", ["--type", "order"], 2, "statement"),
        ("TÚ", ["--csv", "no/such/folder/plan.csv"], 1, "cannot write "),
        ("TÚ", ["--lut", "no/such/table"], 1, "no_directory: "),
    ],
)
def test_what_goes_wrong_is_said(
    table_directory: Path, sentence: str, options: list[str], status: int, said: str
) -> None:
    where = [] if "--lut" in options else ["--lut", str(table_directory)]
    done = run(sentence, *where, *options)
    assert done.exit_code == status
    assert said in done.stderr
    assert isinstance(done.exception, SystemExit), "no other error leaves the command"


def test_pictures_are_drawn(table_directory: Path, tmp_path: Path) -> None:
    strip, film = tmp_path / "plan.png", tmp_path / "plan.mp4"
    done = run("_", "--lut", table_directory, "--strip", strip, "--mp4", film)  # the shortest
    assert done.exit_code == 0, done.stderr
    assert strip.read_bytes().startswith(b"\x89PNG") and film.stat().st_size > 1000
