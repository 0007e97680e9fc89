# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_translator.morphology.spanish import feminine, plural


@pytest.mark.parametrize(
    ("singular", "several"),
    [
        ("casa", "casas"),
        ("café", "cafés"),
        ("sofá", "sofás"),
        ("rubí", "rubíes"),
        ("papel", "papeles"),
        ("lápiz", "lápices"),
        ("pez", "peces"),
        ("joven", "jóvenes"),
        ("examen", "exámenes"),
        ("imagen", "imágenes"),
        ("origen", "orígenes"),
        ("volumen", "volúmenes"),
        ("canción", "canciones"),
        ("alemán", "alemanes"),
        ("inglés", "ingleses"),
        ("autobús", "autobuses"),
        ("país", "países"),
        ("raíz", "raíces"),
        ("árbol", "árboles"),
        ("azúcar", "azúcares"),
        ("mes", "meses"),
        ("gas", "gases"),
        ("ley", "leyes"),
        ("reloj", "relojes"),
        ("guion", "guiones"),
        ("tren", "trenes"),
        ("crisis", "crisis"),
        ("lunes", "lunes"),
        ("paraguas", "paraguas"),
        ("cumpleaños", "cumpleaños"),
        ("robot", "robots"),
        ("chat", "chats"),
        ("sándwich", "sándwiches"),
        ("whisky", "whiskys"),
    ],
)
def test_plurals_follow_the_orthography(singular: str, several: str) -> None:
    assert plural(singular) == several


@pytest.mark.parametrize(
    ("masculine", "other"),
    [
        ("niño", "niña"),
        ("profesor", "profesora"),
        ("jefe", "jefa"),
        ("alemán", "alemana"),
        ("inglés", "inglesa"),
        ("español", "española"),
        ("andaluz", "andaluza"),
        ("campeón", "campeona"),
        ("bailarín", "bailarina"),
    ],
)
def test_feminines_follow_the_orthography(masculine: str, other: str) -> None:
    assert feminine(masculine) == other
