# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who a text goes on about is pointed at once; nothing else of its sentences is left out."""

from __future__ import annotations

from itertools import pairwise

import pytest
from loaded import translator

from teo_sign_translator.output.translation import printed


def glosses(text: str) -> list[str]:
    return [printed(sentence.tokens) for sentence in translator().translate(text).sentences]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Ayer fui al mercado. Compré pan.", ["AYER YO MERCADO IR", "PAN COMPRAR"]),
        ("Tengo hambre. Quiero pan. No tengo dinero.", ["YO HAMBRE", "PAN QUERER", "DINERO NO"]),
        # Another person between them, or beside the verb, could be taken for who does it.
        ("Tengo hambre. Mi madre cocina. Quiero pan.", ["YO HAMBRE", "MADRE MI COCINAR", "YO PAN QUERER"]),
        ("Tengo hambre. Llamo a mi madre.", ["YO HAMBRE", "YO MADRE MI LLAMAR"]),
        # Who is typed is meant to be seen; a question asks anew.
        ("Como pan. Yo pago.", ["YO PAN COMER", "YO PAGAR"]),
        ("Tienes hambre. ¿Quieres pan?", ["TÚ HAMBRE", "TÚ PAN QUERER"]),
    ],
)
def test_who_is_known_is_not_pointed_at_again(text: str, expected: list[str]) -> None:
    assert glosses(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Tengo hambre y quiero pan.", "YO HAMBRE PAN QUERER"),
        ("No salgo porque tengo frío.", "YO SALIR NO PORQUE FRÍO"),
        # Another one acts or is acted upon between the two: who does the second thing must be seen.
        ("Llamo a mi madre porque quiero pan.", "YO MADRE MI LLAMAR PORQUE YO PAN QUERER"),
        ("Te llamo porque quiero pan.", "YO TÚ LLAMAR PORQUE YO PAN QUERER"),
    ],
)
def test_a_sentence_points_at_its_subject_once(text: str, expected: str) -> None:
    assert glosses(text) == [expected]


def test_nothing_but_a_pronoun_goes() -> None:
    alone = [
        "Ayer compré pan.", "Mi madre está enferma.", "No tengo dinero.", "Te espero en la calle.",
        "Queremos café.", "¿Tienes hambre?", "Trabajo en un banco.", "Me llamo Ana.", "Él vive en Málaga.",
        "Vendemos la casa.", "Bebo agua.", "Estoy cansada.", "Llueve.", "Estudias mucho.", "Comes pan.",
    ]  # fmt: skip
    shorter = 0
    for first, second in pairwise([*alone, *reversed(alone)]):
        together = glosses(f"{first} {second}")
        left, right = glosses(first), glosses(second)
        assert together[0] == left[0]
        lost = right[0].split()
        for gloss in together[1].split():
            lost.remove(gloss)  # ValueError if it was not there
        assert lost in ([], ["YO"], ["TÚ"], ["NOSOTROS"])
        assert not lost or (lost[0] in left[0].split() and together[1])
        shorter += bool(lost)
    assert shorter > 3
