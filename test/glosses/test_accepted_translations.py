# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The notation of accepted translations."""

from __future__ import annotations

import pytest

from glosses.accepted_translations import accepted, accepts
from teo_sign_translator.errors import TranslationError


@pytest.mark.parametrize(
    ("pattern", "glosses", "is_one"),
    [
        ("YO (PASADO) PAN/BOLLO COMER || PAN COMER YO", "YO PAN COMER", True),
        ("YO (PASADO) PAN/BOLLO COMER || PAN COMER YO", "YO PASADO BOLLO COMER", True),
        ("YO (PASADO) PAN/BOLLO COMER || PAN COMER YO", "YO PAN BOLLO COMER", False),
        ("YO (PASADO) PAN/BOLLO COMER || PAN COMER YO", "PASADO YO PAN COMER", False),
        ("(A/B) C", "B C", True),
        ("A-N-A QUIÉN", "ANA QUIEN", True),
        ("GRACIAS POR-FAVOR", "GRACIAS POR_FAVOR", True),
        ("AÑO", "ANO", False),
        ("TODO BIEN", "TODOBIEN", False),
    ],
)
def test_a_translation_is_accepted_if_the_pattern_stands_for_it(
    pattern: str, glosses: str, is_one: bool
) -> None:
    assert accepts(pattern, glosses.split()) is is_one


def test_what_stands_in_brackets_in_several_places_is_said_once_at_most() -> None:
    assert accepted("(YO) PAN (YO) COMER") == {
        ("PAN", "COMER"),
        ("YO", "PAN", "COMER"),
        ("PAN", "YO", "COMER"),
    }


@pytest.mark.parametrize("pattern", ["", "YO ||", "YO (PAN COMER)", "YO PAN/ COMER", "(YO"])
def test_a_slip_of_the_pen_is_found(pattern: str) -> None:
    with pytest.raises(TranslationError) as caught:
        accepts(pattern, ["YO"])
    assert caught.value.code == "invalid_data"
