# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers in digits and in words, as a language writes them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from teo_common.text_folding import fold

_DIGITS = re.compile(r"\d+(?:[.,]\d+)*")
# More digits behind a space are a telephone number in groups: "91 624 99 99".
_SPACED_THOUSANDS = re.compile(r"[1-9]\d{0,2}(?: \d{3})+(?![\d.,]*\d| \d)")
_TIME = re.compile(r"([01]?\d|2[0-3])(?:[:h]([0-5]\d)(?![\d:])|\.([0-5]\d)(?= ?h\b))")
_DAY, _MONTH = r"(?P<day>0?[1-9]|[12]\d|3[01])", r"(?P<month>0?[1-9]|1[0-2])"
_YEAR = r"(?:(?P=mark)(?P<year>\d{4}|\d\d))?(?![/\d]|[.,]\d)"
_DAY_MONTH = re.compile(rf"{_DAY}(?P<mark>[/.-]){_MONTH}{_YEAR}")
_MONTH_DAY = re.compile(rf"{_MONTH}(?P<mark>[/.-]){_DAY}{_YEAR}")

_FRACTION = re.compile(r"(\d{1,2})/(\d{1,2})(?![\d/]|[.,]\d)")

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


@dataclass(frozen=True)
class Numerals:
    """How a language says and writes numbers; `reading.yaml` of its text folder has them under `numbers`.

    Attributes:
        units: Words of the numbers from 0 on, without a gap.
        tens: Words of the tens from the first that `units` leaves out to 90.
        joiner: Word between tens and units ("treinta y uno"); empty for none.
        hundreds: Words of 100 to 900 as they stand before more, or one word that stands behind a unit.
        hundred_alone: Word of 100 where nothing follows; empty if it is the same.
        hundred_joiner: Word that may stand behind hundreds ("one hundred and five"); empty for none.
        thousand: Word of 1000, behind how many of them.
        thousand_alone: Whether 1000 is that word alone ("mil"), not "one thousand".
        variants: Other words, folded, with their values.
        ones_behind: Words that say 1 behind tens and hundreds ("ciento un"); alone they are articles.
        ones_before: Words that say 1 before hundreds and thousands ("a hundred"); alone they are articles.
        ordinals: Words of the ordinals from 1 on that are said in full.
        ordinal: Pattern of an ordinal in digits; its first group is the number.
        feminine: Last letters of an ordinal in digits that is feminine, and the last letter of its word.
        fractions: Words of a half, a third, a quarter and so on.
        fraction_plural: Ending of such a word behind a number ("tres cuartos").
        months: Their names.
        month_first: Whether a date in digits has its month first.
        before_dates: Words before a day and a month in digits; without one of them "1/2" is a half.
        decimal: Mark before decimals.
        group: Mark between groups of three digits.
    """

    units: tuple[str, ...]
    tens: tuple[str, ...]
    joiner: str
    hundreds: tuple[str, ...]
    hundred_alone: str
    hundred_joiner: str
    thousand: str
    thousand_alone: bool
    variants: dict[str, int]
    ones_behind: frozenset[str]
    ones_before: frozenset[str]
    ordinals: tuple[str, ...]
    ordinal: re.Pattern[str]
    feminine: tuple[str, str]
    fractions: tuple[str, ...]
    fraction_plural: str
    months: tuple[str, ...]
    month_first: bool
    before_dates: frozenset[str]
    decimal: str
    group: str

    @cached_property
    def words(self) -> frozenset[str]:
        """Words that numbers are made of, folded."""
        multiplier = self.hundreds if len(self.hundreds) == 1 else ()
        return frozenset({*self._small, *self._ten, *self._hundred, *multiplier, self.thousand})

    @cached_property
    def accented(self) -> frozenset[str]:
        """Those of the units that are written with an accent."""
        return frozenset(word for word in (*self.units, *self.variants) if word != fold(word))

    @cached_property
    def _small(self) -> dict[str, int]:
        small = {fold(word): value for value, word in enumerate(self.units)}
        return small | {fold(word): value for word, value in self.variants.items() if value < len(self.units)}

    @cached_property
    def _ten(self) -> dict[str, int]:
        return {word: value for value, word in zip(range(len(self.units), 100, 10), self.tens, strict=True)}

    @cached_property
    def _hundred(self) -> dict[str, int]:
        if len(self.hundreds) == 1:
            return {}
        words = {word: 100 * value for value, word in enumerate(self.hundreds, start=1)}
        return words | {word: value for word, value in self.variants.items() if value >= 100}

    @cached_property
    def _thousands(self) -> re.Pattern[str]:
        group, decimal = re.escape(self.group), re.escape(self.decimal)
        return re.compile(rf"[1-9]\d{{0,2}}(?:{group}\d{{3}})+(?:{decimal}\d+)?")

    def in_words(self, value: int) -> str:
        """A number from 0 to 9999 in words, as counted: `31` is `"treinta y uno"`."""
        if value >= 1000:
            thousands, rest = divmod(value, 1000)
            alone = thousands == 1 and self.thousand_alone
            words = self.thousand if alone else f"{self.in_words(thousands)} {self.thousand}"
            return f"{words} {self.in_words(rest)}" if rest else words
        if value == 100 and self.hundred_alone:
            return self.hundred_alone
        if value >= 100:
            hundreds, rest = divmod(value, 100)
            one_word = len(self.hundreds) == 1
            words = f"{self.units[hundreds]} {self.hundreds[0]}" if one_word else self.hundreds[hundreds - 1]
            return f"{words} {self.in_words(rest)}" if rest else words
        if value < len(self.units):
            return self.units[value]
        tens, units = divmod(value, 10)
        word = self.tens[tens - len(self.units) // 10]
        return " ".join(filter(None, [word, self.joiner, self.units[units]])) if units else word

    def read_words(self, words: Sequence[str]) -> tuple[int, int]:
        """Read the longest number below a million that the words begin with.

        Args:
            words: Folded words (lower case, no accents), e.g. `["treinta", "y", "cinco", "años"]`.

        Returns:
            Its value and how many words say it, here 35 and 3; `(0, 0)` if the words begin with no number.
            A lone "un" or "una" is an article, not a number.
        """
        value, used = self._below_thousand(words)
        if words and words[0] in self.ones_before and list(words[1:2]) == [self.thousand]:
            value, used = 1, 1
        counts = value > 1 or (not used if self.thousand_alone else value == 1)
        if list(words[used : used + 1]) == [self.thousand] and counts:
            below, more = self._below_thousand(words[used + 1 :])
            # "mil cero" is two numbers, not one.
            return (value or 1) * 1000 + below, used + 1 + (more if below else 0)
        return value, used

    def _below_thousand(self, words: Sequence[str]) -> tuple[int, int]:
        total, used = self._hundreds_of(words)
        if used and words[0] == self.hundred_alone:
            return total, used
        rest = words[used:]
        if used and self.hundred_joiner and list(rest[:1]) == [self.hundred_joiner]:
            below, more = self._below_hundred(rest[1:], inside=True)
            return (total + below, used + 1 + more) if below else (total, used)
        below, more = self._below_hundred(rest, inside=bool(used))
        return total + below, used + more

    def _hundreds_of(self, words: Sequence[str]) -> tuple[int, int]:
        if words and words[0] in self._hundred:
            return self._hundred[words[0]], 1
        if len(self.hundreds) == 1 and list(words[1:2]) == [self.hundreds[0]]:
            unit = 1 if words[0] in self.ones_before else self._small.get(words[0], 0)
            if 0 < unit < 10:
                return 100 * unit, 2
        return 0, 0

    def _below_hundred(self, words: Sequence[str], *, inside: bool) -> tuple[int, int]:
        """A number below a hundred, by itself or inside a larger one."""
        if words and words[0] in self._ten:
            ten = self._ten[words[0]]
            place = 2 if self.joiner else 1
            if len(words) > place and (not self.joiner or words[1] == self.joiner):
                unit = 1 if words[place] in self.ones_behind else self._small.get(words[place], 0)
                if 0 < unit < 10:
                    return ten + unit, place + 1
            return ten, 1
        if words and words[0] in self._small and not (inside and words[0] == fold(self.units[0])):
            return self._small[words[0]], 1
        if inside and words and words[0] in self.ones_behind:  # "ciento un días"
            return 1, 1
        return 0, 0

    def match_digits(self, text: str, start: int, before: str = "") -> list[Digits]:
        """Read what is said in digits at a place of a text: a number, ordinal, fraction, time of day or date.

        Thousands may also be written with spaces; a single mark of the other language is taken for a decimal
        one. Anything else is several numbers.

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
        ordinal = self.ordinal.match(text, start)
        if ordinal is not None:
            return [Digits(start, ordinal.end(), ordinal[1], self._ordinal(ordinal[1], ordinal[0][-1]))]
        if date := self._date(text, start, before):
            return date
        if fraction := self._fraction(text, start):
            return fraction
        spaced = _SPACED_THOUSANDS.match(text, start)
        if spaced is not None:
            return [Digits(start, spaced.end(), spaced[0].replace(" ", ""))]
        match = _DIGITS.match(text, start)
        if match is None:
            return []
        found = match.group()
        if self._thousands.fullmatch(found):
            value = found.replace(self.group, "").replace(self.decimal, ",")
            return [Digits(match.start(), match.end(), value)]
        parts = list(re.finditer(r"\d+", found))
        if len(parts) == 2:
            return [Digits(match.start(), match.end(), found.replace(".", ","))]
        return [Digits(start + part.start(), start + part.end(), part.group()) for part in parts]

    def _date(self, text: str, start: int, before: str) -> list[Digits]:
        date = (_MONTH_DAY if self.month_first else _DAY_MONTH).match(text, start)
        if date is None:
            return []
        plain = date["mark"] == "/" and (int(date["day"]) > 12 or before in self.before_dates)
        if not (date["year"] or plain):
            return []
        day = Digits(*date.span("day"), date["day"].lstrip("0"))
        month = Digits(*date.span("month"), "", self.months[int(date["month"]) - 1])
        year = [Digits(*date.span("year"), date["year"])] if date["year"] else []
        return [*((month, day) if self.month_first else (day, month)), *year]

    def _fraction(self, text: str, start: int) -> list[Digits]:
        """Read a fraction that has a word; one of them is the word alone: `1/2 kilo` is "medio kilo"."""
        fraction = _FRACTION.match(text, start)
        if fraction is None:
            return []
        count, parts = int(fraction[1]), int(fraction[2])
        if not 0 < count < parts < 2 + len(self.fractions):
            return []
        word = self.fractions[parts - 2]
        if count == 1:
            return [Digits(*fraction.span(), "", word)]
        return [
            Digits(*fraction.span(1), str(count)),
            Digits(*fraction.span(2), "", word + self.fraction_plural),
        ]

    def _ordinal(self, digits: str, mark: str) -> str:
        """The word of an ordinal that has one; its gender is that of the mark's last letter."""
        if int(digits) not in range(1, len(self.ordinals) + 1) or digits[0] == "0":
            return ""
        word = self.ordinals[int(digits) - 1]
        marks, ending = self.feminine
        return word[: -len(ending)] + ending if mark in marks and ending else word


def roman_value(word: str) -> int:
    """Value of a Roman numeral in capitals, 2 to 39, of two letters or more (`XXI`, `VI`); 0 for others."""
    if not _ROMAN.fullmatch(word):
        return 0
    values = [_ROMAN_LETTERS[letter] for letter in word]
    return sum(
        -value if any(after > value for after in values[place + 1 : place + 2]) else value
        for place, value in enumerate(values)
    )
