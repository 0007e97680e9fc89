# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Set

import pytest

from teo_sign_languages import Numbers, load_language
from teo_signs.lexicon import number_glosses

SPANISH = load_language("ssp").numbers
AMERICAN = load_language("ase").numbers

#: What the package's table holds beside the digits.
OWN = frozenset({*map(str, range(10, 21)), "30", "40", "50", "100", "1000"})


def understood(signs: tuple[str, ...]) -> int:
    """The number that a reader of the signs makes of them: an operator multiplies what stands before it."""
    total = hundreds = units = 0
    for sign in signs:
        if sign == "1000":
            total, hundreds, units = total + 1000 * (hundreds + units or 1), 0, 0
        elif sign == "100":
            hundreds, units = 100 * (units or 1), 0
        else:
            units = 10 * units + int(sign)
    return total + hundreds + units


@pytest.mark.parametrize("own", [OWN, frozenset({"100", "1000"})])
def test_every_number_below_a_million_is_understood_as_itself(own: frozenset[str]) -> None:
    # All that differ in hundreds, tens and units, and every thousand: the two are put together alike.
    numbers = [*range(3000), *range(3000, 1_000_000, 997)]
    seen = set()
    for number in numbers:
        signs = number_glosses(str(number), SPANISH, own.__contains__)
        assert understood(signs) == number
        assert all(sign in own or len(sign) == 1 for sign in signs)
        seen.add(signs)
    assert len(seen) == len(numbers)  # no two numbers look alike


MORE = OWN | {"21", "300", "2000"}
ASL = frozenset({*map(str, range(10, 21)), "C"})


@pytest.mark.parametrize(
    ("number", "language", "own", "signs"),
    [
        # doscientos treinta y cinco mil cuatrocientos sesenta y ocho: no more signs than words
        ("235468", SPANISH, OWN, "2 100 3 5 1000 4 100 6 8"),
        ("1100", SPANISH, OWN, "1000 100"),
        # A sign of its own is taken wherever the number is said.
        ("300", SPANISH, MORE, "300"),
        ("4321", SPANISH, MORE, "4 1000 3 100 21"),
        # Without an operator a number is its digits.
        ("352", SPANISH, {"20"}, "3 5 2"),
        ("2015", SPANISH, {"100", "15"}, "2 0 1 5"),
        ("15", SPANISH, set(), "1 5"),
        # Longer numbers and codes are read out.
        ("1000000", SPANISH, OWN, "1 0 0 0 0 0 0"),
        ("0034", SPANISH, OWN, "0 0 3 4"),
        ("9" * 10_000, SPANISH, OWN, " ".join("9" * 10_000)),
        # American hundreds have how many before them, and thousands are read out.
        ("352", AMERICAN, ASL, "3 C 5 2"),
        ("100", AMERICAN, ASL, "1 C"),
        ("1984", AMERICAN, ASL, "1 9 8 4"),
        ("352", Numbers(), OWN, "3 5 2"),  # a language that says nothing of numbers
    ],
    ids=lambda value: value[:9] if isinstance(value, str) else "",
)
def test_a_number_is_shown_by_these_signs(number: str, language: Numbers, own: Set[str], signs: str) -> None:
    assert number_glosses(number, language, own.__contains__) == tuple(signs.split())
