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
from teo_sign_translator.output.sign_choice import SignChooser
from teo_sign_translator.output.substitutes import SubstituteLists
from teo_sign_translator.output.translation import Kind, Origin, Sentence
from teo_sign_translator.pipeline.translator import MAX_SENTENCE_TOKENS, Translator
from teo_sign_translator.text.cleaning import MAX_TEXT_LENGTH
from teo_sign_translator.text.reading import SentenceType


def _glosses(translator: Translator, text: str) -> str:
    return str(translator.translate(text))


def _only(translator: Translator, text: str) -> Sentence:
    (sentence,) = translator.translate(text).sentences
    return sentence


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("Me llamo Ana", "MI NOMBRE A-N-A"),
        ("me llamo ana", "MI NOMBRE A-N-A"),
        ("ME LLAMO ANA", "MI NOMBRE A-N-A"),
        ("Hola, me llamo Ana.", "HOLA MI NOMBRE A-N-A"),
        ("hola me llamo ana", "HOLA MI NOMBRE A-N-A"),
        ("Hola, me llamo Ana. ¿Qué tal?", "HOLA MI NOMBRE A-N-A TÚ BIEN"),
        ("Me llamo Guillermo", "MI NOMBRE G-U-I-LL-E-R-M-O"),
        ("Me llamo Íñigo Curro", "MI NOMBRE I-Ñ-I-G-O C-U-RR-O"),
        ("Me llamo María del Carmen de la Torre", "MI NOMBRE M-A-R-I-A D-E-L C-A-R-M-E-N D-E L-A T-O-RR-E"),
        ("Me llamo Al", "MI NOMBRE A-L"),  # also a word that LSE leaves out: the capital makes it a name
        ("Me llamo De la Cruz", "MI NOMBRE D-E L-A C-R-U-Z"),
        ("Yo tengo 7 años", "YO EDAD 7"),
        ("Yo tengo siete años", "YO EDAD 7"),
        ("Tengo treinta y cinco años", "YO EDAD 35"),
        ("tengo 12 anos", "YO EDAD 12"),
        ("¿Quién es Pedro?", "P-E-D-R-O QUIÉN"),
        ("¿Quién es Ana?", "A-N-A QUIÉN"),
        ("Soy Lucía.", "YO L-U-C-I-A"),
    ],
)
def test_names_and_numbers_are_carried_through(translator: Translator, text: str, glosses: str) -> None:
    assert _glosses(translator, text) == glosses


def test_letters_of_one_name_share_their_word(translator: Translator) -> None:
    tokens = _only(translator, "Me llamo Ana").tokens
    assert [token.gloss for token in tokens] == ["MI", "NOMBRE", "A", "N", "A"]
    assert [token.word_index for token in tokens] == [0, 1, 2, 2, 2]
    assert [token.kind for token in tokens] == [Kind.LEXICAL] * 2 + [Kind.LETTER] * 3
    assert all(token.source_words == ("Ana",) for token in tokens[2:])


def test_a_number_is_one_token_and_a_longer_one_a_token_for_each_digit(translator: Translator) -> None:
    tokens = _only(translator, "Yo tengo 12 años").tokens
    assert [(token.gloss, token.kind, token.word_index) for token in tokens[2:]] == [("12", Kind.NUMBER, 2)]
    tokens = _only(translator, "Yo tengo 1234567 años").tokens
    assert [(token.gloss, token.word_index) for token in tokens[2:]] == [(digit, 2) for digit in "1234567"]


@pytest.mark.parametrize("text", ["Hola,,, adiós", "Hola, - adiós", "(Hola) – adiós", ", hola; adiós,"])
def test_marks_give_one_pause_between_words_and_none_at_the_ends(translator: Translator, text: str) -> None:
    assert [token.gloss for token in _only(translator, text).tokens] == ["HOLA", "", "ADIÓS"]


@pytest.mark.parametrize(
    ("text", "glosses"),
    [
        ("Hola", "HOLA"),
        ("por favor", "POR_FAVOR"),
        ("Gracias por todo", "GRACIAS T-O-D-O"),
        ("No tengo hambre", "NO TENER HAMBRE"),
        ("Quiero comer pan", "QUERER COMER PAN"),
        ("El gato duerme en la calle", "G-A-T-O DORMIR CALLE"),
        ("¿Quién es mamá?", "QUIÉN MADRE"),
        ("Dame un lápiz", "DAME L-A-P-I-Z"),
        ("el", "E-L"),
        ("3,5 euros", "3 COMA 5 EURO"),
        ("1.000 personas", "1000 PERSONA"),
        ("50 %", "50 POR_CIENTO"),
        (" -5 grados", "MENOS 5 GRADO"),
        ("COVID-19", "C-O-V-I-D 19"),
        ("Łódź, Straße, Ærø", "L-O-D-Z S-T-R-A-S-S-E A-E-R-O"),
        ("pingüino", "P-I-N-G-U-I-N-O"),
        ("Ｈｏｌａ", "HOLA"),
    ],
)
def test_what_the_model_does_not_know_is_signed_word_by_word(
    translator: Translator, text: str, glosses: str
) -> None:
    assert _glosses(translator, text) == glosses


