"""A clean text as clauses of words."""

from __future__ import annotations

import unicodedata
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from teo_sign_translator.normalisation import fold, strip_marks
from teo_sign_translator.numerals import match_digits, read_number_words
from teo_sign_translator.tables import words_of

# A point after one of these ends no sentence.
_ABBREVIATIONS = frozenset(words_of("sr sra srta dr dra d dª dña ud uds vd vds prof avda núm pág tel ee uu"))
_PAUSES = ",;:()[]{}–—―"


class WordKind(Enum):
    """What a word is made of."""

    LETTERS = "letters"
    NUMBER = "number"
    SYMBOL = "symbol"


@dataclass(frozen=True, slots=True)
class Word:
    """A word of the text, or several that say one number.

    Attributes:
        parts: The words as typed; several only for a number in words (`treinta y cinco`).
        kind: What it is made of.
        value: Digits of a number, with one `,` if it has decimals; else empty.
    """

    parts: tuple[str, ...]
    kind: WordKind
    value: str = ""

    @property
    def lower(self) -> str:
        """Lower case, with accents."""
        return " ".join(self.parts).lower()

    @property
    def fold(self) -> str:
        """Lower case, without accents."""
        return fold(" ".join(self.parts))

    @property
    def key(self) -> str:
        """Lower case, without any mark: equal for all ways of typing the word."""
        return strip_marks(" ".join(self.parts))

    @property
    def capitalised(self) -> bool:
        """Whether it begins with a capital."""
        return self.parts[0][:1].isupper()


@dataclass(frozen=True, slots=True)
class Clause:
    """Words between two marks.

    Attributes:
        words: At least one.
        opening: The opening mark before them, `"¿"`, `"¡"` or empty.
        end: The mark behind them: `"?"`, `"!"`, `"."`, `","` (any mark that is a short pause) or empty.
        closes: Whether the sentence ends here.
        start: Where the clause begins in the text, opening mark included.
        stop: Where it ends, marks included.
    """

    words: tuple[Word, ...]
    opening: str
    end: str
    closes: bool
    start: int
    stop: int


@dataclass(frozen=True, slots=True)
class Reading:
    """A text as clauses.

    Attributes:
        clauses: In the order of the text; empty if it holds no word.
        ignored: Symbols that no sign stands for, e.g. emoji, in order.
    """

    clauses: tuple[Clause, ...]
    ignored: tuple[str, ...]


def read(text: str, symbols: Collection[str]) -> Reading:
    """Split a clean text into clauses and words.

    Args:
        text: As `normalisation.clean` gives it.
        symbols: Characters other than letters and digits that count as words, e.g. `"€"`. A minus sign or
            hyphen counts as one before a number in any case.
    """
    return _Reader(text, symbols).read()


