# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut coverage` as a teacher uses it, without the table's package."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner, Result

from teo_sign_translator.cli.coverage import coverage

_RUNNER = CliRunner()


#: Signs of a table, with their standing.
SIGNS = {
    "CASA": "measured", "YO": "described", "COCHE": "reviewed", "DINERO": "recorded", "MÁQUINA": "recorded",
    "PERRO": "sketched",
}  # fmt: skip
GUESS = "PERRO (a guess so far)"
TEXT = "Mi perro está en casa.\n\nYo tengo 7 autos, Ana.\nMi cajero.\n"


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """A table of entries as far as this command reads them."""
    folder = tmp_path / "table"
    folder.mkdir()
    for gloss, standing in SIGNS.items():
        entry = {"gloss": gloss, "kind": "lexical", "provenance": {"standing": standing}}
        (folder / f"{gloss}.json").write_text(json.dumps(entry), encoding="utf-8")
    return folder


def _run(*arguments: str, table: Path | None = None) -> Result:
    app = typer.Typer()
    app.command()(coverage)
    lut = [] if table is None else ["--lut", str(table)]
    return _RUNNER.invoke(app, [*arguments, *lut])


def test_a_text_is_shown_word_by_word_with_what_is_wanted_next(table: Path) -> None:
    result = _run("--text", TEXT, table=table)
    assert result.exit_code == 0
    rows = [re.split(r"\s{2,}", line.strip()) for line in result.stdout.splitlines()]
    shown = {"CASA": "CASA", "AUTO": "COCHE", "CAJERO": "DINERO MÁQUINA", "PERRO": "P-E-RR-O", "7": "7"}
    assert [word for word, signs in shown.items() if [word, signs] not in [row[:2] for row in rows]] == []
    wanted = [(row[0], row[1], row[-1]) for row in rows if len(row) == 4]
    first = "Mi perro está en casa."
    assert wanted == [("wanted next", "times", "first in"), ("MI", "2", first), (GUESS, "1", first)]
    assert GUESS not in _run("--text", TEXT, "--wanted", "1", table=table).stdout
    assert "not signed: está en" in result.stdout


def test_a_file_is_counted_as_json_and_a_line_that_cannot_be_translated_is_named(
    table: Path, tmp_path: Path
) -> None:
    text = tmp_path / "text.txt"
    text.write_text(TEXT + "привет\n", encoding="utf-8")
    result = _run(str(text), "--json", table=table)
    assert result.exit_code == 1
    assert "unsignable_text" in result.stderr
    assert json.loads(result.stdout) == {
        "words": 9,
        "signed": 5,  # a paraphrase counts once
        "showings": {"sign": 2, "number": 1, "substitute": 2, "guess": 1, "name": 1, "letters": 2},
        "sentences": 3,
        "whole": 1,  # a spelled name is no lack
        "refused_lines": 1,
        "missing": {"MI": 2},
        "guessed": {"PERRO": 1},
        "dropped": {"está": 1, "en": 1, "tengo": 1},
    }


@pytest.mark.parametrize("arguments", [(), ("file.txt", "--text", "Hola")])
def test_either_a_file_or_a_text_is_wanted(arguments: tuple[str, ...], table: Path) -> None:
    assert _run(*arguments, table=table).exit_code == 2


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
