# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers in digits and in words."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from teo_common.text_folding import fold
from teo_sign_translator.data_files import words_of

#: Numbers from 0 to 29, the tens from 30 on and the hundreds, in words.
UNITS = words_of(
    "cero uno dos tres cuatro cinco seis siete ocho nueve diez once doce trece catorce quince dieciséis "
    "diecisiete dieciocho diecinueve veinte veintiuno veintidós veintitrés veinticuatro veinticinco "
    "veintiséis veintisiete veintiocho veintinueve"
)
TENS = words_of("treinta cuarenta cincuenta sesenta setenta ochenta noventa")
HUNDREDS = words_of(
    "ciento doscientos trescientos cuatrocientos quinientos seiscientos setecientos ochocientos novecientos"
)

_SMALL = {fold(word): value for value, word in enumerate(UNITS)} | {"veintiun": 21, "veintiuna": 21}
_TEN = {word: 10 * value for value, word in enumerate(TENS, start=3)}
_HUNDRED = {word: 100 * value for value, word in enumerate(HUNDREDS, start=1)} | {"cien": 100}
_HUNDRED |= {word.replace("ientos", "ientas"): value for word, value in _HUNDRED.items()}

#: Words that numbers are made of, folded.
NUMBER_WORDS = frozenset({*_SMALL, *_TEN, *_HUNDRED, "mil"})

#: Those that are written with an accent.
ACCENTED_NUMBER_WORDS = frozenset({*(word for word in UNITS if word != fold(word)), "veintiún"})

_ORDINALS = {
    str(value): word
    for value, word in enumerate(
        words_of("primero segundo tercero cuarto quinto sexto séptimo octavo noveno décimo"), start=1
    )
}
_MONTHS = words_of("enero febrero marzo abril mayo junio julio agosto septiembre octubre noviembre diciembre")
# Words before a day and a month in digits; without one of them "1/2" is a half.
_BEFORE_DATES = frozenset(
    words_of("el al del día dia lunes martes miércoles miercoles jueves viernes sábado sabado domingo hasta")
)

_DIGITS = re.compile(r"\d+(?:[.,]\d+)*")
_THOUSANDS = re.compile(r"[1-9]\d{0,2}(?:\.\d{3})+(?:,\d+)?")
# More digits behind a space are a telephone number in groups: "91 624 99 99".
_SPACED_THOUSANDS = re.compile(r"[1-9]\d{0,2}(?: \d{3})+(?![\d.,]*\d| \d)")
_ORDINAL = re.compile(r"(\d+)(?:\.?[ºª](?! ?[cC]\b)|\.er\b|(?:er|ro|do|to|mo|vo|no|ra|da|ta)\b)")
_TIME = re.compile(r"([01]?\d|2[0-3])(?:[:h]([0-5]\d)(?![\d:])|\.([0-5]\d)(?= ?h\b))")
_DATE = re.compile(r"(0?[1-9]|[12]\d|3[01])([/.-])(0?[1-9]|1[0-2])(?:\2(\d{4}|\d\d))?(?![/\d]|[.,]\d)")


_ROMAN = re.compile(r"(?=..)X{0,3}(?:IX|IV|V?I{0,3})")
_ROMAN_LETTERS = {"I": 1, "V": 5, "X": 10}


class Digits(NamedTuple):
    """Something said in digits.

    Attributes:
        start: Where it begins in the text.
        stop: Where it ends.
        value: Digits, with one `,` if it has decimals, or one `:` in a time of day; empty for a month.
        stands_for: The word that is said: a month's name, an ordinal up to ten; else empty.
    """

    start: int
    stop: int
    value: str
    stands_for: str = ""


