# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from typer.testing import CliRunner

from teo_sign_translator.cli.translate import app

RUNNER = CliRunner()


def _run(*arguments: str, stdin: bytes = b"") -> tuple[int, str, str]:
    """Status, output and errors, with the published model, whose answers never change."""
    result = RUNNER.invoke(app, ["--model", "lstm256", *arguments], input=stdin)
    return result.exit_code, result.stdout, result.stderr


def test_a_text_gives_a_line_of_glosses() -> None:
    assert _run("¿Qué tal?") == (0, "TÚ BIEN\n", "")
    assert _run("Hola, me llamo Ana. ¿Qué tal?") == (0, "HOLA MI NOMBRE A-N-A TÚ BIEN\n", "")


def test_standard_input_gives_a_line_for_each_line_whatever_happens() -> None:
    lines = "Hola, me llamo Ana.\n\nПривет\r\nque tal\n".encode() + b"d\xedas\nYo tengo 7 a\xc3\xb1os"
    code, out, err = _run("--stdin", stdin=lines)
    assert out == "HOLA MI NOMBRE A-N-A\n\n\nTÚ BIEN\n\nYO EDAD 7\n"
    assert [line.split(":")[:2] for line in err.splitlines()] == [
        ["line 3", " unsignable_text"],
        ["line 5", " broken_encoding"],
    ]
    assert code == 1


def test_a_file_gives_the_same_as_standard_input(tmp_path: Path) -> None:
    lines = "Hola, me llamo Ana.\n\nПривет\r\nque tal\n".encode() + b"d\xedas\n"
    path = tmp_path / "texts.txt"
    path.write_bytes(lines * 60)
    code, out, err = _run("--file", str(path))
    assert out == "HOLA MI NOMBRE A-N-A\n\n\nTÚ BIEN\n\n" * 60
    refused = [number for number in range(1, 301) if number % 5 in (3, 0)]
    assert [line.split(":")[0] for line in err.splitlines()] == [f"line {number}" for number in refused]
    assert code == 1


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    code, out, err = _run("--file", str(tmp_path / "none"))
    assert (code, out) == (1, "")
    assert err.startswith("invalid_data: ")


def test_what_has_no_sign_is_spelled(tmp_path: Path) -> None:
    path = tmp_path / "signs.txt"
    path.write_text("HOLA\nCHAO\n", encoding="utf-8")
    assert _run("--signs", str(path), "Hola. Adiós. Gracias.") == (0, "HOLA CHAO G-R-A-C-I-A-S\n", "")


def test_json_holds_everything_one_object_a_line() -> None:
    # In a process, whose streams take what was typed of broken bytes.
    command = [sys.executable, "-m", "teo_sign_translator.cli.translate", "--model", "lstm256"]
    typed = "Me llamo Ana\n\nмир\n".encode() + b"d\xed\n"
    done = subprocess.run(
        [*command, "--stdin", "--json"], input=typed, capture_output=True, timeout=120, check=False
    )
    good, blank, refused, broken = map(json.loads, done.stdout.decode().splitlines())
    assert done.returncode == 1
    assert good["glosses"] == "MI NOMBRE A-N-A"
    assert [token["kind"] for token in good["sentences"][0]["tokens"]] == ["lexical"] * 2 + ["letter"] * 3
    assert blank == {"text": "", "glosses": "", "sentences": []}
    assert refused["error"]["code"] == "unsignable_text"
    assert broken["error"]["code"] == "broken_encoding"


def test_a_text_that_cannot_be_translated_is_refused_with_a_reason() -> None:
    code, out, err = _run("😀")
    assert (code, out) == (1, "")
    assert err.startswith("nothing_to_sign: ")


def test_an_unknown_model_is_refused_with_those_available() -> None:
    code, out, err = _run("--model", "gpt", "Hola")
    assert (code, out) == (1, "")
    assert err.endswith("(lstm256, pointer), got 'gpt'\n")
    assert err.count("\n") == 1, "on one line, which can be searched for"


def test_the_models_are_listed() -> None:
    code, out, err = _run("--list-models")
    assert (code, err) == (0, "")
    assert "lstm256" in out.split()


@pytest.mark.parametrize("arguments", [[], ["Hola", "--stdin"], ["--stdin", "--file", "x"]])
def test_text_or_standard_input_is_needed_but_not_both(arguments: list[str]) -> None:
    code, out, err = _run(*arguments)
    assert (code, out) == (2, "")
    assert "either a text, --stdin" in err


def test_the_help_breaks_no_line_that_has_room_for_the_next_word() -> None:
    described = RUNNER.invoke(app, ["--help"], env={"COLUMNS": "80", "TERMINAL_WIDTH": "80"}).stdout
    paragraphs = described.partition("\n\n")[2].partition("Arguments:")[0].split("\n\n")
    assert any(len(paragraph.splitlines()) > 2 for paragraph in paragraphs)
    for before, line in (pair for each in paragraphs for pair in pairwise(each.splitlines())):
        assert len(f"{before} {line.split()[0]}") > 72, (before, line)
