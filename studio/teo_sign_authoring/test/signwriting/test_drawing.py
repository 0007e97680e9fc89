# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`draw_signwriting`: which signs of the tables are drawn, from what, and what is refused."""

from __future__ import annotations

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
import typer
from typer.testing import CliRunner, Result

from teo_sign_authoring.cli.signwriting import draw_signwriting
from teo_signs.look_up_table import default_lut_directory

# Two hands each.
FIST = "M520x520S20310500x480S15a00480x505"
HANDS = "M520x520S15a00480x480S15a08500x480"
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    return tmp_path / "teo"


def draw(file: Path) -> Result:
    app = typer.Typer()
    app.command()(draw_signwriting)
    return CliRunner().invoke(app, [str(file)])


def spml(folder: Path, *entries: tuple[str, str]) -> Path:
    file = folder / "dictionary.spml"
    terms = "".join(f"<entry><term>{fsw}</term><term>{term}</term></entry>" for term, fsw in entries)
    file.write_text(f"<spml>{terms}</spml>", "utf-8")
    return file


def own_entry(home: Path, gloss: str, source: str) -> None:
    """Put an entry into the user's own table, with the motion of a shipped one."""
    entry = json.loads((default_lut_directory() / "ABRIR.json").read_text("utf-8"))
    entry["gloss"], entry["provenance"]["source"] = gloss, source
    (home / "lut").mkdir(parents=True, exist_ok=True)
    (home / "lut" / f"{gloss}.json").write_text(json.dumps(entry), "utf-8")


def test_entries_of_both_tables_that_name_the_dictionary_are_drawn_the_others_told(
    tmp_path: Path, home: Path
) -> None:
    own_entry(home, "BANDEJA", 'SignPuddle LSE dictionary, entry "bandeja & vaso"')
    own_entry(home, "ABRIR", "recorded of a person")  # takes the place of the one that names the dictionary
    file = spml(
        tmp_path,
        ("mil", FIST), ("bandeja &amp; vaso", HANDS), ("abrir 1", HANDS),
        ("humo", FIST), ("humo", HANDS), ("isla", ""),
    )  # fmt: skip
    told = draw(file)
    assert told.exit_code == 0, told.output
    shipped = (path.read_text("utf-8") for path in default_lut_directory().glob("*.json"))
    named = sum(re.search(r'"source": "SignPuddle[^"]*, entry', entry) is not None for entry in shipped)
    assert f"2 of {named} signs drawn" in told.output  # the user's own: one more, and one less
    assert 'not_found: ISLA: entry "isla"' in told.output
    assert 'several: HUMO: entry "humo"' in told.output
    assert json.loads((home / "signwriting" / "signs.json").read_text("utf-8")) == {
        "1000": {"entry": "mil", "fsw": FIST},
        "BANDEJA": {"entry": "bandeja & vaso", "fsw": HANDS},
    }
    drawn = ElementTree.parse(home / "signwriting" / "drawings.svg").getroot()
    assert {each.get("id"): len(each.findall(f"{SVG}g")) for each in drawn} == {"1000": 2, "BANDEJA": 2}


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (None, "unreadable"),
        (b"", "not_spml"),
        (b"<html/>", "not_spml"),
        (b"<spml/>", "no_entries"),
        (b"<spml><entry><term>unheard of</term></entry></spml>", "nothing_drawn"),
    ],
)
def test_a_file_that_gives_nothing_is_refused_and_the_drawings_stay(
    tmp_path: Path, home: Path, content: bytes | None, code: str
) -> None:
    kept = home / "signwriting" / "signs.json"
    kept.parent.mkdir(parents=True)
    kept.write_text("{}", "utf-8")
    file = tmp_path / "dictionary.spml"
    if content is not None:
        file.write_bytes(content)
    refused = draw(file)
    assert refused.exit_code == 1
    assert f"{code}: dictionary.spml" in refused.output
    assert kept.read_text("utf-8") == "{}"
    assert [path.name for path in kept.parent.iterdir()] == ["signs.json"]
