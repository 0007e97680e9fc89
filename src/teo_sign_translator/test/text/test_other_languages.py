# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is not Spanish is refused by name; Spanish is not, however it is typed."""

from __future__ import annotations

import pytest
from loaded import TEXT, morphology

from teo_sign_translator.data_files import read_listed
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.other_languages import NOISE, OtherLanguage, OtherLanguages
from teo_sign_translator.text.reading import read


@pytest.fixture(scope="module")
def others() -> OtherLanguages:
    return OtherLanguages.load(TEXT, "Spanish", morphology())


def _found(others: OtherLanguages, text: str) -> OtherLanguage | None:
    return others.find(read(clean(text).text).clauses)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("My sister lives in the city.", "English"),
        ("O meu irmão trabalha numa fábrica.", "Portuguese"),
        ("Vull aprendre a parlar amb les mans.", "Catalan"),
        ("Domani non posso venire.", "Italian"),
        ("asdkfj qwrtpsd", NOISE),
    ],
)
def test_another_language_is_named_with_the_words_that_are_not_spanish(
    others: OtherLanguages, text: str, name: str
) -> None:
    found = _found(others, text)
    assert found is not None
    assert found.name == name
    assert 2 * len(found.unknown) >= found.words


@pytest.mark.parametrize(
    "text",
    [
        "Me llamo Łukasz Szczeciński y vivo en Schwarzwald.",
        "ola k ase, tngo q ir al mdico",
        "Juega al World of Warcraft",
        "Escribe a the.one@you.com",
        "Schwarz",
        "zzz",
        "1984",
    ],
)
def test_spanish_with_names_slips_and_loan_words_is_spanish(others: OtherLanguages, text: str) -> None:
    assert _found(others, text) is None


def test_no_telling_word_is_a_spanish_one() -> None:
    for language, words in read_listed(TEXT / "other_languages.tsv", str.istitle, "a language").items():
        spanish = {word for word in words if any(each.exact for each in morphology().readings(word))}
        assert not spanish, language
