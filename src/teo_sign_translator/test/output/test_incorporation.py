# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_translator.data_files import data_file
from teo_sign_translator.output.output_words import OutputWord, lexical, number
from teo_sign_translator.output.sign_choice import (
    INCORPORATED_NUMBERS,
    read_incorporated,
    with_numbers_incorporated,
)

SIGNS = frozenset({"SEMANA", "MES", "DOS_SEMANAS", "TRES_MESES", "NOSOTROS_DOS", "YO"})


INCORPORATED = read_incorporated(data_file(INCORPORATED_NUMBERS))


def words(text: str) -> list[OutputWord]:
    return [
        number(word, (word,), 0.9)[0] if word.isdigit() else lexical(word, (word.lower(),), 0.8)
        for word in text.split()
    ]


def said(text: str, signs: frozenset[str] | None = SIGNS) -> str:
    return " ".join(
        " ".join(word.signs) for word in with_numbers_incorporated(words(text), signs, INCORPORATED)
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2 SEMANA", "DOS_SEMANAS"),
        ("PASADO SEMANA 2 YO", "PASADO DOS_SEMANAS YO"),
        ("MES 3", "TRES_MESES"),
        ("NOSOTRAS 2", "NOSOTROS_DOS"),
        # No sign for it, no number that is taken up, no unit of time, nothing beside it.
        ("MES 2", "MES 2"),
        ("SEMANA 6", "SEMANA 6"),
        ("SEMANA 22", "SEMANA 22"),
        ("CASA 2", "CASA 2"),
        ("2 YO SEMANA", "2 YO SEMANA"),
        ("SEMANA", "SEMANA"),
        ("", ""),
    ],
)
def test_a_number_goes_into_the_unit_beside_it(text: str, expected: str) -> None:
    assert said(text) == expected


def test_nothing_is_put_together_while_the_table_is_not_known() -> None:
    assert said("SEMANA 2", None) == "SEMANA 2"


def test_one_sign_says_the_words_of_both_and_is_as_sure_as_the_less_sure() -> None:
    (word,) = with_numbers_incorporated(words("2 SEMANA"), SIGNS, INCORPORATED)
    assert word.words == ("2", "semana")
    assert word.confidence == 0.8
