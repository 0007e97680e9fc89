# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_common.text_folding import fold, folded, strip_marks, without_accents

SPANISH = st.text("aáeéiíoóuúüñbcdhn AÁEÉIÍOÓUÚÜÑN¿?¡!.,0123456789")


def test_accents_go_and_ene_and_capitals_stay():
    assert without_accents("¿Él se comió la piña, pingüino?") == "¿El se comio la piña, pinguino?"
    assert without_accents("ÑÁÜÇñ") == "ÑAUCñ"


def test_folding_is_lower_case_too():
    assert [fold(word) for word in ("CÓMO", "Año", "pingüino", "façade")] == [
        "como",
        "año",
        "pinguino",
        "facade",
    ]


def test_without_marks_ene_is_n():
    assert strip_marks("Año") == "ano"
    assert strip_marks("PINGÜINO") == "pinguino"


def test_a_tilde_stays_on_no_other_letter():
    assert without_accents("São") == "Sao"


@pytest.mark.parametrize("function", [without_accents, fold, strip_marks, folded])
def test_of_nothing_comes_nothing(function):
    assert function("") == ""


@pytest.mark.parametrize("function", [without_accents, fold, strip_marks, folded])
@given(text=SPANISH)
def test_the_form_of_unicode_does_not_matter_and_folding_twice_is_folding_once(function, text):
    assert function(unicodedata.normalize("NFD", text)) == function(text)
    assert function(function(text)) == function(text)


@given(text=SPANISH)
def test_letter_by_letter_only_marks_and_capitals_change(text):
    assert len(without_accents(text)) == len(fold(text)) == len(strip_marks(text)) == len(text)
    assert fold(text).replace("ñ", "n") == strip_marks(text)
    assert without_accents(text).lower() == fold(text)


@given(text=SPANISH)
def test_sentences_that_differ_by_marks_capitals_and_spaces_are_one(text):
    typed = "  ".join(strip_marks(text).upper().split()) + "!"
    assert folded(typed) == folded(text)
