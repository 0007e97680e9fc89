# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`capture_scores` writes what TEO can sign, and gives the planner's reason for what it cannot."""

from __future__ import annotations

from pathlib import Path

import typer
from typer.testing import CliRunner

from teo_sign_authoring.cli.capture_table import capture_scores

# Each step by itself keeps its hands apart; on the way from one to the next they pass through each other.
CROSSING = """\
gloss: CRUZAR
standing: sketched
source: a test
hands: both
steps:
  - right: {shape: thumb, place: chest 18 front 6 out 3 up, palm: back, fingers: 2 in up}
    left: {shape: thumb, place: chest 18 front 6 out 8 down, palm: back down, fingers: in}
  - times: 2
    steps:
      - time: 0.25
        right: {place: chest 18 front 6 out 8 down, palm: back down, fingers: in}
        left: {place: chest 18 front 6 out 3 up, palm: back, fingers: 2 in up}
      - time: 0.25
        right: {place: chest 18 front 6 out 3 up, palm: back, fingers: 2 in up}
        left: {place: chest 18 front 6 out 8 down, palm: back down, fingers: in}
"""
PLAIN = """\
gloss: UNO
standing: sketched
source: a test
hands: right
steps:
  - right: {shape: flat, place: space, palm: in, fingers: front up}
    hold: 0.1
"""


def test_a_sign_that_collides_as_it_is_planned_is_left_out_with_the_planners_reason(tmp_path: Path) -> None:
    scores, out = tmp_path / "scores", tmp_path / "out"
    scores.mkdir()
    (scores / "CRUZAR.yaml").write_text(CROSSING, "utf-8")
    (scores / "UNO.yaml").write_text(PLAIN, "utf-8")
    app = typer.Typer()
    app.command()(capture_scores)
    result = CliRunner().invoke(app, ["--out", str(out), "--scores", str(scores)], env={"COLUMNS": "300"})
    assert result.exit_code == 1
    assert [path.name for path in out.iterdir()] == ["UNO.json"]
    assert "self_collision: " in result.output and "CRUZAR" in result.output
