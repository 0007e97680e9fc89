# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign, which signs together, or which letters a gloss is shown by."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest
from loaded import TEXT, morphology

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.output_words import OutputWord, Spelling, lexical, number
from teo_sign_translator.output.sign_choice import (
    INCORPORATED_NUMBERS,
    SignChooser,
    SubstituteLists,
    Substitutes,
    read_incorporated,
    with_numbers_incorporated,
)
from teo_sign_translator.output.sign_coverage import read_signs
from teo_sign_translator.output.translation import Kind, Origin


@cache
def chooser(allowed: Substitutes = Substitutes.PARAPHRASE) -> SignChooser:
    return SignChooser(SubstituteLists.load(), morphology(), allowed)


def _word(gloss: str, *, is_name: bool = False) -> OutputWord:
    return lexical(gloss, ("x",), 0.8, is_name=is_name)


def _chosen(word: OutputWord | str, *signs: str) -> list[tuple[str, Origin]]:
    words = [_word(word) if isinstance(word, str) else word]
    return [(" ".join(each.signs), each.origin) for each in chooser().choose(words, {*signs})]


@pytest.mark.parametrize(
    ("gloss", "signs", "shown", "origin"),
    [
        ("AMIGA", "AMIGA AMIGO", "AMIGA", Origin.MODEL),
        ("AMIGA", "AMIGO", "AMIGO", Origin.LEMMA),
        ("AUTO", "COCHE", "COCHE", Origin.SYNONYM),
        ("MEDICACIÓN", "MEDICINA DINERO", "MEDICINA", Origin.SYNONYM),
        ("CANSANCIO", "CANSADO", "CANSADO", Origin.SYNONYM),
        ("YEGUA", "CABALLO", "Y E G U A", Origin.SPELLED),  # nothing more general
        ("ROSA", "FLOR", "R O S A", Origin.SPELLED),  # that it is a flower says nothing
        ("CUENTA", "CONTAR", "C U E N T A", Origin.SPELLED),  # the bill is not what one counts
        ("PESCAR", "PESCADO", "P E S C A R", Origin.SPELLED),  # a fish is not fishing
        ("CAJERO", "DINERO", "C A J E R O", Origin.SPELLED),  # all parts of a paraphrase or none
        ("LÁPIZ", "COCHE", "L A P I Z", Origin.SPELLED),
    ],
)
def test_the_nearest_sign_that_the_table_has_is_taken(
    gloss: str, signs: str, shown: str, origin: Origin
) -> None:
    assert _chosen(gloss, *signs.split()) == [(shown, origin)]


def test_several_signs_show_a_gloss_together() -> None:
    assert _chosen("CAJERO", "DINERO", "MÁQUINA") == [
        ("DINERO", Origin.PARAPHRASE),
        ("MÁQUINA", Origin.PARAPHRASE),
    ]
    assert [gloss for gloss, _ in _chosen("PEDIATRA", "DOCTOR", "CRÍO")] == ["DOCTOR", "CRÍO"]  # by synonyms
    assert _chosen("POR_FAVOR", "POR") == [("POR", Origin.MODEL), ("F A V O R", Origin.SPELLED)]


def test_a_name_is_spelled_unless_it_has_a_sign_of_its_own() -> None:
    rosa = _word("ROSA", is_name=True)
    assert _chosen(rosa, "FLOR") == [("R O S A", Origin.SPELLED)]
    assert _chosen(rosa, "ROSA") == [("ROSA", Origin.MODEL)]
    assert [word.signs for word in chooser().choose([rosa], None)] == [("R", "O", "S", "A")]


def test_without_an_inventory_every_possible_sign_is_kept() -> None:
    assert chooser().choose([_word("LÁPIZ")], None) == [_word("LÁPIZ")]
    (odd,) = chooser().choose([_word("ŁÓDŹ")], None)
    assert odd.signs == ("L", "O", "D", "Z")
    (long,) = chooser().choose([_word("A" * 65)], None)
    assert long.kind is Kind.LETTER


