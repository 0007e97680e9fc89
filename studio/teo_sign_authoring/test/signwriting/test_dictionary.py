# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A dictionary into a table: names, what is kept, what is refused, damaged files."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from refusals import refused
from typer.testing import CliRunner, Result

from teo_lut_executor.cli.lut import app
from teo_sign_authoring.signwriting.dictionary_file import MOST_BYTES, GlossNames, numbered, read_dictionary
from teo_signs.sign_file import read_sign

SPML = """<?xml version="1.0" encoding="UTF-8"?>
<spml root="http://www.signpuddle.net" type="sgn" puddle="55">
 <term>Diccionario</term>
 <entry id="1"><term>M518x533S1870a489x515</term><term><![CDATA[abuelo 5]]></term></entry>
 <entry id="2"><term>bar</term></entry>
</spml>
"""
TRAY = "M519x510S15a36480x490"
LOOP = "M520x520S15a00480x480S29600500x480"
# A hand high before the head, 20 cm from where TEO's can be so held.
FAR = "M538x556S14c10480x525S20500505x535S1f720518x487S2ff00482x483S22b03510x508"


def run(*words: object) -> Result:
    return CliRunner().invoke(app, ["import", *map(str, words)], env={"COLUMNS": "300", "TERM": "dumb"})


def dictionary(folder: Path, *rows: str) -> Path:
    file = folder / "dictionary.tsv"
    file.write_text("\n".join(("term\tfsw", *rows)), "utf-8")
    return file


@pytest.fixture(scope="module")
def names() -> GlossNames:
    return GlossNames()


@pytest.mark.parametrize(
    ("term", "gloss"),
    [
        ("abuelo 5", "ABUELO"),
        ("carcel 2", "CÁRCEL"),
        ("quien? 13", "QUIÉN"),
        ("POR FIN 1", "POR_FIN"),
        ("cemetery 2", None),
        ("?3", None),
        ("", None),
    ],
)
def test_terms_become_spanish_glosses_or_are_passed_over(
    names: GlossNames, term: str, gloss: str | None
) -> None:
    if gloss == "QUIÉN":  # typed without its accent it may be either word
        assert names.gloss(term) in ("QUIÉN", "QUIEN")
    else:
        assert names.gloss(term) == gloss
    assert numbered(["SOL", None, "SOL", "LUNA", "SOL"]) == ["SOL", None, "SOL_2", "LUNA", "SOL_3"]


def test_an_export_of_signpuddle_is_read(tmp_path: Path) -> None:
    file = tmp_path / "sgn55.spml"
    file.write_text(SPML, "utf-8")
    first, second = read_dictionary(file)
    assert (first.term, first.fsw) == ("abuelo 5", "M518x533S1870a489x515")
    assert (second.term, second.fsw) == ("bar", "")


@pytest.mark.parametrize(
    ("name", "content", "code"),
    [
        ("a.tsv", b"term\tfsw\n", "no_entries"),
        ("a.tsv", b"sol\tM518x533\tmore", "not_tsv"),
        ("a.tsv", b"\xff\xfe\x00", "not_utf8"),
        ("a.spml", SPML.encode()[:150], "not_spml"),
        ("a.spml", b'<!DOCTYPE spml [<!ENTITY a "b">]><spml>&a;</spml>', "not_spml"),
        ("a.spml", b"<spml/>", "no_entries"),
    ],
)
def test_a_damaged_file_is_refused_by_name(tmp_path: Path, name: str, content: bytes, code: str) -> None:
    (tmp_path / name).write_bytes(content)
    with refused(code):
        read_dictionary(tmp_path / name)


def test_a_huge_file_and_none_are_refused(tmp_path: Path) -> None:
    huge = tmp_path / "huge.tsv"
    with huge.open("wb") as file:
        file.truncate(MOST_BYTES + 1)
    for path, code in ((huge, "too_large"), (tmp_path / "none.tsv", "unreadable")):
        with refused(code):
            read_dictionary(path)


def test_what_can_be_read_is_written_the_rest_reported_and_a_second_run_keeps_it(tmp_path: Path) -> None:
    file = dictionary(
        tmp_path, f"bandeja\t{TRAY}", f"lazo\t{LOOP}", f"xqzzt\t{TRAY}", "sol\tnothing", f"lejos\t{FAR}"
    )
    table, report = tmp_path / "lut", tmp_path / "report.json"
    words = ("--signwriting", file, "--lut", table, "--jobs", 1, "--report", report, "--licence", "CC0-1.0")
    first = run(*words, "--scores", tmp_path / "scores")
    assert first.exit_code == 0, first.output
    outcomes = {each["term"]: each for each in json.loads(report.read_text("utf-8"))}
    assert outcomes["bandeja"]["result"] in ("whole", "with_losses")
    codes = [outcomes[term]["code"] for term in ("lazo", "xqzzt", "sol", "lejos")]
    assert codes == ["movement", "unknown_term", "bad_fsw", "off_place"]
    assert sorted(path.name for path in table.iterdir()) == ["BANDEJA.json"]
    sign = read_sign(table / "BANDEJA.json")
    assert (sign.provenance.standing, sign.provenance.licence) == ("described", "CC0-1.0")
    assert 'entry "bandeja"' in sign.provenance.source
    assert (tmp_path / "scores" / "BANDEJA.yaml").is_file()
    written = (table / "BANDEJA.json").stat().st_mtime_ns
    assert [outcomes[term]["result"] for term in ("lazo", "xqzzt")] == ["refused", "skipped"]
    report.unlink()
    second = run(*words)
    assert "1 as before" in second.output
    nothing = run(
        "--signwriting", dictionary(tmp_path, f"lazo\t{LOOP}"), "--lut", tmp_path / "no", "--jobs", 1
    )
    assert nothing.exit_code == 1 and "movement" in nothing.output
    assert (table / "BANDEJA.json").stat().st_mtime_ns == written


