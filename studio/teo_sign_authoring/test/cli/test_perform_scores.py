# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`perform_scores`: a script and a recording a sign, nothing twice, a reason for what fails."""

from __future__ import annotations

from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner, Result

from teo_sign_authoring.cli.perform_scores import perform_scores
from teo_sign_capture.recordings.skeleton_bag import read_skeletons

SCORE = """\
gloss: {gloss}
standing: sketched
source: a test
hands: right
steps:
  - right: {{shape: flat, place: chin, part: fingertips, palm: back, fingers: up in}}
    hold: 0.1
"""


def run(*words: object) -> Result:
    app = typer.Typer()
    app.command()(perform_scores)
    return CliRunner().invoke(app, list(map(str, words)), env={"COLUMNS": "300", "TERM": "dumb"})


@pytest.fixture
def scores(tmp_path: Path) -> Path:
    folder = tmp_path / "scores"
    folder.mkdir()
    for gloss in ("UNO", "DOS"):
        (folder / f"{gloss}.yaml").write_text(SCORE.format(gloss=gloss), "utf-8")
    return folder


def test_a_sign_is_performed_once_and_kept(tmp_path: Path, scores: Path) -> None:
    out = tmp_path / "out"
    words = ("--out", out, "--scores", scores, "--only", "UNO", "--truth-only", "--rate", 4)
    first = run(*words)
    assert first.exit_code == 0, first.output
    assert "1 signs performed" in first.output
    track = read_skeletons(out / "UNO", topic="/truth/skeletons")
    assert track.times[-1] == pytest.approx(2.2, abs=0.25)  # rest, way, hold, way, rest
    again = run(*words)
    assert again.exit_code == 0 and "0 signs performed, 1 kept" in again.output
    assert sorted(path.name for path in out.iterdir()) == ["UNO", "UNO.yaml"]
    scripts = run("--out", out, "--scores", scores, "--scripts-only")
    assert scripts.exit_code == 0, scripts.output
    assert sorted(path.name for path in out.iterdir()) == ["DOS.yaml", "UNO", "UNO.yaml"]


def test_what_cannot_be_performed_is_named_and_leaves_nothing(tmp_path: Path, scores: Path) -> None:
    out = tmp_path / "out"
    result = run("--out", out, "--scores", scores, "--only", "UNO", "--body", "nobody")
    assert result.exit_code == 1
    assert "not_performed: UNO: expected a body of" in result.output
    assert sorted(path.name for path in out.iterdir()) == ["UNO.yaml"]


def test_a_sign_without_score_and_a_place_that_is_a_file_are_refused(tmp_path: Path, scores: Path) -> None:
    result = run("--out", tmp_path / "out", "--scores", scores, "--only", "TRES")
    assert result.exit_code == 1
    assert "unknown_sign" in result.output and "TRES" in result.output
    assert not (tmp_path / "out").exists()
    (tmp_path / "file").write_text("a file")
    result = run("--out", tmp_path / "file", "--scores", scores)
    assert result.exit_code == 1 and "not_written" in result.output
