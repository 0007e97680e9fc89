# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Mapping, Set
from dataclasses import replace

import pytest
from msgspec.structs import replace as changed
from refusals import refused

from teo_sign_languages import Numbers, load_language
from teo_signs.errors import LutError
from teo_signs.lexicon import Lexicon, number_glosses
from teo_signs.look_up_table import Lut
from teo_signs.sign import Form, Sign
from teo_signs.tokens import Kind, Token

MakeSign = Callable[..., Sign]


def resolved(table: Mapping[str, Sign], *tokens: Token) -> list[tuple[str, str]]:
    signs = Lexicon(table).resolve(tokens)
    return [(item.token.gloss, "pause" if item.sign is None else item.sign.gloss) for item in signs]


def lexical(gloss: str) -> Token:
    return Token(gloss=gloss)


@pytest.mark.parametrize(
    ("token", "glosses", "signs"),
    [
        (lexical("TÚ"), "TÚ", "TÚ"),
        (Token(gloss="7", kind=Kind.NUMBER), "7", "7"),
        (lexical("CALLÁ"), "C A LL A", "C A LL A"),  # the longest letters first
        (lexical("CAÑA"), "C A Ñ A", "C A Ñ A"),  # the tilde of ñ is no accent
        (lexical("LA 17"), "L A  1 7", "L A pause 1 7"),
        (Token(gloss="171", kind=Kind.NUMBER), "1 7 1", "1 7 1"),
        (Token(gloss="Á", kind=Kind.LETTER), "Á", "A"),
    ],
)
def test_a_token_is_the_tables_sign_or_is_spelled(
    table: Mapping[str, Sign], token: Token, glosses: str, signs: str
) -> None:
    assert resolved(table, token) == list(zip(glosses.split(" "), signs.split(" "), strict=True))


def test_letters_of_a_missing_gloss_keep_what_the_token_said(table: Mapping[str, Sign]) -> None:
    (item,) = Lexicon(table).resolve([lexical("A")])
    assert item.token.kind == Kind.LETTER, "no word of that name"
    token = Token(gloss="LANA", confidence=0.5, duration_scale=2.0, word_index=3, source_words=("Lana",))
    for item in Lexicon(table).resolve([token]):
        kept = item.token
        assert (kept.kind, kept.confidence, kept.duration_scale) == (Kind.LETTER, 0.5, 2.0)
        assert (kept.word_index, kept.source_words) == (3, ("Lana",))


def digits(text: str, *, word: int = 0) -> list[Token]:
    """A number as the translator sends it: a token for each digit, of one word."""
    return [Token(gloss=digit, kind=Kind.NUMBER, word_index=word) for digit in text]


def test_a_number_with_a_sign_of_its_own_is_made_with_it(
    table: Mapping[str, Sign], make_sign: MakeSign
) -> None:
    eleven = make_sign("11", table["1"].knots, kind="number")
    signs = {**table, "11": eleven}
    assert resolved(signs, Token(gloss="11", kind=Kind.NUMBER)) == [("11", "11")]
    assert resolved(signs, *digits("11")) == [("11", "11")]
    # One word is one number: no part of a longer one, and no two words.
    assert resolved(signs, *digits("711")) == [("7", "7"), ("1", "1"), ("1", "1")]
    assert resolved(signs, Token(gloss="711", kind=Kind.NUMBER)) == [("7", "7"), ("1", "1"), ("1", "1")]
    assert resolved(signs, *digits("1"), *digits("1", word=1)) == [("1", "1"), ("1", "1")]


def test_a_number_of_too_low_a_standing_is_signed_in_digits_which_are_always_used(
    table: Mapping[str, Sign], make_sign: MakeSign
) -> None:
    def sketched(sign: Sign) -> Sign:
        return replace(sign, provenance=changed(sign.provenance, standing="sketched"))

    signs = {
        **table,
        "1": sketched(table["1"]),
        "11": sketched(make_sign("11", table["1"].knots, kind="number")),
    }
    assert resolved(signs, *digits("11")) == [("1", "1"), ("1", "1")]
    (whole,) = Lexicon(signs, least_standing="sketched").resolve(digits("11"))
    assert whole.token.gloss == "11"


def test_the_package_composes_numbers_of_what_its_table_holds() -> None:
    lut = Lut.open()
    for number, signs in {"40": "40", "352": "3 100 5 2", "20015": "20 1000 15", "007": "0 0 7"}.items():
        expected = [(gloss, gloss) for gloss in signs.split()]
        assert resolved(lut, Token(gloss=number, kind=Kind.NUMBER)) == expected
        assert resolved(lut, *digits(number)) == expected  # sent digit by digit, as others may


def test_a_token_is_made_in_the_form_that_it_asks_for_if_the_sign_has_it(table: Mapping[str, Sign]) -> None:
    you = table["TÚ"]
    moved = Form(times=you.times, knots=you.knots + 0.01)
    signs = {**table, "TÚ": replace(you, forms={"2>1": moved})}
    form, other, citation = (
        item.sign
        for item in Lexicon(signs).resolve(
            [Token(gloss="TÚ", inflection=inflection) for inflection in ("2>1", "1>3", "")]
        )
    )
    assert form is not None and form.knots is moved.knots
    assert other is signs["TÚ"] and citation is signs["TÚ"]


@pytest.mark.parametrize(
    ("token", "named"),
    [
        (lexical("L'A"), '"\'"'),
        (Token(gloss="W", kind=Kind.LETTER), "'W'"),
        (Token(gloss="9", kind=Kind.NUMBER), "'9'"),
        (Token(gloss="A", kind=Kind.NUMBER), "'A'"),
        (Token(gloss="TÚ", kind=Kind.LETTER), "'TÚ'"),
        (lexical("你好"), "'你'"),
    ],
)
def test_what_the_table_cannot_sign_is_refused_by_name(
    table: Mapping[str, Sign], token: Token, named: str
) -> None:
    with refused("unknown_sign") as refusal:
        Lexicon(table).resolve([lexical("TÚ"), token])
    assert named in str(refusal.value)
    assert repr(token.gloss) in str(refusal.value)


def test_a_broken_entry_is_refused_with_its_reason(table: Mapping[str, Sign]) -> None:
    class Broken(dict[str, Sign]):
        def __getitem__(self, gloss: str) -> Sign:
            raise LutError("not_json", f"{gloss}.json: expected JSON")

    with refused("invalid_sign", r"TÚ\.json"):
        Lexicon(Broken(table)).resolve([lexical("TÚ")])


def test_a_letter_with_an_accent_of_its_own_keeps_it_where_the_table_has_it(
    table: Mapping[str, Sign], make_sign: MakeSign
) -> None:
    ring = make_sign("Å", table["A"].knots, kind="letter")
    assert resolved(table, lexical("ÅL")) == [("A", "A"), ("L", "L")]
    assert resolved({**table, "Å": ring}, lexical("ÅL")) == [("Å", "Å"), ("L", "L")]


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
