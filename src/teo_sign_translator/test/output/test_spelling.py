# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from teo_sign_translator.output.output_words import Spelling


@pytest.mark.parametrize(
    ("word", "signs"),
    [
        ("Ana", "A N A"),
        ("Guillermo", "G U I LL E R M O"),
        ("Chorra", "CH O RR A"),
        ("LLUVIA", "LL U V I A"),
        ("Ñoño", "Ñ O Ñ O"),
        ("n\u0303u", "Ñ U"),
        ("pingüino", "P I N G U I N O"),
        ("Barça", "B A R C A"),
        ("Müßig", "M U S S I G"),
        ("llll", "LL LL"),
        ("", ""),
    ],
)
def test_spelling(word: str, signs: str) -> None:
    assert Spelling.load().letters(word) == tuple(signs.split())
    assert Spelling.load().unsignable(word) == ()


def test_what_no_letter_sign_exists_for_is_named_once() -> None:
    assert Spelling.load().unsignable("Иван и Иван"[:4] + "aИ") == ("И", "в", "а", "н")