def read_number_words(words: Sequence[str]) -> tuple[int, int]:
    """Read the longest number below a million that the words begin with.

    Args:
        words: Folded words (lower case, no accents), e.g. `["treinta", "y", "cinco", "años"]`.

    Returns:
        Its value and how many words say it, here 35 and 3; `(0, 0)` if the words begin with no number.
        A lone "un" or "una" is an article, not a number.
    """
    value, used = _below_thousand(words)
    if list(words[used : used + 1]) == ["mil"] and (value > 1 or not used):
        below, more = _below_thousand(words[used + 1 :])
        # "mil cero" is two numbers, not one.
        return (value or 1) * 1000 + below, used + 1 + (more if below else 0)
    return value, used


def _below_thousand(words: Sequence[str]) -> tuple[int, int]:
    total = used = 0
    if words and words[0] in _HUNDRED:
        total, used = _HUNDRED[words[0]], 1
        if words[0] == "cien":
            return total, used
    rest = words[used:]
    if rest and rest[0] in _TEN:
        total, used = total + _TEN[rest[0]], used + 1
        if len(rest) > 2 and rest[1] == "y":
            unit = 1 if rest[2] in ("un", "una") else _SMALL.get(rest[2], 0)
            if 0 < unit < 10:
                return total + unit, used + 2
    elif rest and rest[0] in _SMALL and not (used and rest[0] == "cero"):
        total, used = total + _SMALL[rest[0]], used + 1
    elif used and rest and rest[0] in ("un", "una"):  # "ciento un días"
        total, used = total + 1, used + 1
    return total, used


def roman_value(word: str) -> int:
    """Value of a Roman numeral in capitals, 2 to 39, of two letters or more (`XXI`, `VI`); 0 for others."""
    if not _ROMAN.fullmatch(word):
        return 0
    values = [_ROMAN_LETTERS[letter] for letter in word]
    return sum(
        -value if any(after > value for after in values[place + 1 : place + 2]) else value
        for place, value in enumerate(values)
    )


def match_digits(text: str, start: int, before: str = "") -> list[Digits]:
    """Read what is said in digits at a place of a text: a number, an ordinal, a time of day, a date.

    Spanish writes thousands with points or spaces and decimals with a comma; a single point is taken for a
    decimal one too. Anything else is several numbers.

    Args:
        text: Clean text.
        start: Where a digit may be.
        before: The word before it, in lower case; tells `el 1/2`, a date, from `1/2 kilo`.

    Returns:
        What was found, in order; empty if no digit is there.
    """
    time = _TIME.match(text, start)
    if time is not None:
        return [Digits(start, time.end(), f"{time[1]}:{time[2] or time[3]}")]
    ordinal = _ORDINAL.match(text, start)
    if ordinal is not None:
        return [Digits(start, ordinal.end(), ordinal[1], _ordinal(ordinal[1], ordinal[0][-1]))]
    date = _DATE.match(text, start)
    if date is not None and (date[4] or (date[2] == "/" and (int(date[1]) > 12 or before in _BEFORE_DATES))):
        day = Digits(*date.span(1), date[1].lstrip("0"))
        month = Digits(*date.span(3), "", _MONTHS[int(date[3]) - 1])
        return [day, month, Digits(*date.span(4), date[4])] if date[4] else [day, month]
    spaced = _SPACED_THOUSANDS.match(text, start)
    if spaced is not None:
        return [Digits(start, spaced.end(), spaced[0].replace(" ", ""))]
    match = _DIGITS.match(text, start)
    if match is None:
        return []
    found = match.group()
    if _THOUSANDS.fullmatch(found):
        return [Digits(match.start(), match.end(), found.replace(".", ""))]
    parts = list(re.finditer(r"\d+", found))
    if len(parts) == 2:
        return [Digits(match.start(), match.end(), found.replace(".", ","))]
    return [Digits(start + part.start(), start + part.end(), part.group()) for part in parts]


def _ordinal(digits: str, mark: str) -> str:
    """The word of an ordinal that has one; its gender is that of the mark's last letter."""
    if digits not in _ORDINALS:
        return ""
    word = _ORDINALS[digits]
    return word[:-1] + "a" if mark in "ªa" else word
