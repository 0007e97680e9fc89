# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from refusals import refused

from teo_sign_translator.text.cleaning import MAX_TEXT_LENGTH, clean
from teo_sign_translator.text.reading import SentenceType, is_negated, read, sentence_type


@pytest.mark.parametrize(
    ("typed", "cleaned"),
    [
        ("e\u0301", "é"),
        ("“hola” ‘tú’", "\"hola\" 'tú'"),
        ("a\u00a0b\tc", "a b c"),
        ("Ｈｏｌａ１２", "Hola12"),
        ("ﬁn m²", "fin m2"),
        ("co\u00adche\u200b", "coche"),
        ("1º ª", "1º ª"),
        ("a\r\nb\u2028c", "a\nb\nc"),
    ],
)
def test_cleaning_gives_one_form(typed: str, cleaned: str) -> None:
    assert clean(typed).text == cleaned


def test_cleaning_reports_control_characters() -> None:
    assert clean("a\x00b\x1bc").ignored == ("\x00", "\x1b")


def test_cleaning_refuses_lost_characters_and_texts_without_end() -> None:
    with refused("broken_encoding"):
        clean("d\udced")
    with refused("text_too_long", str(MAX_TEXT_LENGTH)):
        clean("a" * (MAX_TEXT_LENGTH + 1))


@pytest.mark.parametrize(
    "laugh", ["jajaja", "jajja", "JAJAJAJA", "jeje", "jijiji", "ajajaja", "haha", "xD", "xdd"]
)
def test_laughter_is_a_sentence_of_its_own(laugh: str) -> None:
    sentences = [
        [word.lower for word in clause.words] for clause in read(f"qué gracioso {laugh} adiós").clauses
    ]
    assert sentences == [["qué", "gracioso"], ["risa"], ["adiós"]]
    assert [clause.closes for clause in read(f"{laugh}, vale").clauses] == [True, True]


@pytest.mark.parametrize("word", ["ja", "hijo", "haya", "jej", "ajá", "Jan"])
def test_what_only_looks_like_laughter_is_read_as_it_is_typed(word: str) -> None:
    (clause,) = read(word).clauses
    assert [each.lower for each in clause.words] == [word.lower()]


@pytest.mark.parametrize(
    ("text", "ends"),
    [
        ("Hola, adiós.", [(",", False), (".", True)]),
        ("¿Qué?! Sí", [("?", True), ("", True)]),
        ("Bueno… Sí", [(".", True), ("", True)]),
        ("Hola, 😀. Sí", [(".", True), ("", True)]),
        ("Hola\nsí", [("", True), ("", True)]),
    ],
)
def test_reading_finds_where_sentences_end(text: str, ends: list[tuple[str, bool]]) -> None:
    assert [(clause.end, clause.closes) for clause in read(text).clauses] == ends


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("¿Vienes?", SentenceType.YES_NO_QUESTION),
        ("¿Dónde vives?", SentenceType.WH_QUESTION),
        ("¿Y tú cómo estás?", SentenceType.WH_QUESTION),
        ("¿Sabes cómo se llama?", SentenceType.YES_NO_QUESTION),
        ("¿Haces qué?", SentenceType.WH_QUESTION),
        ("como estas", SentenceType.WH_QUESTION),
        ("cuando vienes", SentenceType.WH_QUESTION),
        ("Cuando llegue, te llamo", SentenceType.STATEMENT),
        ("Como pan", SentenceType.STATEMENT),
        ("¡Qué bien!", SentenceType.EXCLAMATION),
        ("¡¿Vienes?!", SentenceType.YES_NO_QUESTION),
    ],
)
def test_the_type_of_a_sentence(text: str, kind: SentenceType) -> None:
    assert sentence_type(read(text).clauses) is kind


@pytest.mark.parametrize(
    ("text", "negated"),
    [
        ("No vengo", True),
        ("Nooooo vengo", True),
        ("Vienes, ¿no?", False),
        ("De nada", False),
        ("Una nota", False),
    ],
)
def test_whether_a_sentence_is_negated(text: str, negated: bool) -> None:
    assert is_negated(read(text).clauses) is negated
