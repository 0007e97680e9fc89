# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_motion.sentence.sentence_form import (
    STATEMENT,
    SentenceForm,
    SentenceType,
    head_gestures,
    printed_form,
    without_marks,
)
from teo_sign_languages import HeadGrammar, load_language
from teo_signs.tokens import Kind, Token, parse_printed

SPANISH, AMERICAN = load_language("ssp").head, load_language("ase").head


def test_a_spelled_gloss_with_a_pause_inside_is_one_word() -> None:
    pause = Token(gloss="", kind=Kind.PAUSE, word_index=3)
    letters = [Token(gloss=letter, kind=Kind.LETTER, word_index=3) for letter in "NOHAY"]
    assert printed_form("", [*letters[:2], pause, *letters[2:]], SPANISH).negated


@pytest.mark.parametrize(
    ("grammar", "glosses", "asks", "negates"),
    [
        (SPANISH, "QUÉ POR_QUÉ CUÁNTOS A-D-O-N-D-E C-U-A-L", True, False),
        (SPANISH, "NO NO_HAY TODAVÍA_NO JAMÁS N-U-N-C-A NADA", False, True),
        # Conjunctions, and words that hold one that asks or negates.
        (SPANISH, "CUANDO PORQUE COMER Q NOCHE BUENO DE_NADA SÍ NOSOTROS", False, False),
        (AMERICAN, "WHAT W-H-O", True, False),
        (AMERICAN, "DONT_KNOW", False, True),
        (AMERICAN, "NADA QUÉ", False, False),
    ],
)
def test_words_ask_negate_or_do_neither(
    grammar: HeadGrammar, glosses: str, asks: bool, negates: bool
) -> None:
    asked = SentenceType.WH_QUESTION if asks else SentenceType.YES_NO_QUESTION
    for gloss in glosses.split():
        form = printed_form(f"{gloss}?", parse_printed(gloss), grammar)
        assert form == SentenceForm(type=asked, negated=negates), gloss


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


NO, NEGATED_QUESTION = (
    SentenceForm(negated=True),
    SentenceForm(type=SentenceType.YES_NO_QUESTION, negated=True),
)
YES_NO, WH, EXCLAMATION = (SentenceForm(type=type_) for type_ in list(SentenceType)[1:])
SHOUTED_NO = SentenceForm(type=SentenceType.EXCLAMATION, negated=True)


@pytest.mark.parametrize(
    ("text", "form", "gestures"),
    [
        ("YO VENIR NO", STATEMENT, []),
        # The head shakes from the word before a negative sign to its end, else over the whole sentence.
        ("YO MAÑANA VENIR NO", NO, [("shake", 2, 3)]),
        ("YO LECHE BEBER N-U-N-C-A", NO, [("shake", 2, 7)]),
        ("CASA NO_HAY NADIE", NO, [("shake", 0, 2)]),
        ("NO _ YO VENIR", NO, [("shake", 0, 0)]),
        ("YO COMER _ NO", NO, [("shake", 3, 3)]),
        ("COMER NO YO AGUA BEBER NO", NO, [("shake", 0, 1), ("shake", 4, 5)]),
        ("YO VENIR", NO, [("shake", 0, 1)]),
        ("_ YO VENIR _", NO, [("shake", 1, 2)]),
        ("TÚ AGUA BEBER", YES_NO, [("forward", 0, 2)]),
        ("TÚ VENIR NO", NEGATED_QUESTION, [("shake", 1, 2), ("forward", 0, 2)]),
        # It is back at question words, or throughout.
        ("TÚ VIVIR DÓNDE", WH, [("back", 2, 2)]),
        ("TÚ NOMBRE C-U-A-L", WH, [("back", 2, 5)]),
        ("QUIÉN COMER QUÉ", WH, [("back", 0, 0), ("back", 2, 2)]),
        ("TÚ HORA", WH, [("back", 0, 1)]),
        ("TÚ G-U-A-P-O", EXCLAMATION, [("nod", 5, 5)]),
        ("TÚ GUAPO _", EXCLAMATION, [("nod", 1, 1)]),
        ("VENIR NO", SHOUTED_NO, [("shake", 0, 1)]),
        *(("_ _", form, []) for form in (NO, YES_NO, WH, EXCLAMATION)),
    ],
)
def test_the_head_shows_the_form_of_a_sentence(
    text: str, form: SentenceForm, gestures: list[tuple[str, int, int]]
) -> None:
    assert shown(text, form, SPANISH) == gestures
    assert shown(text, form, HeadGrammar()) == [], "a language of which nothing is said"


@pytest.mark.parametrize(
    ("text", "form", "gestures"),
    [
        ("I NOT KNOW", NO, [("shake", 1, 2)]),
        ("I KNOW NOT", NO, [("shake", 2, 2)]),
        ("YOUR NAME WHAT", WH, [("forward", 2, 2)]),
        ("YOU DEAF", YES_NO, [("forward", 0, 1)]),
    ],
)
def test_american_signs_shake_at_what_follows_the_negative_sign_and_lean_forward_to_ask(
    text: str, form: SentenceForm, gestures: list[tuple[str, int, int]]
) -> None:
    assert shown(text, form, AMERICAN) == gestures


def shown(text: str, form: SentenceForm, grammar: HeadGrammar) -> list[tuple[str, int, int]]:
    found = head_gestures(parse_printed(text), form, grammar)
    return [(gesture.kind.value, gesture.first, gesture.last) for gesture in found]
