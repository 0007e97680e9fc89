# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Translating with a sentence model: what becomes of its glosses."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from loaded import morphology
from word_by_word_model import WordByWordModel, translator_with

from teo_sign_translator.output.translation import Kind, Origin, Sentence
from teo_sign_translator.pipeline.pointer_back_end import MOST_WORDS, divided
from teo_sign_translator.pipeline.translator import MAX_SENTENCE_TOKENS, Translator
from teo_sign_translator.pointer import Hypothesis, OutputGloss
from teo_sign_translator.text.reading import SentenceType
from teo_sign_translator.text.source_word import SourceWord
from teo_sign_translator.text.source_words import source_words


@pytest.fixture(scope="module")
def copying() -> Translator:
    return translator_with(WordByWordModel())


def _only(translator: Translator, text: str) -> Sentence:
    (sentence,) = translator.translate(text).sentences
    return sentence


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("La niña bebe leche.", "NIÑA BEBER LECHE"),
        ("Quiero ver a Ana", "QUERER VER A-N-A"),
        ("mi nombre rosa", "MI NOMBRE R-O-S-A"),
        ("Vivo en Madrid", "VIVIR MADRID"),
        ("Estudio en la UC3M", "ESTUDIAR U-C 3 M"),
        ("Veo treinta y dos gatos", "VER 32 GATO"),
        ("Cuesta 3,5 €", "COSTAR 3 50 EURO"),
        ("Cuesta 1,529 €", "COSTAR 1 COMA 529 EURO"),
        ("Comprar 3,5 metros", "COMPRAR 3 COMA 5 METRO"),
        ("Llama al 91 624 99 99", "LLAMAR 91 624 99 99"),
        ("Veo 1.250.000 gatos", "VER 1250000 GATO"),
        ("Viene a las 15:30 h", "VENIR 15 30 HORA"),
        ("Viene a las 15:00", "VENIR 15"),
        ("El 10 % vive en EE. UU.", "10 POR_CIENTO VIVIR ESTADOS_UNIDOS"),
        ("El", "EL"),
        ("&", "Y"),
    ],
)
def test_glosses_become_signs_letters_and_digits(copying: Translator, text: str, glosses: str) -> None:
    assert str(copying.translate(text)) == glosses


def test_each_token_says_how_it_came_about_and_from_which_words(copying: Translator) -> None:
    sentence = _only(copying, "Ana ve 2 gatos en la casa.")
    assert [(token.gloss, token.origin, token.source_words) for token in sentence.tokens] == [
        ("A", Origin.SPELLED, ("Ana",)),
        ("N", Origin.SPELLED, ("Ana",)),
        ("A", Origin.SPELLED, ("Ana",)),
        ("VER", Origin.MODEL, ("ve",)),
        ("2", Origin.NUMBER, ("2",)),
        ("GATO", Origin.MODEL, ("gatos",)),
        ("CASA", Origin.MODEL, ("casa",)),
    ]
    assert sentence.dropped == ("en", "la")


def test_a_mark_inside_is_a_pause_where_the_translation_parts_there(copying: Translator) -> None:
    kinds = [token.kind for token in _only(copying, "Hola, quiero comer.").tokens]
    assert kinds == [Kind.LEXICAL, Kind.PAUSE, Kind.LEXICAL, Kind.LEXICAL]
    backwards = translator_with(WordByWordModel(reverse=True))
    assert all(token.kind is Kind.LEXICAL for token in _only(backwards, "Hola, quiero comer.").tokens)


def test_a_word_that_the_model_loses_is_put_back_and_the_sentence_called_uncertain() -> None:
    lossy = translator_with(WordByWordModel(loses=["leche"]))
    sentence = _only(lossy, "La niña bebe leche.")
    assert [token.gloss for token in sentence.tokens] == ["NIÑA", "BEBER", "LECHE"]
    assert [token.origin for token in sentence.tokens] == [Origin.MODEL, Origin.MODEL, Origin.REPAIRED]
    assert sentence.uncertain
    assert not _only(lossy, "La niña bebe agua.").uncertain


