# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How Spanish words are written and made, against tables written by hand."""

from __future__ import annotations

import pytest

from teo_sign_translator.morphology.spanish import attach_pronouns, detach_pronouns, feminine, plural

PLURALS = """
    casa casas, café cafés, sofá sofás, rubí rubíes, papel papeles, lápiz lápices, pez peces,
    joven jóvenes, examen exámenes, imagen imágenes, origen orígenes, volumen volúmenes,
    canción canciones, alemán alemanes, inglés ingleses, autobús autobuses, país países,
    raíz raíces, árbol árboles, azúcar azúcares, mes meses, gas gases, ley leyes, reloj relojes,
    guion guiones, tren trenes, crisis crisis, lunes lunes, paraguas paraguas,
    cumpleaños cumpleaños, robot robots, chat chats, sándwich sándwiches, whisky whiskys
"""
FEMININES = """
    niño niña, profesor profesora, jefe jefa, alemán alemana, inglés inglesa, español española,
    andaluz andaluza, campeón campeona, bailarín bailarina
"""
WITH_PRONOUNS = [
    ("di", "me lo", "dímelo"),
    ("levanta", "te", "levántate"),
    ("vamos", "nos", "vámonos"),
    ("demos", "se lo", "démoselo"),
    ("dando", "se lo", "dándoselo"),
    ("ayudar", "me", "ayudarme"),
    ("dar", "se lo", "dárselo"),
    ("sentad", "os", "sentaos"),
    ("vestid", "os", "vestíos"),
    ("id", "os", "idos"),
    ("oír", "lo", "oírlo"),
    ("reír", "se", "reírse"),
    ("dé", "me", "deme"),
    ("haz", "lo", "hazlo"),
    ("sigue", "me", "sígueme"),
    ("trae", "lo", "tráelo"),
    ("guía", "me", "guíame"),
    ("cuida", "te", "cuídate"),
    ("estudia", "lo", "estúdialo"),
    ("siente", "se", "siéntese"),
    ("ve", "te", "vete"),
    ("esté", "se", "estese"),
    ("levantad", "os", "levantaos"),
    ("limpia", "la", "límpiala"),
    ("pon", "te lo", "póntelo"),
]


def pairs(table: str) -> list[tuple[str, str]]:
    return [(first, second) for first, second in (pair.split() for pair in table.split(","))]


@pytest.mark.parametrize(("singular", "several"), pairs(PLURALS))
def test_plurals_follow_the_orthography(singular: str, several: str) -> None:
    assert plural(singular) == several


@pytest.mark.parametrize(("masculine", "other"), pairs(FEMININES))
def test_feminines_follow_the_orthography(masculine: str, other: str) -> None:
    assert feminine(masculine) == other


@pytest.mark.parametrize(("form", "pronouns", "whole"), WITH_PRONOUNS)
def test_pronouns_hang_on_a_verb_as_they_are_written_and_come_off(
    form: str, pronouns: str, whole: str
) -> None:
    plain = str.maketrans("áéíóú", "aeiou")
    clitics = tuple(pronouns.split())
    assert attach_pronouns(form, clitics) == whole
    assert (form.translate(plain), clitics) in set(detach_pronouns(whole.translate(plain)))
