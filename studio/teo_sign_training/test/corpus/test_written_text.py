# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Written Spanish: contractions, vowels that meet, clitics, numbers; against the RAE's spelling."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_common.text_folding import fold
from teo_sign_training.corpus.grammar_file import load_grammar
from teo_sign_training.corpus.phrases import LIMIT, SaidWord, in_order
from teo_sign_training.corpus.writing import write
from teo_sign_translator.data_files import data_file
from teo_sign_translator.text.rules import TextRules

NUMBERS = TextRules.load().numbers
GRAMMAR = load_grammar(data_file("grammar"))


def one_word(contraction):
    """Every contraction of the language is read as one word."""
    assert contraction


@pytest.mark.parametrize(
    ("words", "written"),
    [
        ("voy a el médico .", "Voy al médico."),
        ("salgo de el colegio .", "Salgo del colegio."),
        ("es de él .", "Es de él."),
        ("voy a El Cairo .", "Voy a El Cairo."),
        ("padre y hijo .", "Padre e hijo."),
        ("agua y hielo .", "Agua y hielo."),
        ("uno o otro .", "Uno u otro."),
        ("siete o ocho .", "Siete u ocho."),
        ("¿ qué hay ?", "¿Qué hay?"),
        ("hola , ¿ qué tal ?", "Hola, ¿qué tal?"),
        ("¡ qué frío !", "¡Qué frío!"),
        ("ángel y Ana .", "Ángel y Ana."),
    ],
)
def test_words_are_joined_as_they_are_written(words, written):
    assert write([SaidWord(word) for word in words.split()], GRAMMAR.writing, one_word)[0] == written


def test_feminine_nouns_with_a_stressed_a_take_the_masculine_article():
    tokens = [SaidWord(word, article=word == "la") for word in ["la", "agua", "y", "la", "leche"]]
    assert write(tokens, GRAMMAR.writing, one_word)[0] == "El agua y la leche"


def test_the_words_of_a_contraction_have_one_place():
    tokens = [SaidWord(word) for word in ["¿", "vas", "a", "el", "cine", ",", "Ana", "?"]]
    text, places = write(tokens, GRAMMAR.writing, one_word)
    assert text == "¿Vas al cine, Ana?"
    assert [places.get(id(token)) for token in tokens] == [None, 0, 1, 1, 2, 3, 4, 5]


@pytest.mark.parametrize(
    ("alone", "together"),
    [
        (("lo", "me"), ("me", "lo")),
        (("lo", "le"), ("se", "lo")),
        (("las", "les"), ("se", "las")),
        (("me", "te"), ("te", "me")),
        (("se", "le"), ("se", "le")),
        (("os", "lo"), ("os", "lo")),
    ],
)
def test_clitics_stand_in_the_order_of_spanish(alone, together):
    assert in_order(alone, GRAMMAR.writing.clitics) == together


@given(st.integers(0, LIMIT - 1))
def test_numbers_in_words_are_read_as_the_same_number(value):
    words = fold(NUMBERS.in_words(value)).split()
    assert NUMBERS.read_words(words) == (value, len(words))


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (16, "dieciséis"),
        (22, "veintidós"),
        (31, "treinta y uno"),
        (100, "cien"),
        (101, "ciento uno"),
        (1999, "mil novecientos noventa y nueve"),
    ],
)
def test_numbers_have_their_accents(value, words):
    assert NUMBERS.in_words(value) == words