def test_a_second_import_goes_on_after_its_report_and_tells_a_program_the_same(tmp_path: Path) -> None:
    rows = (f"bandeja\t{TRAY}", f"lazo\t{LOOP}", f"xqzzt\t{TRAY}")
    table, report = tmp_path / "lut", tmp_path / "report.json"
    words = ("--lut", table, "--jobs", 1, "--report", report, "--json", "--signwriting")
    first = run(*words, dictionary(tmp_path, *rows))
    told = json.loads(report.read_text("utf-8"))
    told[1]["message"] = "as it was told"
    report.write_text(json.dumps(told), "utf-8")
    assert run(*words, dictionary(tmp_path, *rows)).stdout == first.stdout
    assert json.loads(report.read_text("utf-8"))[1]["message"] == "as it was told"
    summary = json.loads(first.stdout)
    assert summary["entries"] == 3 and summary["whole"] + summary["with_losses"] == 1
    assert (summary["refused"], summary["skipped"]) == ({"movement": 1}, {"unknown_term": 1})
    # What is written anew, or is not in the table any more, is tried again.
    (table / "BANDEJA.json").unlink()
    assert '"refused": {}' in run(*words, dictionary(tmp_path, rows[0], f"lazo\t{TRAY}", rows[2])).stdout
    assert sorted(path.name for path in table.iterdir()) == ["BANDEJA.json", "LAZO.json"]
    report.write_text("{", "utf-8")
    assert "bad_report" in run(*words, dictionary(tmp_path, *rows)).output


def test_an_import_that_is_killed_leaves_whole_entries_and_no_process_and_can_go_on(tmp_path: Path) -> None:
    file = dictionary(tmp_path, *(f"bandeja {number}\t{TRAY}" for number in range(40)))
    table = tmp_path / "lut"
    words = ["lut", "import", "--signwriting", str(file), "--lut", str(table), "--jobs", "2", "--json"]
    command = ["ros2", "run", "teo_lut_executor", *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as importing:
        assert importing.stderr is not None and importing.stdout is not None
        importing.stderr.readline()  # the first sign is made
        importing.kill()
        importing.stdout.read()  # ends with the last process that holds it
    made = sorted(table.glob("[!.]*.json"))
    assert 0 < len(made) < 40
    for entry in made:
        read_sign(entry)
    second = subprocess.run(command, capture_output=True, check=True, text=True)
    assert json.loads(second.stdout)["as_before"] == len(made)
    assert len(list(table.glob("[!.]*.json"))) == 40


def test_signs_of_another_language_are_named_by_its_words(tmp_path: Path) -> None:
    file, table = dictionary(tmp_path, f"Mexico\t{TRAY}", f"sideburns\t{TRAY}"), tmp_path / "lut"
    first = run("--signwriting", file, "--lut", table, "--jobs", 1, "--language", "ase")
    assert read_sign(table / "MEXICO.json").language == "ase"
    assert "expected a known word, got 'sideburns'" in first.output
    mixed = run("--signwriting", file, "--lut", table, "--jobs", 1)
    assert "other_language" in mixed.output and "ase" in mixed.output


def test_a_better_founded_entry_is_not_replaced(tmp_path: Path) -> None:
    file, table = dictionary(tmp_path, f"bandeja\t{TRAY}"), tmp_path / "lut"
    run("--signwriting", file, "--lut", table, "--jobs", 1)
    entry = table / "BANDEJA.json"
    entry.write_text(entry.read_text("utf-8").replace('"described"', '"measured"'), "utf-8")
    again = run("--signwriting", file, "--lut", table, "--jobs", 1, "--replace")
    assert "1 as before" in again.output
    assert '"measured"' in entry.read_text("utf-8")


@pytest.mark.parametrize("words", [(), ("a.pose",), ("a.pose", "--signwriting", "b.tsv")])
def test_a_clip_or_a_dictionary_is_wanted_not_both_nor_none(words: tuple[str, ...]) -> None:
    refused = run(*words)
    assert refused.exit_code == 1
    assert "bad_arguments" in refused.output
