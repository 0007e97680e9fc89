# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from teo_signs.errors import PlanError
from teo_signs.tokens import Kind, Token, check_tokens, parse_printed


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("MI NOMBRE A-N-A", "MI LEXICAL 0, NOMBRE LEXICAL 1, A LETTER 2, N LETTER 2, A LETTER 2"),
        ("LL-U-CH-A 27", "LL LETTER 0, U LETTER 0, CH LETTER 0, A LETTER 0, 27 NUMBER 1"),
        ("_ E-1", " PAUSE 0, E LETTER 1, 1 NUMBER 1"),
        ("PERSONA-PLURAL", "PERSONA-PLURAL LEXICAL 0"),
        ("TU\N{COMBINING ACUTE ACCENT}", "TÚ LEXICAL 0"),
    ],
)
def test_a_word_is_a_gloss_a_number_a_pause_or_letters_with_hyphens(text: str, read: str) -> None:
    tokens = [f"{token.gloss} {token.kind.name} {token.word_index}" for token in parse_printed(text)]
    assert ", ".join(tokens) == read


def test_an_inflection_stands_in_brackets_behind_its_gloss() -> None:
    (help_me, plain) = parse_printed("AYUDAR[2>1] DOLER")
    assert (help_me.gloss, help_me.inflection) == ("AYUDAR", "2>1")
    assert (plain.gloss, plain.inflection) == ("DOLER", "")


@pytest.mark.parametrize(
    ("text", "code"),
    [("", "empty_sentence"), ("  \n", "empty_sentence"), ("A--N", "bad_gloss"), ("-", "bad_gloss")],
)
def test_what_cannot_be_read_is_refused(text: str, code: str) -> None:
    with refused(code):
        parse_printed(text)


@given(st.text())
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        check_tokens(parse_printed(text))
    except PlanError as error:
        assert error.code in ("empty_sentence", "bad_gloss")


@pytest.mark.parametrize("scale", [0.0, -1.0, math.nan, math.inf, 1e-9, 1e9])
def test_a_scale_that_is_none_is_refused(scale: float) -> None:
    with refused("bad_scale", "duration scale"):
        check_tokens([Token(gloss="A", duration_scale=scale)])


def test_a_kind_that_is_none_is_refused() -> None:
    with refused("bad_kind"):
        check_tokens([Token(gloss="A", kind=9)])  # type: ignore[arg-type]


def test_only_a_pause_may_go_without_a_gloss() -> None:
    check_tokens([Token(gloss="", kind=Kind.PAUSE)])
    with refused("bad_gloss"):
        check_tokens([Token(gloss=" ")])
