"""The notation of accepted translations."""

from __future__ import annotations

import pytest

from teo_sign_translator.accepted import accepted
from teo_sign_translator.errors import TranslationError


def test_choices_brackets_and_alternatives_stand_for_every_combination() -> None:
    assert accepted("YO (PASADO) PAN/BOLLO COMER || PAN COMER YO") == {
        ("YO", "PAN", "COMER"),
        ("YO", "BOLLO", "COMER"),
        ("YO", "PASADO", "PAN", "COMER"),
        ("YO", "PASADO", "BOLLO", "COMER"),
        ("PAN", "COMER", "YO"),
    }
    assert accepted("(A/B) C") == {("C",), ("A", "C"), ("B", "C")}


@pytest.mark.parametrize(
    "pattern", ["", "YO ||", "YO (PAN COMER)", "YO PAN/ COMER", "(YO", " ".join(["(A)"] * 400)]
)
def test_a_slip_of_the_pen_is_found(pattern: str) -> None:
    with pytest.raises(TranslationError) as caught:
        accepted(pattern)
    assert caught.value.code == "invalid_data"