@pytest.mark.parametrize("text", ["hola " * 200, "hola, " * 200, "hola, " * 10 + "a b " * 40, "hola " * 40])
def test_no_part_is_longer_than_the_model_has_seen_and_none_is_lost(text: str) -> None:
    words = source_words(text, morphology())
    parts = divided(words)
    assert all(0 < len(part) <= MOST_WORDS for part in parts)
    assert [word for part in parts for word in part] == list(words)


class MemorisedPair:
    """Knows one answer by heart."""

    name = "by heart"

    def __init__(self, *glosses: tuple[str, tuple[int, ...]]) -> None:
        self._answer = Hypothesis(tuple(OutputGloss(g, places, 1.0, False) for g, places in glosses), -1.0)

    def translate_all(
        self,
        sentences: Sequence[Sequence[SourceWord]],
        *,
        beam: int = 1,  # noqa: ARG002 - the protocol
        unsaid: object = None,  # noqa: ARG002
    ) -> tuple[tuple[Hypothesis, ...], ...]:
        places = [place for gloss in self._answer.glosses for place in gloss.sources]
        return tuple(
            (self._answer if len(words) > max(places) else Hypothesis((), 0.0),) for words in sentences
        )


def test_what_the_paper_leaves_out_is_no_loss() -> None:
    paper = translator_with(MemorisedPair(("BIEN", (1,)), ("DORMIR", (4,))))
    assert str(paper.translate("Estoy bien pero tengo sueño")) == "BIEN DORMIR"
    assert str(paper.translate("estoy bien pero tengo sueno")) == "BIEN DORMIR"
    assert "PERO" in str(paper.translate("Estoy bien pero tengo frío")).split()


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Me llamo Al", "A-L"),
        ("me llamo rosa", "R-O-S-A"),
        ("Me llamo María del Carmen de la Torre", "M-A-R-I-A D-E-L C-A-R-M-E-N D-E L-A T-O-RR-E"),
    ],
)
def test_all_words_of_a_name_are_spelled(text: str, name: str) -> None:
    forgetful = translator_with(MemorisedPair(("MI", (0,)), ("NOMBRE", (1,))))
    assert str(forgetful.translate(text)) == f"MI NOMBRE {name}"


def test_the_papers_own_name_is_a_sign_and_all_others_are_spelled(copying: Translator) -> None:
    paper = translator_with(MemorisedPair(("ANA", (0,)), ("QUIÉN", (3,))))
    assert str(paper.translate("Ana, ¿quién es Ana?")) == "ANA QUIÉN"
    assert str(copying.translate("¿Quién es Ana?")) == "QUIÉN A-N-A"


def test_sentences_given_as_one_are_one(copying: Translator) -> None:
    assert len(copying.translate("¡Cuidado! Eso puede romperse!").sentences) == 1
    assert len(copying.translate("¡Cuidado! Eso quema!").sentences) == 2


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("ese chico es quién", SentenceType.WH_QUESTION),
        ("ese chico es quién.", SentenceType.STATEMENT),
        ("ese chico come pan", SentenceType.STATEMENT),
    ],
)
def test_a_question_word_signed_last_asks_unless_a_mark_says_otherwise(
    copying: Translator, text: str, kind: SentenceType
) -> None:
    assert _only(copying, text).type is kind


@pytest.mark.parametrize("word", ["a", "el ", "1", "hola, "])
def test_ten_kilobytes_are_translated_within_the_limits_of_a_message(copying: Translator, word: str) -> None:
    translation = copying.translate(word * (10_240 // len(word)))
    assert all(1 <= len(sentence.tokens) <= MAX_SENTENCE_TOKENS for sentence in translation.sentences)


def test_many_texts_give_what_each_gives_alone(copying: Translator) -> None:
    texts = ["Hola, Ana. ¿Qué tal?", "", "Привет", "La niña bebe leche. " * 3]
    answers = copying.translate_all(texts)
    codes = [getattr(answer, "code", None) for answer in answers]
    assert codes == [None, "empty_text", "unsignable_text", None]
    assert answers[0] == copying.translate(texts[0])
    assert answers[3] == copying.translate(texts[3])
