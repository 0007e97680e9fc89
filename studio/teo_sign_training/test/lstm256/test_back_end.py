# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_training.corpus.paper_pairs import training_pairs
from teo_sign_training.lstm256.back_end import LstmBackEnd
from teo_sign_training.lstm256.phrasebook import Phrasebook
from teo_sign_training.lstm256.seq2seq import Prediction, TokenList
from teo_sign_training.lstm256.word_by_word import GlossList
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.sign_choice import SignChooser, SubstituteLists
from teo_sign_translator.output.translation import Origin, Sentence
from teo_sign_translator.pipeline.translator import Translator
from teo_sign_translator.text.reading import SentenceType


def _only(translator: Translator, text: str) -> Sentence:
    (sentence,) = translator.translate(text).sentences
    return sentence


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("Me llamo Ana", "MI NOMBRE A-N-A"),
        ("hola me llamo ana", "HOLA MI NOMBRE A-N-A"),
        ("Me llamo María del Carmen de la Torre", "MI NOMBRE M-A-R-I-A D-E-L C-A-R-M-E-N D-E L-A T-O-RR-E"),
        ("Me llamo Al", "MI NOMBRE A-L"),  # also a word that LSE leaves out: the capital makes it a name
        ("tengo 12 anos", "YO EDAD 12"),
        ("¿Quién es Pedro?", "P-E-D-R-O QUIÉN"),
        ("¿Quién es Ana?", "A-N-A QUIÉN"),
    ],
)
def test_names_and_numbers_are_carried_through(translator: Translator, text: str, glosses: str) -> None:
    assert str(translator.translate(text)) == glosses


@pytest.mark.parametrize("text", ["Hola,,, adiós", "Hola, - adiós", "(Hola) – adiós", ", hola; adiós,"])
def test_marks_give_one_pause_between_words_and_none_at_the_ends(translator: Translator, text: str) -> None:
    assert [token.gloss for token in _only(translator, text).tokens] == ["HOLA", "", "ADIÓS"]


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("por favor", "POR_FAVOR"),
        ("Gracias por todo", "GRACIAS T-O-D-O"),
        ("El gato duerme en la calle", "G-A-T-O DORMIR CALLE"),
        ("¿Quién es mamá?", "QUIÉN MADRE"),
        ("el", "E-L"),
        ("COVID-19", "C-O-V-I-D 19"),
    ],
)
def test_what_the_model_does_not_know_is_signed_word_by_word(
    translator: Translator, text: str, glosses: str
) -> None:
    assert str(translator.translate(text)) == glosses


def test_a_known_word_is_spelled_where_a_capital_marks_a_name(translator: Translator) -> None:
    assert str(translator.translate("Quiero ver a Casa Mano")) == "QUERER VER C-A-S-A M-A-N-O"
    assert str(translator.translate("QUIERO VER LA CASA")) == "QUERER VER CASA"


@pytest.mark.parametrize("text", ["No tengo hambre", "zzz qqq"])
def test_an_unknown_sentence_says_that_it_is_unsure(translator: Translator, text: str) -> None:
    for token in _only(translator, text).tokens:
        assert token.confidence <= 0.5
        assert token.origin is not Origin.MODEL


class _Parrot:
    """A model that says the same to everything, and is sure of it."""

    def __init__(self, *says: str, sure: float = 1.0, complete: bool = True) -> None:
        self._answer = Prediction(says, (sure,) * len(says), complete)
        self.inputs = TokenList.of_inputs(
            [["vamos", "a", "la", "calle", "que", "tal", "?", "!", "{nombre}", "{número}"]]
        )

    def predict(self, tokens: object) -> Prediction:  # noqa: ARG002 - what it is asked does not matter
        return self._answer


def _translator_with(model: _Parrot) -> Translator:
    glosses = GlossList.load()
    back_end = LstmBackEnd(model, Phrasebook(training_pairs(), glosses), glosses, name="parrot")
    return Translator(back_end, SignChooser(SubstituteLists(), None))


@pytest.mark.parametrize(
    "model",
    [
        _Parrot("TÚ", "COLEGIO"),
        _Parrot("TÚ", "BIEN", complete=False),
        _Parrot("TÚ", "BIEN", sure=0.4),
        _Parrot(),
    ],
    ids=["something else", "endless", "unsure", "silent"],
)
def test_a_model_that_is_unsure_or_says_something_else_than_it_was_taught_is_not_believed(
    model: _Parrot,
) -> None:
    assert str(_translator_with(_Parrot("TÚ", "BIEN")).translate("¿Qué tal?")) == "TÚ BIEN"
    tokens = _only(_translator_with(model), "¿Qué tal?").tokens
    assert "".join(token.gloss for token in tokens) == "QUÉTAL"
    assert Origin.MODEL not in {token.origin for token in tokens}


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("que tal", SentenceType.WH_QUESTION),
        ("tu vas al colegio", SentenceType.YES_NO_QUESTION),
        ("vamos a comer", SentenceType.EXCLAMATION),
        ("Vamos a comer.", SentenceType.STATEMENT),
    ],
)
def test_a_published_sentence_has_its_type_without_marks_too(
    translator: Translator, text: str, kind: SentenceType
) -> None:
    assert _only(translator, text).type is kind


def test_the_refusal_names_the_characters(translator: Translator) -> None:
    with pytest.raises(TranslationError, match="'М' \\(CYRILLIC CAPITAL LETTER EM\\)"):
        translator.translate("Hola Мир")


def test_symbols_that_nothing_is_signed_for_are_reported(translator: Translator) -> None:
    translation = translator.translate("Hola 😀\x07 ~ adiós")
    assert str(translation) == "HOLA ADIÓS"
    assert set(translation.ignored) == {"😀", "\x07", "~"}


def test_a_sentence_too_long_for_a_message_is_divided_between_words(translator: Translator) -> None:
    sentences = translator.translate("Anabel " * 300).sentences
    assert [token.gloss for s in sentences for token in s.tokens] == list("ANABEL") * 300
    assert len(sentences) == 2
    assert all(len(sentence.tokens) % 6 == 0 for sentence in sentences)
    assert all(sentence.tokens[0].word_index == 0 for sentence in sentences)


def test_a_word_too_long_for_a_message_is_divided(translator: Translator) -> None:
    sentences = translator.translate("a" * 2500).sentences
    assert [len(sentence.tokens) for sentence in sentences] == [1024, 1024, 452]
