# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is not Spanish is refused by name; Spanish is not, however it is typed."""

from __future__ import annotations

import pytest

from teo_sign_translator.data_files import data_file, read_listed
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.other_languages import NOISE, OtherLanguage, OtherLanguages
from teo_sign_translator.text.reading import read

MORPHOLOGY = Morphology.load()
OTHERS = OtherLanguages.load(data_file(""), "Spanish", MORPHOLOGY)


def _found(text: str) -> OtherLanguage | None:
    return OTHERS.find(read(clean(text).text).clauses)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("My sister lives in the city.", "English"),
        ("thank you", "English"),
        ("Nous habitons près de la gare.", "French"),
        ("O meu irmão trabalha numa fábrica.", "Portuguese"),
        ("Vull aprendre a parlar amb les mans.", "Catalan"),
        ("Ich wohne in Berlin und arbeite viel.", "German"),
        ("Domani non posso venire.", "Italian"),
        ("asdkfj qwrtpsd", NOISE),
    ],
)
def test_another_language_is_named_with_the_words_that_are_not_spanish(text: str, name: str) -> None:
    found = _found(text)
    assert found is not None
    assert found.name == name
    assert 2 * len(found.unknown) >= found.words


@pytest.mark.parametrize(
    "text",
    [
        "Me llamo Łukasz Szczeciński y vivo en Schwarzwald.",
        "ola k ase, tngo q ir al mdico",
        "Juega al World of Warcraft",
        "Nos vemos en el meeting del workshop.",
        "Escribe a the.one@you.com",
        "Schwarz",
        "zzz",
        "1984",
    ],
)
def test_spanish_with_names_slips_and_loan_words_is_spanish(text: str) -> None:
    assert _found(text) is None


def test_no_telling_word_is_a_spanish_one() -> None:
    for language, words in read_listed(data_file("other_languages.tsv"), str.istitle, "a language").items():
        spanish = {word for word in words if any(each.exact for each in MORPHOLOGY.readings(word))}
        assert not spanish, language
