# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who acts on whom, as a speaker of Spanish reads the sentence."""

from __future__ import annotations

import pytest
from loaded import TEXT, read

from teo_sign_translator.pipeline.agreement import Agreement

AGREEMENT = Agreement.load(TEXT)


def inflection(sentence: str, gloss: str) -> str:
    words = read(sentence)
    (verb,) = (
        place
        for place, word in enumerate(words)
        if any(reading.lemma.upper() == gloss and reading.tag.startswith("V") for reading in word.readings)
    )
    return AGREEMENT.inflection(gloss, [verb], words)


@pytest.mark.parametrize(
    ("sentence", "gloss", "expected"),
    [
        ("¿Me ayudas?", "AYUDAR", "2>1"),
        ("¿Me puedes ayudar?", "AYUDAR", "2>1"),
        ("Ayúdame.", "AYUDAR", "2>1"),
        ("¿Me ayuda, por favor?", "AYUDAR", "2>1"),
        ("¿Usted me ayuda?", "AYUDAR", "2>1"),
        ("¿Me ayuda Ana?", "AYUDAR", "3>1"),
        ("Me han ayudado.", "AYUDAR", "3>1"),
        ("Yo te ayudo.", "AYUDAR", "1>2"),
        ("Te ayudo.", "AYUDAR", "1>2"),
        ("Quiero ayudarte.", "AYUDAR", "1>2"),
        ("Me gustaría ayudarte.", "AYUDAR", "1>2"),
        ("Ana te ayuda.", "AYUDAR", "3>2"),
        ("Lo ayudo.", "AYUDAR", "1>3"),
        ("Ayudo a Ana.", "AYUDAR", "1>3"),
        ("Dámelo.", "DAR", "2>1"),
        ("Se lo doy mañana.", "DAR", "1>3"),
        ("Le pregunto a mi madre.", "PREGUNTAR", "1>3"),
        ("Le voy a pedir dinero.", "PEDIR", "1>3"),
        # An imperative that looks like the third person.
        ("Pregunta a tu padre.", "PREGUNTAR", "2>3"),
        ("Da el libro a María.", "DAR", "2>3"),
        ("Pregunta a su padre.", "PREGUNTAR", ""),
        ("Pregunta Ana a tu padre.", "PREGUNTAR", ""),
        ("Dice la verdad a Ana.", "DECIR", ""),
        ("¿Pregunta a tu padre?", "PREGUNTAR", ""),
        ("Cuando viene, pregunta a tu padre.", "PREGUNTAR", ""),
        # What is given is no person, and nobody is named.
        ("Lo doy.", "DAR", ""),
        ("Quiero ayudar.", "AYUDAR", ""),
        ("Pido perdón.", "PEDIR", ""),
        # Oneself: no way from one to another.
        ("Me pregunto dónde está.", "PREGUNTAR", ""),
        # Another clause says another verb's persons.
        ("Si me llamas, pregunto.", "PREGUNTAR", ""),
    ],
)
def test_persons_are_those_that_the_clause_says(sentence: str, gloss: str, expected: str) -> None:
    assert inflection(sentence, gloss) == expected


@pytest.mark.parametrize(
    ("sentence", "expected"),
    [
        ("Me duele la cabeza.", "CABEZA"),
        ("¿Te duele el estómago?", "ESTÓMAGO"),
        ("Ya no me duele la garganta.", "GARGANTA"),
        ("Me duele.", ""),
        ("Me duele la cabeza y el cuello.", ""),
        ("Me duele el alma.", ""),
    ],
)
def test_pain_is_signed_where_it_is_if_one_place_is_named(sentence: str, expected: str) -> None:
    assert inflection(sentence, "DOLER") == expected


def test_other_signs_have_no_inflection() -> None:
    words = read("Te quiero.")
    assert AGREEMENT.inflection("QUERER", [1], words) == ""
    assert AGREEMENT.inflection("AYUDAR", [], words) == ""
    assert AGREEMENT.inflection("AYUDAR", [0, 1], words) == ""
