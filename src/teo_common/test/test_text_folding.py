# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_common.text_folding import fold, folded, strip_marks, without_accents

SPANISH = st.text("aáeéiíoóuúüñbcdhn AÁEÉIÍOÓUÚÜÑN¿?¡!.,0123456789")


def test_accents_go_and_ene_stays_where_it_is_a_letter():
    assert without_accents("¿Él se comió la piña, pingüino?") == "¿El se comio la piña, pinguino?"
    assert without_accents("ÑÁÜÇñ São") == "ÑAUCñ Sao"
    assert fold("CÓMO Año pingüino façade") == "como año pinguino facade"
    assert strip_marks("Año PINGÜINO") == "ano pinguino"
    assert [function("") for function in (without_accents, fold, strip_marks, folded)] == [""] * 4


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
