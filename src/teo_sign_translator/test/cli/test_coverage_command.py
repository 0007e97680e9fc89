# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut coverage` as a teacher uses it, without the table's package."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner, Result

from teo_sign_translator.cli.coverage import coverage

_RUNNER = CliRunner()


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """A table of entries as far as this command reads them."""
    folder = tmp_path / "table"
    folder.mkdir()
    for gloss, standing in (("CASA", "measured"), ("YO", "described"), ("PERRO", "sketched")):
        entry = {"gloss": gloss, "kind": "lexical", "provenance": {"standing": standing}}
        (folder / f"{gloss}.json").write_text(json.dumps(entry), encoding="utf-8")
    return folder


def _run(*arguments: str, table: Path | None = None) -> Result:
    app = typer.Typer()
    app.command()(coverage)
    lut = [] if table is None else ["--lut", str(table)]
    return _RUNNER.invoke(app, [*arguments, *lut])


def test_a_text_is_shown_word_by_word_with_what_is_wanted_next(table: Path) -> None:
    result = _run("--text", "Mi perro está en casa.", table=table)
    assert result.exit_code == 0
    assert "CASA" in result.stdout
    assert "P-E-RR-O" in result.stdout
    assert "PERRO (a guess so far)" in result.stdout
    assert "not signed: " in result.stdout


def test_a_file_is_counted_as_json(table: Path, tmp_path: Path) -> None:
    text = tmp_path / "text.txt"
    text.write_text("Mi perro está en casa.\n\nMi casa.\n", encoding="utf-8")
    result = _run(str(text), "--json", table=table)
    counted = json.loads(result.stdout)
    assert counted["sentences"] == 2
    assert counted["guessed"] == {"PERRO": 1}
    assert counted["showings"]["sign"] >= 2
    assert counted["words"] == sum(counted["showings"].values())


@pytest.mark.parametrize("arguments", [(), ("file.txt", "--text", "Hola")])
def test_either_a_file_or_a_text_is_wanted(arguments: tuple[str, ...], table: Path) -> None:
    assert _run(*arguments, table=table).exit_code == 2


def test_a_line_that_cannot_be_translated_is_named_and_the_rest_counted(table: Path, tmp_path: Path) -> None:
    text = tmp_path / "text.txt"
    text.write_text("Mi casa.\nпривет\n", encoding="utf-8")
    result = _run(str(text), "--json", table=table)
    assert result.exit_code == 1
    assert json.loads(result.stdout)["refused_lines"] == 1


@pytest.mark.parametrize("content", [b"\xff\xfe", None])
def test_a_file_that_cannot_be_read_is_refused(content: bytes | None, table: Path, tmp_path: Path) -> None:
    file = tmp_path / "text.txt"
    if content is not None:
        file.write_bytes(content)
    result = _run(str(file), table=table)
    assert result.exit_code == 1
    assert "invalid_data" in result.output


def test_without_a_table_it_says_so() -> None:
    result = _run("--text", "Hola")
    assert result.exit_code == 1
    assert "--lut" in result.output
