# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_motion.sentence.sentence_form import STATEMENT, SentenceForm, SentenceType, head_gestures
from teo_sign_languages import HeadGrammar, load_language
from teo_signs.tokens import parse_printed

YES_NO = SentenceForm(type=SentenceType.YES_NO_QUESTION)
WH = SentenceForm(type=SentenceType.WH_QUESTION)
EXCLAMATION = SentenceForm(type=SentenceType.EXCLAMATION)
NEGATED = SentenceForm(negated=True)


def gestures(text: str, form: SentenceForm) -> list[tuple[str, int, int]]:
    return [(item.kind.value, item.first, item.last) for item in head_gestures(parse_printed(text), form)]


def test_a_statement_has_no_gesture() -> None:
    assert gestures("YO VENIR NO", STATEMENT) == []


@pytest.mark.parametrize(
    ("text", "spans"),
    [
        ("YO MAÑANA VENIR NO", [(2, 3)]),
        ("YO LECHE BEBER N-U-N-C-A", [(2, 7)]),
        ("CASA NO_HAY NADIE", [(0, 2)]),
        ("NO _ YO VENIR", [(0, 0)]),
        ("YO COMER _ NO", [(3, 3)]),
        ("COMER NO YO AGUA BEBER NO", [(0, 1), (4, 5)]),
        ("YO VENIR", [(0, 1)]),
        ("_ YO VENIR _", [(1, 2)]),
    ],
)
def test_the_head_shakes_from_the_word_before_a_negative_sign_to_its_end(
    text: str, spans: list[tuple[int, int]]
) -> None:
    assert gestures(text, NEGATED) == [("shake", *span) for span in spans]


def test_the_head_is_forward_over_a_whole_yes_no_question() -> None:
    assert gestures("TÚ AGUA BEBER", YES_NO) == [("forward", 0, 2)]


@pytest.mark.parametrize(
    ("text", "spans"),
    [
        ("TÚ VIVIR DÓNDE", [(2, 2)]),
        ("TÚ NOMBRE C-U-A-L", [(2, 5)]),
        ("QUIÉN COMER QUÉ", [(0, 0), (2, 2)]),
        ("TÚ HORA", [(0, 1)]),
    ],
)
def test_the_head_is_back_at_question_words_or_throughout(text: str, spans: list[tuple[int, int]]) -> None:
    assert gestures(text, WH) == [("back", *span) for span in spans]


def test_the_last_sign_of_an_exclamation_is_nodded_at() -> None:
    assert gestures("TÚ G-U-A-P-O", EXCLAMATION) == [("nod", 5, 5)]
    assert gestures("TÚ GUAPO _", EXCLAMATION) == [("nod", 1, 1)]


def test_a_negated_exclamation_is_not_nodded_at() -> None:
    form = SentenceForm(type=SentenceType.EXCLAMATION, negated=True)
    assert gestures("VENIR NO", form) == [("shake", 0, 1)]


def test_a_negated_question_leans_and_shakes() -> None:
    form = SentenceForm(type=SentenceType.YES_NO_QUESTION, negated=True)
    assert {kind for kind, _, _ in gestures("TÚ VENIR NO", form)} == {"forward", "shake"}


def test_pauses_alone_have_no_gesture() -> None:
    for form in (NEGATED, YES_NO, WH, EXCLAMATION):
        assert head_gestures(parse_printed("_ _"), form) == ()


def test_american_signs_shake_at_what_follows_the_negative_sign_and_lean_forward_to_ask() -> None:
    def american(text: str, form: SentenceForm) -> list[tuple[str, int, int]]:
        found = head_gestures(parse_printed(text), form, load_language("ase").head)
        return [(item.kind.value, item.first, item.last) for item in found]

    assert american("I NOT KNOW", NEGATED) == [("shake", 1, 2)]
    assert american("I KNOW NOT", NEGATED) == [("shake", 2, 2)]
    assert american("YOUR NAME WHAT", WH) == [("forward", 2, 2)]
    assert american("YOU DEAF", YES_NO) == [("forward", 0, 1)]


@pytest.mark.parametrize("form", [NEGATED, WH, YES_NO, EXCLAMATION])
def test_a_language_of_which_nothing_is_said_keeps_its_head_still(form: SentenceForm) -> None:
    assert head_gestures(parse_printed("YO NO QUÉ"), form, HeadGrammar()) == ()
