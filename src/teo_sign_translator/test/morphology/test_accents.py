# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_translator.morphology.spanish import accents_fit, stressed_vowel, syllables, unaccented


@pytest.mark.parametrize(
    ("word", "count"),
    [
        ("oía", 3),
        ("país", 2),
        ("dios", 1),
        ("ciudad", 2),
        ("queso", 2),
        ("guitarra", 3),
        ("agua", 2),
        ("pingüino", 3),
        ("aeropuerto", 5),
        ("estudiáis", 3),
        ("jesuita", 3),
        ("cigüeña", 3),
        ("guion", 1),
        ("xyz", 0),
    ],
)
def test_syllables_are_counted_around_their_vowels(word: str, count: int) -> None:
    assert len(syllables(word)) == count


@pytest.mark.parametrize(
    ("word", "marked"),
    [
        ("casa", "cAsa"),
        ("papel", "papEl"),
        ("joven", "jOven"),
        ("árbol", "Arbol"),
        ("canción", "canciOn"),
        ("ciudad", "ciudAd"),
        ("lengua", "lEngua"),
        ("ruido", "ruIdo"),
        ("viuda", "viUda"),
        ("guerra", "guErra"),
        ("seguir", "seguIr"),
    ],
)
def test_the_stress_is_where_spelling_says(word: str, marked: str) -> None:
    at = stressed_vowel(word)
    plain = unaccented(word)
    assert plain[:at] + plain[at].upper() + plain[at + 1 :] == marked


@pytest.mark.parametrize(
    ("form", "typed", "fits"),
    [
        ("cómo", "como", True),
        ("como", "cómo", False),
        ("año", "ano", True),
        ("ano", "año", False),
        ("más", "más", True),
        ("sé", "sè", False),
    ],
)
def test_marks_may_be_left_out_but_not_added(form: str, typed: str, fits: bool) -> None:
    assert accents_fit(form, typed) is fits