def test_a_known_word_is_spelled_where_a_capital_marks_a_name(translator: Translator) -> None:
    assert _glosses(translator, "Quiero ver a Casa Mano") == "QUERER VER C-A-S-A M-A-N-O"
    assert _glosses(translator, "QUIERO VER LA CASA") == "QUERER VER CASA"


@pytest.mark.parametrize(
    "text", ["El médico compra un coche", "No tengo hambre", "zzz qqq", "Mañana voy al cine"]
)
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
    ("text", "kind", "negated"),
    [
        ("¿Qué tal?", SentenceType.WH_QUESTION, False),
        ("que tal", SentenceType.WH_QUESTION, False),
        ("tu vas al colegio", SentenceType.YES_NO_QUESTION, False),
        ("vamos a comer", SentenceType.EXCLAMATION, False),
        ("Vamos a comer.", SentenceType.STATEMENT, False),
        ("Venga, levántate, que tienes que ir al colegio", SentenceType.STATEMENT, False),
        ("No tengo hambre", SentenceType.STATEMENT, True),
        ("¿No tienes hambre?", SentenceType.YES_NO_QUESTION, True),
    ],
)
def test_type_and_negation_come_with_the_sentence(
    translator: Translator, text: str, kind: SentenceType, negated: bool
) -> None:
    sentence = _only(translator, text)
    assert (sentence.type, sentence.negated) == (kind, negated)


def test_sentences_are_given_in_order_as_typed(translator: Translator) -> None:
    translation = translator.translate("Hola,  me llamo Ana. ¿Qué tal?\nBuenos días")
    assert [s.text for s in translation.sentences] == ["Hola,  me llamo Ana.", "¿Qué tal?", "Buenos días"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "empty_text"),
        (" \t\n\u00a0", "empty_text"),
        ("\x00\x07\u200b", "empty_text"),
        ("😀👍🏽", "nothing_to_sign"),
        ("¿?¡!...", "nothing_to_sign"),
        ("Привет", "unsignable_text"),
        ("Hola 世界", "unsignable_text"),
        ("مرحبا", "unsignable_text"),
        ("Hola \ud83d", "broken_encoding"),
        ("Buenos d\ufffdas", "broken_encoding"),
        ("a" * (MAX_TEXT_LENGTH + 1), "text_too_long"),
    ],
)
def test_what_cannot_be_signed_is_refused_with_a_reason(translator: Translator, text: str, code: str) -> None:
    with pytest.raises(TranslationError) as error:
        translator.translate(text)
    assert error.value.code == code


def test_the_refusal_names_the_characters(translator: Translator) -> None:
    with pytest.raises(TranslationError, match="'М' \\(CYRILLIC CAPITAL LETTER EM\\)"):
        translator.translate("Hola Мир")


def test_symbols_that_nothing_is_signed_for_are_reported(translator: Translator) -> None:
    translation = translator.translate("Hola 😀\x07 ~ adiós")
    assert str(translation) == "HOLA ADIÓS"
    assert set(translation.ignored) == {"😀", "\x07", "~"}


@pytest.mark.parametrize("word", ["hola ", "¿Qué tal? ", "que tal y "])
def test_ten_kilobytes_are_translated_within_the_limits_of_a_message(
    translator: Translator, word: str
) -> None:
    translation = translator.translate(word * (10_240 // len(word)))
    assert all(1 <= len(sentence.tokens) <= MAX_SENTENCE_TOKENS for sentence in translation.sentences)


def test_a_sentence_too_long_for_a_message_is_divided_between_words(translator: Translator) -> None:
    sentences = translator.translate("Anabel " * 300).sentences
    assert [token.gloss for s in sentences for token in s.tokens] == list("ANABEL") * 300
    assert len(sentences) == 2
    assert all(len(sentence.tokens) % 6 == 0 for sentence in sentences)
    assert all(sentence.tokens[0].word_index == 0 for sentence in sentences)


def test_a_word_too_long_for_a_message_is_divided(translator: Translator) -> None:
    sentences = translator.translate("a" * 2500).sentences
    assert [len(sentence.tokens) for sentence in sentences] == [1024, 1024, 452]
