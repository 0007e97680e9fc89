# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import cast

import pytest

from teo_motion.sentence.sentence_form import (
    STATEMENT,
    SentenceForm,
    SentenceType,
    check_form,
    printed_form,
    without_marks,
    words_of,
)
from teo_sign_languages import load_language
from teo_signs.errors import PlanError
from teo_signs.tokens import Kind, Token, parse_printed

SPANISH, AMERICAN = load_language("ssp").head, load_language("ase").head


def test_the_letters_of_a_word_belong_together() -> None:
    words = words_of(parse_printed("TÚ A-N-A _ L-U-Z 26"), SPANISH)
    assert [(word.first, word.last, word.text) for word in words] == [
        (0, 0, "TÚ"),
        (1, 3, "ANA"),
        (4, 4, ""),
        (5, 7, "LUZ"),
        (8, 8, "26"),
    ]


def test_a_spelled_gloss_with_a_pause_inside_is_one_word() -> None:
    pause = Token(gloss="", kind=Kind.PAUSE, word_index=3)
    letters = [Token(gloss=letter, kind=Kind.LETTER, word_index=3) for letter in "NOHAY"]
    (word,) = words_of([*letters[:2], pause, *letters[2:]], SPANISH)
    assert word.text == "NO_HAY" and word.negates


def test_no_tokens_are_no_words() -> None:
    assert words_of([], SPANISH) == ()


@pytest.mark.parametrize("gloss", ["QUÉ", "POR_QUÉ", "CUÁNTOS", "A-D-O-N-D-E", "C-U-A-L"])
def test_question_words_ask(gloss: str) -> None:
    assert words_of(parse_printed(gloss), SPANISH)[0].asks


@pytest.mark.parametrize("gloss", ["CUANDO", "PORQUE", "COMER", "Q"])
def test_conjunctions_and_other_words_do_not_ask(gloss: str) -> None:
    assert not words_of(parse_printed(gloss), SPANISH)[0].asks


@pytest.mark.parametrize("gloss", ["NO", "NO_HAY", "TODAVÍA_NO", "JAMÁS", "N-U-N-C-A", "NADA"])
def test_negative_signs_negate(gloss: str) -> None:
    assert words_of(parse_printed(gloss), SPANISH)[0].negates


@pytest.mark.parametrize("gloss", ["NOCHE", "BUENO", "DE_NADA", "SÍ", "NOSOTROS"])
def test_words_that_hold_a_negative_one_do_not_negate(gloss: str) -> None:
    assert not words_of(parse_printed(gloss), SPANISH)[0].negates


@pytest.mark.parametrize(
    ("text", "type_", "negated"),
    [
        ("TÚ VENIR", SentenceType.STATEMENT, False),
        ("TÚ VENIR NO", SentenceType.STATEMENT, True),
        ("¿TÚ VENIR?", SentenceType.YES_NO_QUESTION, False),
        ("TÚ VENIR CUÁNDO?", SentenceType.WH_QUESTION, False),
        ("TÚ VENIR NO ?", SentenceType.YES_NO_QUESTION, True),
        ("¡VAMOS!", SentenceType.EXCLAMATION, False),
    ],
)
def test_the_printed_form_tells_type_and_negation(text: str, type_: SentenceType, negated: bool) -> None:
    tokens = parse_printed(without_marks(text))
    assert printed_form(text, tokens) == SentenceForm(type=type_, negated=negated)


def test_the_words_that_tell_are_the_languages() -> None:
    words = words_of(parse_printed("WHAT W-H-O DONT_KNOW NADA QUÉ"), AMERICAN)
    assert [(word.asks, word.negates) for word in words] == [
        (True, False),
        (True, False),
        (False, True),
        (False, False),
        (False, False),
    ]


def test_a_type_that_is_none_is_refused() -> None:
    check_form(STATEMENT)
    with pytest.raises(PlanError, match=r"0 statement.*got 9") as refusal:
        check_form(SentenceForm(type=cast(SentenceType, 9)))
    assert refusal.value.code == "bad_type"
