# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A name is recognised by more than its capital."""

from __future__ import annotations

import pytest
from loaded import morphology

from teo_sign_translator.morphology import lexicon
from teo_sign_translator.text.source_word import SourceWord
from teo_sign_translator.text.source_words import PEOPLE, source_words

#: Where a capital says nothing; `{}` is the word, with a capital.
POSITIONS = (
    "{}",
    "Ana dijo: {} y adiós",
    "Ana dijo: «{} y adiós»",
    "- {} y adiós",
    "Hola. {} y adiós",
    "Hola, ¿{} y adiós?",
    "¿«{} y adiós»?",
    "(Hola) ({} y adiós)",
    "Hola.\n{} y adiós",
)


def _people() -> set[str]:
    return {name.name for name in lexicon.names() if lexicon.NAME_TAGS[name.kind] in PEOPLE}


def _common_words() -> list[str]:
    """Every twentieth word of the lexicon, inflected, that is no given name."""
    given = {name.name.lower() for name in lexicon.names() if name.kind in ("m", "f")}
    forms = [form.written for word in lexicon.nouns() for form in lexicon.nominal_forms(word)]
    forms += [form.written for word in lexicon.adjectives() for form in lexicon.nominal_forms(word)]
    forms += [morphology().inflect(verb.lemma, "V:ind:pres:3s") for verb in lexicon.verbs()]
    return [form for form in forms if form not in given and " " not in form][::20]


def _read(sentence: str) -> tuple[SourceWord, ...]:
    return source_words(sentence, morphology())


def _found(sentence: str, typed: str) -> SourceWord:
    return next(word for word in _read(sentence) if word.text == typed)


def _may_be_name(word: SourceWord) -> bool:
    return any(reading.tag in PEOPLE for reading in word.readings)


@pytest.mark.parametrize("position", POSITIONS)
def test_a_word_that_spanish_has_is_no_name_where_its_capital_is_explained(position: str) -> None:
    wrong = [
        word
        for word in _common_words()
        if _may_be_name(_found(position.format(word.capitalize()), word.capitalize()))
        and not morphology().readings(word)[0].tag.startswith("NAME")
    ]
    assert wrong == []


def test_nor_in_a_text_that_is_all_in_capitals() -> None:
    wrong = [
        word
        for word in _common_words()
        if _may_be_name(_found(f"LA CASA Y {word.upper()} CON LECHE", word.upper()))
        and not morphology().readings(word)[0].tag.startswith("NAME")
    ]
    assert wrong == []


def test_a_listed_name_inside_a_sentence_is_one() -> None:
    missed = [name for name in _people() if not _may_be_name(_found(f"Quiero ver a {name} hoy", name))]
    assert missed == []


@pytest.mark.parametrize(
    ("sentence", "word"),
    [
        ("Quiero ver a Xandrolf", "Xandrolf"),
        ("Me llamo rosa", "rosa"),
        ("Vivo con ana segura", "segura"),
        ("El señor Cuesta no está", "Cuesta"),
        ("Rosa viene mañana", "Rosa"),
        ("Ana dijo: Rosa viene", "Rosa"),
        ("QUIERO VER A ANA", "ANA"),
    ],
)
def test_a_name_is_one_by_what_stands_beside_it(sentence: str, word: str) -> None:
    assert _may_be_name(_found(sentence, word))


@pytest.mark.parametrize(
    ("sentence", "word"),
    [
        ("la casa es segura", "segura"),
        ("La casa es Grande", "Grande"),
        ("Voy a la Universidad", "Universidad"),
        ("Paz y amor", "Paz"),
        ("La rosa huele", "rosa"),
    ],
)
def test_a_common_word_that_nothing_makes_a_name_is_none(sentence: str, word: str) -> None:
    assert not _may_be_name(_found(sentence, word))


def test_a_name_beside_a_name_is_one_at_the_beginning_too() -> None:
    assert source_words("Rosa y Pablo se casan.", morphology())[0].readings[0].tag == "NAME:f"
    assert source_words("Rosa y azul, por favor.", morphology())[0].readings[0].tag != "NAME:f"


def test_whom_something_is_done_to_is_no_part_of_the_name_before() -> None:
    words = source_words("Pago la ropa de Samuel a María.", morphology())
    assert [word.readings[0].tag for word in words if word.form == "a"] == ["PREP"]