@pytest.mark.parametrize("allowed", list(Substitutes))
def test_each_step_can_be_switched_off(allowed: Substitutes) -> None:
    signs = {"MEDICINA", "DINERO", "MÁQUINA"}
    glosses = ("MEDICACIÓN", "CAJERO")
    words = [lexical(gloss, (gloss,), 0.8) for gloss in glosses]
    origins = {word.origin for word in chooser(allowed).choose(words, signs)} - {Origin.SPELLED}
    steps = (Origin.SYNONYM, Origin.PARAPHRASE)
    assert origins == {*steps[: int(allowed)]}


def test_no_synonym_leads_back() -> None:
    assert all(gloss not in others for gloss, others in SubstituteLists.load().synonyms.items())


UNITS = frozenset({"SEMANA", "MES", "DOS_SEMANAS", "TRES_MESES", "NOSOTROS_DOS", "YO"})


def _with_numbers(
    text: str, signs: frozenset[str] | None = UNITS, typed: str | None = None
) -> list[OutputWord]:
    words = [
        number(word, (word,), 0.9)[0] if word.isdigit() else lexical(word, (word.lower(),), 0.8)
        for word in text.split()
    ]
    typed_words = (typed or text).lower().split()
    return with_numbers_incorporated(
        words, typed_words, signs, read_incorporated(TEXT / INCORPORATED_NUMBERS)
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2 SEMANA", "DOS_SEMANAS"),
        ("PASADO SEMANA 2 YO", "PASADO DOS_SEMANAS YO"),
        ("MES 3", "TRES_MESES"),
        ("NOSOTRAS 2", "NOSOTROS_DOS"),
        # No sign for it, no number that is taken up, no unit of time, nothing beside it.
        ("SEMANA 6", "SEMANA 6"),
        ("CASA 2", "CASA 2"),
        ("2 YO SEMANA", "2 YO SEMANA"),
        ("", ""),
    ],
)
def test_a_number_goes_into_the_unit_beside_it(text: str, expected: str) -> None:
    assert " ".join(sign for word in _with_numbers(text) for sign in word.signs) == expected


def test_a_number_goes_into_no_unit_that_it_does_not_count() -> None:
    twice_a_week = _with_numbers("SEMANA 2 VEZ", typed="2 vez por semana")
    assert [word.signs for word in twice_a_week] == [("SEMANA",), ("2",), ("VEZ",)]


def test_one_sign_says_the_words_of_both_and_is_as_sure_as_the_less_sure() -> None:
    (word,) = _with_numbers("2 SEMANA")
    assert (word.words, word.confidence) == (("2", "semana"), 0.8)
    assert len(_with_numbers("2 SEMANA", None)) == 2  # not while the table is not known


@pytest.mark.parametrize(
    ("word", "signs"),
    [
        ("Ana", "A N A"),
        ("Guillermo", "G U I LL E R M O"),
        ("Ñoño", "Ñ O Ñ O"),
        ("n\u0303u", "Ñ U"),
        ("pingüino", "P I N G U I N O"),
        ("Müßig", "M U S S I G"),
        ("llll", "LL LL"),
        ("", ""),
    ],
)
def test_spelling(word: str, signs: str) -> None:
    assert Spelling.load().letters(word) == tuple(signs.split())
    assert Spelling.load().unsignable(word) == ()


def test_what_no_letter_sign_exists_for_is_named_once() -> None:
    assert Spelling.load().unsignable("Иван и Иван"[:4] + "aИ") == ("И", "в", "а", "н")


def test_a_tables_folder_says_which_glosses_have_signs_by_their_standing(tmp_path: Path) -> None:
    for gloss, kind, standing in (
        ("HOLA", "lexical", "recorded"),
        ("CASA", "lexical", "described"),
        ("TREN", "lexical", "sketched"),
        ("A", "letter", "recorded"),
    ):
        content = {"gloss": gloss, "kind": kind, "provenance": {"standing": standing}}
        (tmp_path / f"{gloss}.json").write_text(json.dumps(content), encoding="utf-8")
    assert read_signs(tmp_path) == {"HOLA", "CASA"}
    assert read_signs(tmp_path, "recorded") == {"HOLA"}
    assert read_signs(tmp_path, "sketched") == {"HOLA", "CASA", "TREN"}
    with pytest.raises(TranslationError, match="described"):
        read_signs(tmp_path, "good")