class _Reader:
    """Goes through a text once, from left to right."""

    def __init__(self, text: str, symbols: Collection[str]) -> None:
        self._text = text
        self._symbols = symbols
        self._clauses: list[Clause] = []
        self._ignored: list[str] = []
        self._words: list[Word] = []
        self._opening = ""
        self._start = 0

    def read(self) -> Reading:
        index = 0
        while index < len(self._text):
            index = self._step(index)
        self._close("", closes=True, stop=len(self._text))
        return Reading(tuple(self._clauses), tuple(self._ignored))

    def _step(self, index: int) -> int:
        """Read what begins at an index; return the index behind it."""
        text = self._text
        character = text[index]
        after = index + 1
        if character in "0123456789":
            return self._digits(index)
        if _is_letter(character):
            while after < len(text) and (_is_letter(text[after]) or _is_mark(text[after])):
                after += 1
            self._add(Word((text[index:after],), WordKind.LETTERS), index)
        elif _is_minus(text, index) if character in "-−" else character in self._symbols:
            self._add(Word((character,), WordKind.SYMBOL), index)
        elif character in "?!":
            self._close(character, closes=True, stop=after)
        elif character in "¿¡":
            if self._words:  # "Ana ¿quién es Ana?": the question is a clause of its own
                self._close(",", closes=False, stop=index)
            if not self._opening:
                self._opening, self._start = character, index
        elif character in ".…":
            while after < len(text) and text[after] in ".…":
                after += 1
            self._points(index, after)
        elif character == "\n":
            self._close("", closes=True, stop=index)
        elif character in _PAUSES or (character == "-" and _stands_alone(text, index)):
            self._close(",", closes=False, stop=after)
        elif unicodedata.category(character)[0] == "S":
            self._ignored.append(character)
        return after

    def _digits(self, index: int) -> int:
        """Read a number; an ordinal's `º` or `ª` goes with it."""
        for start, stop, value in match_digits(self._text, index):
            after = stop + 1 if self._text[stop : stop + 1] in ("º", "ª") else stop
            self._add(Word((self._text[start:after],), WordKind.NUMBER, value), start)
            index = after
        return index

    def _points(self, start: int, stop: int) -> None:
        """One point or several: the end of the sentence, a pause, or part of an abbreviation or address."""
        following = self._text[stop : stop + 1]
        if stop - start > 1 or self._text[start] == "…":
            rest = self._text[stop:].lstrip(" ")[:1]
            closes = not (rest.islower() or rest.isdigit())
            self._close("." if closes else ",", closes=closes, stop=stop)
            return
        last = self._words[-1].parts[-1] if self._words and self._text[start - 1 : start].isalnum() else ""
        if last and (
            last.lower() in _ABBREVIATIONS or (len(last) == 1 and last.isupper() and last.isalpha())
        ):
            return
        if last and (following.islower() or following.isdigit()):
            return
        self._close(".", closes=True, stop=stop)

    def _add(self, word: Word, index: int) -> None:
        if not self._words and not self._opening:
            self._start = index
        self._words.append(word)

    def _close(self, end: str, *, closes: bool, stop: int) -> None:
        """End the clause here; marks without words belong to the clause before."""
        if self._words:
            words = _join_number_words(self._words)
            self._clauses.append(Clause(words, self._opening, end, closes, self._start, stop))
        elif self._clauses:
            before = self._clauses[-1]
            if not before.closes or self._text[before.stop : stop - 1].strip() == "":
                # "?!" asks; "…?" asks; "?." does not take the question back.
                strongest = min(before.end, end, key=lambda mark: "?!.,".index(mark) if mark else len("?!.,"))
                self._clauses[-1] = replace(before, end=strongest, closes=before.closes or closes, stop=stop)
        self._words = []
        self._opening = ""


def _is_letter(character: str) -> bool:
    """Letters of any script, and number signs that are no digits (they are reported later)."""
    return unicodedata.category(character)[0] in "LN" and character not in "0123456789"


def _is_mark(character: str) -> bool:
    return unicodedata.category(character)[0] == "M"


def _is_minus(text: str, index: int) -> bool:
    """Whether a dash belongs to the number behind it: `-5`, but not `COVID-19` or `10-12`."""
    return text[index + 1 : index + 2].isdigit() and not text[max(0, index - 1) : index].isalnum()


def _stands_alone(text: str, index: int) -> bool:
    return not (text[max(0, index - 1) : index].strip() and text[index + 1 : index + 2].strip())


def _join_number_words(words: Sequence[Word]) -> tuple[Word, ...]:
    """Make one word of words that say one number."""
    folded = [word.fold if word.kind is WordKind.LETTERS else "" for word in words]
    result: list[Word] = []
    index = 0
    while index < len(words):
        # The longest number below a million takes eleven words.
        value, used = read_number_words(folded[index : index + 12])
        if used:
            parts = tuple(part for word in words[index : index + used] for part in word.parts)
            result.append(Word(parts, WordKind.NUMBER, str(value)))
            index += used
        else:
            result.append(words[index])
            index += 1
    return tuple(result)
