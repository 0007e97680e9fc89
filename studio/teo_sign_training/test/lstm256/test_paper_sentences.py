# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The shipped model knows the published sentences by heart, however they are typed."""

from __future__ import annotations

import pytest
from ways_of_typing import WAYS_OF_TYPING

from teo_sign_training.corpus.paper_pairs import (
    NUMBER,
    paper_pairs,
    paper_predictions,
    read_aligned_pairs,
    training_data_hash,
    training_pairs,
)
from teo_sign_training.fitting.lstm256_fitting import shipped_examples
from teo_sign_training.lstm256.seq2seq import load_model
from teo_sign_translator.data_files import data_file
from teo_sign_translator.model_files import read_card
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.output.translation import Kind
from teo_sign_translator.pipeline.translator import Translator

# The 39 pairs of arXiv:1907.04198, written here once more so that an edited data file does not go unnoticed.
PUBLISHED = """\
¿Qué tal? | TÚ BIEN
Estoy bien pero tengo sueño | BIEN DORMIR
¿Tú vas al colegio? | TÚ COLEGIO IR
Venga, levántate, que tienes que ir al colegio | VENGA LEVANTAR TÚ COLEGIO IR
¿Qué has hecho en el colegio? | COLEGIO HACER QUÉ
¿Qué deberes tienes que hacer? | COLEGIO EJERCICIOS QUÉ
¿Cuántos años tienes? | EDAD CUÁNTOS
Ana, ¿quién es Ana? | ANA QUIÉN
¿Cómo te llamas? | TÚ NOMBRE CUÁL
Me llamo… | MI NOMBRE
Buenos días | BIEN DÍA
Buenas tardes | BIEN TARDE
Buenas noches | BIEN NOCHE
Yo tengo X años | YO EDAD X
¡Vamos a comer! | VAMOS COMER
¡A despertarse! | VAMOS DESPERTARSE
¡Vamos a dormir! | VAMOS DORMIR
¡Vamos a la ducha! | VAMOS DUCHA
¡Vamos a trabajar! | VAMOS TRABAJAR
Estoy muy enfadado | YO ENFADADO
Te quiero mucho | YO AMOR
Dame un abrazo | VAMOS AMOR
¡Vamos a estudiar! | VAMOS ESTUDIAR
¡Vamos a hacer los deberes! | VAMOS DEBERES
¡Vamos a la calle! | VAMOS CALLE
¡Vamos a pasear! | VAMOS PASEAR
¿Estas cansado? | TÚ CANSADO
¿Estas malo? | TÚ ENFERMO
¿Estás mejor? | TÚ MEJOR
¿Me ayudas? | AYÚDAME
¿Qué quieres comer? | TÚ COMER QUÉ
¿Qué te apetece hacer? | TÚ HACER QUÉ
¿Qué te duele? | TÚ DOLER QUÉ
¿Tienes hambre? | TÚ HAMBRE
¿Tienes miedo? | TÚ MIEDO
¡Cuidado! Eso puede romperse! | CUIDADO ESO ROMPER
Dame eso, por favor | DAME POR_FAVOR DAME
Dame la mano | DAME MANO
Dame un beso | TÚ BESO
"""
PAIRS = [tuple(line.split(" | ")) for line in PUBLISHED.splitlines()]


@pytest.mark.parametrize("way", WAYS_OF_TYPING)
def test_all_39_sentences_are_exact(translator: Translator, way: str) -> None:
    got = {sentence: str(translator.translate(WAYS_OF_TYPING[way](sentence))) for sentence, _ in PAIRS}
    assert len(got) == 39
    assert got == dict(PAIRS)


def test_all_39_sentences_come_from_the_model_and_each_is_one_sentence(translator: Translator) -> None:
    for sentence, _ in PAIRS:
        translation = translator.translate(sentence)
        assert len(translation.sentences) == 1, sentence
        for token in translation.sentences[0].tokens:
            assert token.confidence > 0.95
            assert token.kind is (Kind.LETTER if token.gloss == "X" else Kind.LEXICAL)


def test_the_data_file_holds_the_published_pairs() -> None:
    pairs = paper_pairs()
    assert [(pair.sentence, " ".join(map(gloss_name, pair.glosses))) for pair in pairs] == PAIRS


def test_the_predictions_file_holds_the_papers_first_ten() -> None:
    assert [" ".join(pair.glosses) for pair in paper_predictions()] == [
        "Tú Bien",
        "Bien Dormir",
        "Colegio",
        "Venga Levantar Tú Colegio Ir",
        "Colegio",
        "Colegio",
        "Edad Cuántos",
        "Ana Quién",
        "Tú Nombre Cuál",
        "Mi Nombre",
    ]
    assert [pair.sentence for pair in paper_predictions()] == [pair.sentence for pair in paper_pairs()[:10]]


def test_the_alignment_is_of_the_published_pairs() -> None:
    aligned = read_aligned_pairs(data_file("paper_alignment.tsv"))
    slotted = [
        (pair.sentence.replace(NUMBER, "X"), [g.replace(NUMBER, "X") for g in pair.glosses])
        for pair in aligned
    ]
    assert slotted == [(pair.sentence, list(map(gloss_name, pair.glosses))) for pair in paper_pairs()]


def test_the_shipped_model_knows_every_sentence_that_it_was_taught() -> None:
    model = load_model("lstm256")
    wrong = [source for source, target in shipped_examples() if model.predict(source).tokens != target]
    assert wrong == []


def test_the_card_names_the_data_that_the_package_holds() -> None:
    card = read_card("lstm256")
    assert card["data"]["sha256"] == training_data_hash(), (
        "data changed: run `ros2 run teo_sign_translator train`"
    )
    assert card["data"]["pairs"] == len(training_pairs())
