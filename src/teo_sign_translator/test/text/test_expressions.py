# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The list of short forms and symbols."""

from __future__ import annotations

from pathlib import Path

import pytest

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.text.rules import Expressions


def _said(text: str, start: int = 0) -> tuple[str, ...]:
    found = Expressions.load().match(text, start)
    return found.expression.words if found else ()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("km", ("kilómetros",)),
        ("KM.", ("kilómetros",)),
        ("kmx", ()),
        ("p. ej. así", ("por", "ejemplo")),
        ("p.  ej.", ("por", "ejemplo")),
        ("D. Juan", ("don",)),
        ("d. juan", ()),
        ("q", ("que",)),
        ("Q tal", ("que",)),
        ("qué", ()),
        ("%", ("por ciento",)),
        ("hola", ()),
    ],
)
def test_a_short_form_is_found_as_a_whole_word(text: str, said: tuple[str, ...]) -> None:
    assert _said(text) == said


def test_a_single_capital_letter_is_short_for_a_word_only_where_a_sentence_begins() -> None:
    assert _said("plan Q", 5) == ()
    assert _said("Hola. ¿Q tal?", 7) == ("que",)


def test_where_it_ends_and_whether_with_a_point_is_told() -> None:
    found = Expressions.load().match("los km. de", 4)
    assert found is not None
    assert (found.stop, found.pointed) == (7, True)


@pytest.mark.parametrize("line", ["km\tlength\tkilómetros", "KM\tword\tkilómetros", "km,\tword\tkilómetros"])
def test_a_damaged_list_is_refused_with_file_and_line(tmp_path: Path, line: str) -> None:
    path = tmp_path / "expressions.tsv"
    path.write_text(f"# comment\n{line}\n", encoding="utf-8")
    with pytest.raises(TranslationError, match=r"expressions\.tsv, line 2") as error:
        Expressions.load(path)
    assert error.value.code == "invalid_data"
