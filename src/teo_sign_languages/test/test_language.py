# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, available_languages, load_language

SHIPPED = load_language(DEFAULT_LANGUAGE).directory


@pytest.fixture
def own_languages(data_home: Path) -> Path:
    """Folder of the user's own languages, with a copy of the default's file under another code."""
    languages = data_home / "teo" / "languages"
    (languages / "xyz").mkdir(parents=True)
    text = (SHIPPED / "language.yaml").read_text("utf-8")
    (languages / "xyz" / "language.yaml").write_text(text.replace("code: ssp", "code: xyz"), "utf-8")
    return languages


def edited(folder: Path, old: str, new: str) -> str:
    """Change a language's file; gives its path."""
    file = folder / "language.yaml"
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new), "utf-8")
    return str(file)


@pytest.mark.parametrize("code", available_languages())
def test_every_language_that_ships_has_all_its_parts(code: str) -> None:
    language = load_language(code)
    assert any(language.table("teo").glob("*.json"))
    assert any(language.scores.iterdir())
    # A language without a text side signs what it is given in glosses.
    for part in (language.text, language.models) if language.text.is_dir() else ():
        assert any(part.iterdir())


@pytest.mark.parametrize("code", available_languages())
def test_a_robot_has_a_sign_for_each_letter_of_the_alphabet(code: str) -> None:
    language = load_language(code)
    for table in language.table("teo").parent.iterdir():
        assert {path.stem for path in table.glob("*.json")} >= set(language.alphabet.letters)


def test_the_former_name_of_a_language_finds_it() -> None:
    assert load_language("lse") == load_language("ssp")


def test_an_unknown_language_is_refused_with_those_that_are_there() -> None:
    with pytest.raises(LanguageError, match="ssp") as refusal:
        load_language("qqq")
    assert refusal.value.code == "unknown_language"


def test_a_users_own_language_is_found_and_takes_the_place_of_one_that_ships(own_languages: Path) -> None:
    assert "xyz" in available_languages()
    assert load_language("xyz").text == own_languages / "xyz" / "text"
    shutil.copytree(own_languages / "xyz", own_languages / "ssp")
    edited(own_languages / "ssp", "code: xyz", "code: ssp")
    assert load_language("ssp").directory == own_languages / "ssp"


@pytest.mark.parametrize(
    ("old", "new", "field"),
    [
        ("code: es,", "code: español,", "spoken.code: "),
        ("code: es,", "", "spoken.code: "),
        ("code: xyz", "code: zyx", "field code: "),
        ("spoken:", "talked:", "talked"),
        ("letters: [A,", "letters: [a,", "alphabet"),
        ("letters: [A,", "letters: [B,", "alphabet"),
        ("Æ: AE", "Æ: Ж", "alphabet"),
        ("code: xyz", "code: [", ""),
    ],
)
def test_a_broken_file_is_refused_by_file_and_field(
    own_languages: Path, old: str, new: str, field: str
) -> None:
    file = edited(own_languages / "xyz", old, new)
    with pytest.raises(LanguageError) as refusal:
        load_language("xyz")
    assert refusal.value.code == "invalid_language"
    assert file in str(refusal.value)
    assert field in str(refusal.value)
