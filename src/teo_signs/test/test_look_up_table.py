# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The table: lists at once, reads when asked, keeps what it read."""

from __future__ import annotations

import json
import shutil
import unicodedata
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

from teo_description.hand_geometry import TOUCH, hand_table, thumb_gaps
from teo_description.robot import Robot
from teo_names import LEFT_HAND, RIGHT_HAND
from teo_sign_languages import load_language
from teo_signs.errors import LutError
from teo_signs.look_up_table import (
    Lut,
    default_lut_directory,
    held_entry,
    holding_tables,
    user_lut_directory,
)
from teo_signs.sign import sign_warnings
from teo_signs.sign_file import format_sign

TABLE = default_lut_directory()
LETTERS = set("ABCDEFGHIJKLMNÑOPQRSTUVWXYZ") | {"CH", "LL", "RR"}


def copy_of(gloss: str, directory: Path, name: str) -> None:
    text = (TABLE / f"{gloss}.json").read_text(encoding="utf-8")
    directory.mkdir(parents=True, exist_ok=True)
    (directory / f"{name}.json").write_text(
        text.replace(f'"gloss": "{gloss}"', f'"gloss": "{name}"'), "utf-8"
    )


def test_opening_lists_names_sorted_in_any_unicode_form_and_reads_nothing(tmp_path: Path) -> None:
    names = [f"SEÑA{number}" for number in range(1000)]
    for name in (*names, "POR_FAVOR", unicodedata.normalize("NFD", "ADIÓS")):
        (tmp_path / f"{name}.json").touch()
    for name in (".A.json", "notes.txt", ".tmp123.tmp"):
        (tmp_path / name).touch()
    lut = Lut.open(tmp_path)
    assert len(lut) == 1002
    assert lut.glosses() == tuple(sorted([*names, "POR_FAVOR", "ADIÓS"]))
    assert unicodedata.normalize("NFD", "ADIÓS") in lut
    assert "POR FAVOR" in lut
    with refused("no_directory"):
        Lut.open(tmp_path / "nowhere")


def test_an_entry_is_read_when_it_is_first_asked_for_and_then_kept(tmp_path: Path) -> None:
    copy_of("A", tmp_path, "A")
    (tmp_path / "ROTO.json").write_text("{")
    lut = Lut.open(tmp_path)
    assert "ROTO" in lut
    first = lut["A"]
    (tmp_path / "A.json").unlink()
    assert lut["A"] is first
    with refused("not_json"):
        lut["ROTO"]


def test_an_unknown_gloss_is_refused_by_name(tmp_path: Path) -> None:
    lut = Lut.open(tmp_path)
    assert lut.glosses() == ()
    with refused("unknown_sign", "got 'NADA'"):
        lut["NADA"]
    assert "NADA" not in lut
    assert 7 not in lut


def test_two_files_of_one_gloss_are_refused(tmp_path: Path) -> None:
    (tmp_path / unicodedata.normalize("NFD", "Ñ.json")).touch()
    (tmp_path / unicodedata.normalize("NFC", "Ñ.json")).touch()
    if len(list(tmp_path.iterdir())) < 2:
        pytest.skip("this file system takes both Unicode forms of a name for one")
    with refused("duplicate_gloss"):
        Lut.open(tmp_path)


def test_the_users_own_signs_come_before_those_of_the_package(data_home: Path) -> None:
    lut = Lut.open()
    shipped = lut["A"]
    assert lut.directories == (TABLE,)
    copy_of("B", user_lut_directory(), "A")
    copy_of("B", user_lut_directory(), "MÍA")
    assert user_lut_directory() == data_home / "teo" / "lut"
    assert lut.refresh() == ""  # a table that was not there is seen once it is
    assert lut.directories == (user_lut_directory(), TABLE)
    assert "MÍA" in lut
    assert lut.path("A").parent == user_lut_directory()
    assert lut.path("B").parent == TABLE
    assert not np.array_equal(lut["A"].knots, shipped.knots)
    assert lut.place == f"{user_lut_directory()} (2) and {TABLE} ({len(Lut.open(TABLE)) - 1})"
    (user_lut_directory() / "A.json").unlink()
    assert lut.refresh() == ""
    assert lut.path("A").parent == TABLE  # it gives way to the package's


def test_a_table_that_is_named_is_read_alone(tmp_path: Path) -> None:
    copy_of("A", user_lut_directory(), "A")
    copy_of("B", tmp_path, "B")
    assert Lut.open(tmp_path).glosses() == ("B",)


