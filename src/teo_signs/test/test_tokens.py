# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_signs.errors import PlanError
from teo_signs.tokens import Kind, Token, check_tokens, parse_printed


def kinds(text: str) -> list[tuple[str, str, int]]:
    return [(token.gloss, token.kind.name, token.word_index) for token in parse_printed(text)]


def test_a_word_is_a_gloss_and_a_hyphenated_one_is_spelled() -> None:
    assert kinds("MI NOMBRE A-N-A") == [
        ("MI", "LEXICAL", 0),
        ("NOMBRE", "LEXICAL", 1),
        ("A", "LETTER", 2),
        ("N", "LETTER", 2),
        ("A", "LETTER", 2),
    ]


def test_digraphs_digits_and_pauses_are_read() -> None:
    assert kinds("LL-U-CH-A 27 _ E-1") == [
        ("LL", "LETTER", 0),
        ("U", "LETTER", 0),
        ("CH", "LETTER", 0),
        ("A", "LETTER", 0),
        ("27", "NUMBER", 1),
        ("", "PAUSE", 2),
        ("E", "LETTER", 3),
        ("1", "NUMBER", 3),
    ]


def test_an_inflection_stands_in_brackets_behind_its_gloss() -> None:
    (help_me, plain) = parse_printed("AYUDAR[2>1] DOLER")
    assert (help_me.gloss, help_me.inflection) == ("AYUDAR", "2>1")
    assert (plain.gloss, plain.inflection) == ("DOLER", "")


def test_a_gloss_may_hold_hyphens() -> None:
    assert kinds("PERSONA-PLURAL") == [("PERSONA-PLURAL", "LEXICAL", 0)]


def test_accents_are_composed() -> None:
    assert parse_printed("TU\N{COMBINING ACUTE ACCENT}")[0].gloss == "TÚ"


@pytest.mark.parametrize(
    ("text", "code"),
    [("", "empty_sentence"), ("  \n", "empty_sentence"), ("A--N", "bad_gloss"), ("-", "bad_gloss")],
)
def test_what_cannot_be_read_is_refused(text: str, code: str) -> None:
    with pytest.raises(PlanError) as refusal:
        parse_printed(text)
    assert refusal.value.code == code


@given(st.text())
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        check_tokens(parse_printed(text))
    except PlanError as error:
        assert error.code in ("empty_sentence", "bad_gloss")


@pytest.mark.parametrize("scale", [0.0, -1.0, math.nan, math.inf, 1e-9, 1e9])
def test_a_scale_that_is_none_is_refused(scale: float) -> None:
    with pytest.raises(PlanError, match="duration scale") as refusal:
        check_tokens([Token(gloss="A", duration_scale=scale)])
    assert refusal.value.code == "bad_scale"


def test_a_kind_that_is_none_is_refused() -> None:
    with pytest.raises(PlanError) as refusal:
        check_tokens([Token(gloss="A", kind=9)])  # type: ignore[arg-type]
    assert refusal.value.code == "bad_kind"


def test_only_a_pause_may_go_without_a_gloss() -> None:
    check_tokens([Token(gloss="", kind=Kind.PAUSE)])
    with pytest.raises(PlanError) as refusal:
        check_tokens([Token(gloss=" ")])
    assert refusal.value.code == "bad_gloss"
