# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

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
    seen = set()
    for number in range(1_000_000):
        signs = number_glosses(str(number), SPANISH, own.__contains__)
        assert understood(signs) == number
        assert all(sign in own or len(sign) == 1 for sign in signs)
        seen.add(signs)
    assert len(seen) == 1_000_000  # no two numbers look alike


def test_a_number_has_no_more_signs_than_spanish_has_words() -> None:
    # doscientos treinta y cinco mil cuatrocientos sesenta y ocho
    assert number_glosses("235468", SPANISH, OWN.__contains__) == (
        "2",
        "100",
        "3",
        "5",
        "1000",
        "4",
        "100",
        "6",
        "8",
    )
    assert number_glosses("1000", SPANISH, OWN.__contains__) == ("1000",)
    assert number_glosses("1100", SPANISH, OWN.__contains__) == ("1000", "100")
    assert number_glosses("305", SPANISH, OWN.__contains__) == ("3", "100", "5")


def test_a_sign_of_its_own_is_taken_wherever_the_number_is_said() -> None:
    own = OWN | {"21", "300", "2000"}
    assert number_glosses("300", SPANISH, own.__contains__) == ("300",)
    assert number_glosses("2000", SPANISH, own.__contains__) == ("2000",)
    assert number_glosses("4321", SPANISH, own.__contains__) == ("4", "1000", "3", "100", "21")


def test_without_an_operator_a_number_is_its_digits() -> None:
    assert number_glosses("352", SPANISH, {"20"}.__contains__) == ("3", "5", "2")
    assert number_glosses("2015", SPANISH, {"100", "15"}.__contains__) == ("2", "0", "1", "5")
    assert number_glosses("15", SPANISH, set().__contains__) == ("1", "5")


def test_longer_numbers_and_codes_are_read_out() -> None:
    assert number_glosses("1000000", SPANISH, OWN.__contains__) == tuple("1000000")
    assert number_glosses("0034", SPANISH, OWN.__contains__) == tuple("0034")
    assert number_glosses("00", SPANISH, OWN.__contains__) == ("0", "0")
    assert len(number_glosses("9" * 10_000, SPANISH, OWN.__contains__)) == 10_000


def test_american_hundreds_have_how_many_before_them_and_thousands_are_read_out() -> None:
    own = frozenset({*map(str, range(10, 21)), "C"})
    assert number_glosses("352", AMERICAN, own.__contains__) == ("3", "C", "5", "2")
    assert number_glosses("100", AMERICAN, own.__contains__) == ("1", "C")
    assert number_glosses("115", AMERICAN, own.__contains__) == ("1", "C", "15")
    assert number_glosses("99", AMERICAN, own.__contains__) == ("9", "9")
    assert number_glosses("1984", AMERICAN, own.__contains__) == ("1", "9", "8", "4")


def test_a_language_that_says_nothing_of_numbers_reads_them_out() -> None:
    assert number_glosses("352", Numbers(), OWN.__contains__) == ("3", "5", "2")