def test_a_gloss_of_the_package_is_held_for_the_users_own_table_alone(tmp_path: Path) -> None:
    assert held_entry(holding_tables(user_lut_directory()), "A") == TABLE / "A.json"
    assert held_entry(holding_tables(tmp_path), "A") is None
    copy_of("A", user_lut_directory(), "A")
    assert held_entry(holding_tables(user_lut_directory()), "A") == user_lut_directory() / "A.json"


def test_the_table_holds_alphabet_digits_demonstrated_signs_and_every_score_without_a_warning(
    shipped: Lut,
) -> None:
    lut = shipped
    assert {gloss for gloss in lut if lut[gloss].kind == "letter"} == LETTERS
    assert {gloss for gloss in lut if lut[gloss].kind == "number"} == {
        *map(str, range(21)),
        *("30", "40", "50", "100", "1000"),
    }
    scores = {path.stem for path in load_language("ssp").scores.glob("*.yaml")}
    assert {gloss for gloss in lut if lut[gloss].kind != "letter"} == {"HOLA", "MI", "NOMBRE"} | scores
    assert [warning for gloss in lut for warning in sign_warnings(lut[gloss])] == []
    # And each in the form in which it would be written.
    assert [gloss for gloss in lut if lut.path(gloss).read_text("utf-8") != format_sign(lut[gloss])] == []


def test_no_sign_of_the_table_has_its_thumb_in_a_finger(shipped: Lut) -> None:
    table = hand_table(Robot.load())
    deep = {}
    for gloss, sign in shipped.items():
        postures = [sign.knots, *sign.alternatives, *(form.knots for form in sign.forms.values())]
        for hand in (LEFT_HAND, RIGHT_HAND):
            if hand[0] in sign.joints:
                columns = [sign.joints.index(name) for name in hand]
                gap = thumb_gaps(table, np.concatenate(postures)[:, columns]).min()
                if gap < -TOUCH:
                    deep[gloss] = f"{1000.0 * gap:.1f} mm"
    assert deep == {}


@pytest.mark.parametrize(
    ("place", "code"), [({"robot": "r2d2"}, "no_table"), ({"language": "qqq"}, "unknown_language")]
)
def test_a_robot_or_language_without_a_table_is_refused(place: dict[str, str], code: str) -> None:
    with refused(code):
        Lut.open(**place)


def test_an_entry_for_another_robot_or_hand_is_warned_of(tmp_path: Path) -> None:
    text = (TABLE / "A.json").read_text(encoding="utf-8")
    made_for = Lut.open(TABLE)["A"].provenance.description_hash
    text = text.replace(made_for, "0" * 64).replace('"handedness": "right"', '"handedness": "both"')
    (tmp_path / "A.json").write_text(text, "utf-8")
    warnings = sign_warnings(Lut.open(tmp_path)["A"])
    assert len(warnings) == 2
    assert "provenance.description_hash" in warnings[0]
    assert "handedness" in warnings[1]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"language": "ase"}, "--language ase"),
        (
            {"robot": "gr1t2", "joints": ["R_index_proximal_joint"], "knots": [[0.0]], "times": [0.0]},
            "lut retarget --language ssp --robot teo",
        ),
    ],
)
def test_a_table_of_another_language_or_robot_is_refused_with_what_to_do(
    tmp_path: Path, change: dict[str, Any], told: str
) -> None:
    entry = json.loads((TABLE / "A.json").read_text("utf-8"))
    changed = {**entry, "alternatives": [], "alternatives_of": "", **change}
    (tmp_path / "A.json").write_text(json.dumps(changed), "utf-8")
    with refused(f"other_{next(iter(change))}", told):
        Lut.open(tmp_path)
    # One among others is refused when it is asked for, and these are not.
    shutil.copy(TABLE / "0.json", tmp_path)
    lut = Lut.open(tmp_path)
    assert lut["0"].kind == "number"
    with pytest.raises(LutError, match=r"A\.json"):
        lut["A"]


@pytest.mark.usefixtures("data_home")
def test_a_robot_of_ones_own_signs_out_of_the_users_own_table_alone() -> None:
    own = user_lut_directory(robot="r2d2")
    own.mkdir(parents=True)
    entry = json.loads((TABLE / "A.json").read_text("utf-8"))
    (own / "A.json").write_text(json.dumps(entry | {"robot": "r2d2"}), "utf-8")
    lut = Lut.open(robot="r2d2")
    assert lut.directories == (own,)
    assert list(lut) == ["A"]


def test_the_users_own_signs_are_kept_apart_by_language_and_robot(data_home: Path) -> None:
    own = data_home / "teo" / "lut"
    assert user_lut_directory("lse") == user_lut_directory() == own
    assert user_lut_directory(robot="gr1t2") == own / "ssp" / "gr1t2"
