# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A name is recognised by more than its capital."""

from __future__ import annotations

import pytest
from loaded import TEXT, morphology, read

from teo_sign_translator.morphology import lexicon
from teo_sign_translator.text.source_word import SourceWord
from teo_sign_translator.text.source_words import PEOPLE

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
    "LA CASA Y {} CON LECHE",
)


def _people() -> set[str]:
    return {name.name for name in lexicon.names(TEXT) if lexicon.NAME_TAGS[name.kind] in PEOPLE}


def _common_words() -> list[str]:
    """Every hundredth word of the lexicon, inflected, that is no given name."""
    given = {name.name.lower() for name in lexicon.names(TEXT) if name.kind in ("m", "f")}
    forms = [form.written for word in lexicon.nouns(TEXT) for form in lexicon.nominal_forms(word)]
    forms += [form.written for word in lexicon.adjectives(TEXT) for form in lexicon.nominal_forms(word)]
    forms += [morphology().inflect(verb, "V:ind:pres:3s") for verb in lexicon.verbs(TEXT)]
    return [form for form in forms if form not in given and " " not in form][::20]


def _found(sentence: str, typed: str) -> SourceWord:
    return next(word for word in read(sentence) if word.text == typed)


def _may_be_name(word: SourceWord) -> bool:
    return any(reading.tag in PEOPLE for reading in word.readings)


@pytest.mark.parametrize("position", POSITIONS)
def test_a_word_that_spanish_has_is_no_name_where_its_capital_is_explained(position: str) -> None:
    def typed(word: str) -> str:
        return word.upper() if position.isupper() else word.capitalize()

    wrong = [
        word
        for word in _common_words()
        if _may_be_name(_found(position.format(typed(word)), typed(word)))
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
    assert read("Rosa y Pablo se casan.")[0].tag == "NAME:f"
    assert read("Rosa y azul, por favor.")[0].tag != "NAME:f"


def test_whom_something_is_done_to_is_no_part_of_the_name_before() -> None:
    words = read("Pago la ropa de Samuel a María.")
    assert [word.tag for word in words if word.form == "a"] == ["PREP"]
