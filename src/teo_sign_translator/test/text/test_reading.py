# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from refusals import refused

from teo_sign_translator.text.cleaning import MAX_TEXT_LENGTH, clean
from teo_sign_translator.text.reading import SentenceType, is_negated, read, sentence_type
from teo_sign_translator.text.rules import TextRules


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


def _words(text: str) -> list[list[str]]:
    return [[" ".join(word.parts) for word in clause.words] for clause in read(text).clauses]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Hola, me llamo Ana.", [["Hola"], ["me", "llamo", "Ana"]]),
        ("Ana ¿quién es Ana?", [["Ana"], ["quién", "es", "Ana"]]),
        ("El Sr. Pérez y J. Gil", [["El", "Sr.", "Pérez", "y", "J", "Gil"]]),
        ("uc3m.es", [["uc3m.es"]]),
        ("Bueno... pues sí", [["Bueno"], ["pues", "sí"]]),
        ("ex-marido d'Ors", [["ex", "marido", "d", "Ors"]]),
        ("son 3,5 € o 1.000,50 € o 5%", [["son", "3,5", "€", "o", "1.000,50", "€", "o", "5", "%"]]),
        ("el 12.10.2024 a las 10:30", [["el", "12", "10", "2024", "a", "las", "10:30"]]),
        ("treinta y un años y dos mil", [["treinta y un", "años", "y", "dos mil"]]),
        ("clase 1ºA", [["clase", "1º", "A"]]),
        ("", []),
    ],
)
def test_reading_finds_clauses_and_words(text: str, words: list[list[str]]) -> None:
    assert _words(text) == words


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
    ("words", "value", "used"),
    [
        ("un", 0, 0),
        ("cien", 100, 1),
        ("una casa", 0, 0),
        ("dieciseis años", 16, 1),
        ("treinta y pico", 30, 1),
        ("quinientas veinte", 520, 2),
        ("siete ocho", 7, 1),
        ("", 0, 0),
    ],
)
def test_number_words_are_read(words: str, value: int, used: int) -> None:
    assert TextRules.load().numbers.read_words(words.split()) == (value, used)


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
