# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""No word of a sentence is lost in its translation, and none is signed twice."""

from __future__ import annotations

import pytest
from loaded import TEXT, read

from teo_sign_languages import load_language
from teo_sign_training.corpus.generator import Generator
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.pipeline.completeness import Completeness
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.text.source_words import source_words


def _hypothesis(said: str) -> Hypothesis:
    """Glosses written with their words' places: `NIÑA(1) LECHE(3)`; one written alone looks at no word."""
    glosses = []
    for each in said.split():
        gloss, _, places = each.rstrip(")").partition("(")
        sources = tuple(map(int, places.split(","))) if places else ()
        glosses.append(OutputGloss(gloss, sources, 0.9, True))
    return Hypothesis(tuple(glosses), -1.0)


def _completed(sentence: str, *hypotheses: str) -> str:
    result = Completeness.load(TEXT).complete(read(sentence), map(_hypothesis, hypotheses))
    return " ".join(gloss.gloss for gloss in result.glosses)


@pytest.mark.parametrize(
    ("sentence", "said", "lost"),
    [
        # Articles, copulas, auxiliaries and most prepositions need no gloss.
        ("La niña bebe la leche.", "", "niña bebe leche"),
        ("Soy de Sevilla, pero vivo en Madrid.", "", "sevilla pero vivo madrid"),
        ("¿Quién ha roto una ventana?", "", "quién roto ventana"),
        ("esta cansada", "", "cansada"),
        ("Nunca voy sin ti", "", "nunca voy sin ti"),
        # A gloss signs its own word and those that are listed for it.
        ("La niña bebe leche.", "NIÑA(1) LECHE(2,3)", "bebe"),
        ("Bebo leche.", "YO(0) LECHE(1)", "bebo"),
        ("¿Cuántos años tienes?", "EDAD(1) CUÁNTOS(0)", ""),
        ("Como porque quiero", "YO(0) COMER(0) MOTIVO(1) QUERER(2)", ""),
        ("Gato, gato, gato", "GATO(0,2,4)", "gato gato"),
        ("Sé lengua de signos", "LENGUA_DE_SIGNOS(3) SABER(0)", ""),
        ("¿Qué comes?", "COMER(1)", "qué"),
        ("¿Qué tal el día?", "DÍA(3) BIEN(0)", ""),
        ("No quiero nada", "YO(1) QUERER(1) NADA(2)", ""),
        ("No quiero, no puedo", "YO(1) QUERER(1) NO(0) PODER(4)", "no"),
        ("No hay pan y no voy", "PAN(2) NO_HAY(0,1) YO(5) IR(5)", "no"),
        ("Dos camas, no una", "2(0) CAMA(1) VERDAD(3)", "no"),
        ("Vienes mañana, ¿no?", "MAÑANA(1) TÚ(0) VENIR(0)", ""),
        ("Mañana voy a comer", "MAÑANA(0) COMER(3)", ""),
        ("Ana come 3 peras", "ALGUIEN(0,2,3) COMER(1)", "ana 3 peras"),
    ],
)
def test_what_no_gloss_signs_is_left_out(sentence: str, said: str, lost: str) -> None:
    words = read(sentence)
    places = Completeness.load(TEXT).left_out(words, _hypothesis(said).glosses)
    assert " ".join(words[place].form for place in places) == lost


@pytest.mark.parametrize(("language", "share"), [("ssp", 0.01), ("ase", 0.0)])
def test_what_the_grammar_translates_loses_no_word(language: str, share: float) -> None:
    text = load_language(language).text
    words = Morphology.load(text)
    completeness = Completeness.load(text)
    pairs = list(Generator.load(text / "grammar", words).pairs(1500, seed=7))
    lossy = []
    for pair in pairs:
        said = [
            OutputGloss(gloss, places, 0.9, copied=True)
            for gloss, places in zip(pair.glosses, pair.alignment, strict=True)
        ]
        if completeness.left_out(source_words(pair.text, words), said):
            lossy.append(f"{pair.text} -> {' '.join(pair.glosses)}")
    # The odd rule leaves a word to the context; many would be a list that the grammar has outgrown.
    assert len(lossy) <= share * len(pairs), "\n".join(lossy[:20])


def test_the_translation_that_leaves_out_the_fewest_words_is_taken() -> None:
    whole = "NIÑA(1) LECHE(3) FRÍO(4) BEBER(2)"
    assert _completed("La niña bebe leche fría.", "NIÑA(1)", "", whole) == "NIÑA LECHE FRÍO BEBER"


@pytest.mark.parametrize(
    ("said", "completed"),
    [
        ("NIÑA(1) LECHE(3) FRÍO(4) BEBER(2)", "NIÑA LECHE FRÍO BEBER"),
        ("NIÑA(1) LECHE(3) BEBER(2)", "NIÑA LECHE FRÍO BEBER"),
        ("LECHE(3) FRÍO(4) BEBER(2)", "LECHE FRÍO NIÑA BEBER"),
        ("LECHE(1,3,4) BEBER(2)", "LECHE FRÍO NIÑA BEBER"),
        ("", "NIÑA BEBER LECHE FRÍO"),
    ],
)
def test_what_is_left_out_is_put_back_beside_its_neighbour(said: str, completed: str) -> None:
    assert _completed("La niña bebe leche fría.", said) == completed


@pytest.mark.parametrize(
    ("sentence", "said", "completed"),
    [
        ("¿Cuándo come Ana?", "ANA(2) COMER(1)", "ANA COMER CUÁNDO"),
        ("No veo a Ana", "YO(1) VER(1)", "YO NO VER ANA"),
        ("Compra 7 gatos", "GATO(2) COMPRAR(0)", "GATO COMPRAR 7"),
        ("Por favor, come", "COMER(3)", "POR_FAVOR COMER"),
    ],
)
def test_questions_negations_names_numbers_courtesies_are_put_back(
    sentence: str, said: str, completed: str
) -> None:
    assert _completed(sentence, said) == completed


@pytest.mark.parametrize(
    ("sentence", "said", "completed"),
    [
        ("El tren de Bilbao llega.", "BILBAO(3) TREN(1) BILBAO(3) LLEGAR(4)", "BILBAO TREN LLEGAR"),
        ("Gato y gato", "GATO(0) GATO(2)", "GATO GATO"),
        ("Ahora no.", "NO(1) AHORA(0)", "NO AHORA"),
    ],
)
def test_a_word_is_carried_over_as_often_as_it_is_there(sentence: str, said: str, completed: str) -> None:
    assert _completed(sentence, said) == completed


def test_a_sentence_of_function_words_alone_has_them_all() -> None:
    assert _completed("de la", "") == "DE EL"
