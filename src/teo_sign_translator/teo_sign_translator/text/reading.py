# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A clean text as clauses of words, the type of a sentence, and whether it is negated."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from enum import Enum, IntEnum

from teo_common.text_folding import fold, strip_marks
from teo_sign_translator.text.cleaning import shortened
from teo_sign_translator.text.numerals import Numerals
from teo_sign_translator.text.rules import Found, SentenceWords, TextRules

_LETTERS_AND_DIGITS = re.compile(r"[^\W_]+")
# Of mail and of the web, those without "www." by the endings that people write most here. A name before "@"
# has at most 64 characters, a label 63 (RFC 5321, 1035): without bounds a long row of marks takes seconds.
_ADDRESS = re.compile(
    r"[A-Za-z0-9][\w.+-]{0,63}@[A-Za-z0-9-]{1,63}(?:\.[A-Za-z0-9-]{1,63}){1,8}"
    r"|(?:https?://|www\.)[A-Za-z0-9./?=&_%#-]*[A-Za-z0-9/]"
    r"|[A-Za-z0-9-]{1,63}(?:\.[A-Za-z0-9-]{1,63}){0,8}\.(?:com|org|net|info|edu|es|eu|uk)(?![\w@])(?:/[A-Za-z0-9./_-]*[A-Za-z0-9/])?",
    re.ASCII,
)
_SCHEME = re.compile(r"https?://")
_PAUSES = ",;:()[]{}–—―"
#: Marks behind which a capital says nothing of the word; of a quote, only where one opens.
_EXPLAINING = ":([{–—―•*¿¡"
_QUOTES = "\"'"
_SHORTEST_LAUGHTER = 4


class WordKind(Enum):
    """What a word is made of."""

    LETTERS = "letters"
    NUMBER = "number"
    ADDRESS = "address"


@dataclass(frozen=True, slots=True)
class Word:
    """A word of the text, or several that say one number.

    Attributes:
        parts: The words as typed; several only for a number in words (`treinta y cinco`).
        kind: What it is made of.
        value: Digits of a number, with one `,` if it has decimals, or one `:` in a time of day; else empty.
        stands_for: What a short form, symbol or ordinal says, in lower case; else empty. Words that one short
            form stands for have the same `parts`.
        after_mark: Whether a mark behind which a capital means nothing stands just before it: a colon, a
            dash, an opening bracket or quote.
    """

    parts: tuple[str, ...]
    kind: WordKind
    value: str = ""
    stands_for: str = ""
    after_mark: bool = False

    @property
    def text(self) -> str:
        """As typed."""
        return " ".join(self.parts)

    @property
    def lower(self) -> str:
        """What it says, in lower case, with accents."""
        return self.stands_for or self.text.lower()

    @property
    def fold(self) -> str:
        """What it says, in lower case, without accents."""
        return fold(self.lower)

    @property
    def key(self) -> str:
        """What it says, in lower case, without any mark: equal for all ways of typing the word."""
        return strip_marks(self.lower)

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


def read(text: str, rules: TextRules | None = None) -> Reading:
    """Split a clean text, as `cleaning.clean` gives it, into clauses and words.

    Args:
        text: Clean text.
        rules: Of its language; by default the default language's.
    """
    return _Reader(text, rules or TextRules.load()).read()


class _Reader:
    """Goes through a text once, from left to right."""

    def __init__(self, text: str, rules: TextRules) -> None:
        self._text = text
        self._rules = rules
        self._clauses: list[Clause] = []
        self._ignored: list[str] = []
        self._words: list[Word] = []
        self._opening = ""
        self._start = 0

    def read(self) -> Reading:
        index = 0
        while index < len(self._text):
            index = index + 1 if self._text[index] == " " else self._step(index)
        self._close("", closes=True, stop=len(self._text))
        return Reading(tuple(self._clauses), tuple(self._ignored))

    def _step(self, index: int) -> int:
        """Read what begins at an index; return the index behind it."""
        text = self._text
        character = text[index]
        after = index + 1
        address = _ADDRESS.match(text, index)
        if address is not None:
            said = _SCHEME.sub("", address.group()).lower()  # nobody says how a page is fetched
            self._add(Word((address.group(),), WordKind.ADDRESS, stands_for=said), index)
            return address.end()
        if character in "0123456789":
            return self._digits(index)
        found = self._rules.expressions.match(text, index, after_number=self._after_number())
        if found is not None:
            return self._expression(index, found)
        if _is_letter(character):
            after = _word_end(text, after)
            if self._is_laughter(text[index:after]):
                self._laugh(index, after)
            else:
                self._add(
                    Word((text[index:after],), WordKind.LETTERS, after_mark=_is_after_mark(text, index)),
                    index,
                )
        elif character in "-−" and _is_minus(text, index):
            self._add(Word((character,), WordKind.LETTERS, stands_for=self._rules.words.minus), index)
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
        """Read a number, ordinal, time or date."""
        said = self._rules.numbers.match_digits(
            self._text, index, self._words[-1].lower if self._words else ""
        )
        for part in said:
            typed = (self._text[part.start : part.stop],)
            kind = WordKind.NUMBER if part.value else WordKind.LETTERS
            self._add(Word(typed, kind, part.value, part.stands_for), part.start)
        return said[-1].stop

    def _expression(self, index: int, found: Found) -> int:
        """Read a short form or symbol; its point may end the sentence too."""
        typed = (self._text[index : found.stop],)
        for word in found.expression.words:
            self._add(Word(typed, WordKind.LETTERS, stands_for=word), index)
        if found.pointed and found.expression.category != "title":
            following = self._text[found.stop :].lstrip(" ")[:1]
            if not following or following.isupper() or following in "¿¡\n":
                self._close(".", closes=True, stop=found.stop)
        return found.stop

    def _after_number(self) -> bool:
        """Whether a number stands just before, so that a unit may follow."""
        return bool(self._words) and (
            self._words[-1].kind is WordKind.NUMBER or self._words[-1].fold in self._rules.numbers.words
        )

    def _laugh(self, start: int, stop: int) -> None:
        """Laughter is a sentence of its own: it says nothing of what stands beside it."""
        if self._words:
            self._close("", closes=True, stop=start)
        self._add(
            Word((self._text[start:stop],), WordKind.LETTERS, stands_for=self._rules.words.laugh), start
        )
        self._close("", closes=True, stop=stop)

    def _is_laughter(self, word: str) -> bool:
        return self._rules.words.laughter.fullmatch(word) is not None and (
            len(word) >= _SHORTEST_LAUGHTER or word.lower().startswith("xd")
        )

    def _points(self, start: int, stop: int) -> None:
        """One point or several: the end of the sentence, a pause, or part of an abbreviation or address."""
        following = self._text[stop : stop + 1]
        if stop - start > 1 or self._text[start] == "…":
            rest = self._text[stop:].lstrip(" ")[:1]
            closes = not (rest.islower() or rest.isdigit())
            self._close("." if closes else ",", closes=closes, stop=stop)
            return
        last = self._words[-1].parts[-1] if self._words and self._text[start - 1 : start].isalnum() else ""
        if len(last) == 1 and last.isupper():  # "J. Gil"
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
            words = _join_number_words(self._words, self._rules.numbers)
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


def _word_end(text: str, index: int) -> int:
    """Where a word ends that has begun before an index: letters, digits behind them ("UC3M"), and accents."""
    while True:
        match = _LETTERS_AND_DIGITS.match(text, index)
        index = match.end() if match else index
        if index == len(text) or unicodedata.category(text[index])[0] != "M":
            return index
        index += 1


def _is_after_mark(text: str, index: int) -> bool:
    """Whether a mark before an index explains a capital there: `dijo: Ven`, `"Ven"`, `— Ven`, `- Ven`."""
    if index == 0:
        return False
    if text[index - 1] != " ":
        before = text[max(0, index - 2) : index - 1]
        return text[index - 1] in _EXPLAINING or (text[index - 1] in _QUOTES and not before.strip(" ¿¡(:"))
    while index > 0 and text[index - 1] == " ":
        index -= 1
    return index > 0 and (
        text[index - 1] in _EXPLAINING or (text[index - 1] == "-" and _stands_alone(text, index - 1))
    )


def _is_minus(text: str, index: int) -> bool:
    """Whether a dash belongs to the number behind it: `-5`, but not `COVID-19` or `10-12`."""
    return text[index + 1 : index + 2].isdigit() and not text[max(0, index - 1) : index].isalnum()


def _stands_alone(text: str, index: int) -> bool:
    return not (text[max(0, index - 1) : index].strip() and text[index + 1 : index + 2].strip())


def _join_number_words(words: Sequence[Word], numbers: Numerals) -> tuple[Word, ...]:
    """Make one word of words that say one number."""
    folded = [_number_key(word, numbers.accented) for word in words]
    result: list[Word] = []
    index = 0
    while index < len(words):
        # The longest number below a million takes eleven words.
        value, used = numbers.read_words(folded[index : index + 12])
        if used:
            parts = tuple(part for word in words[index : index + used] for part in word.parts)
            result.append(Word(parts, WordKind.NUMBER, str(value)))
            index += used
        else:
            result.append(words[index])
            index += 1
    return tuple(result)


def _number_key(word: Word, accented: Collection[str]) -> str:
    """A word as numbers are looked up; empty if it can be part of none: "Díez" is a name, not ten."""
    typed_right = word.fold == word.lower or word.lower in accented
    return word.fold if word.kind is WordKind.LETTERS and typed_right else ""


class SentenceType(IntEnum):
    """Types of sentences, which the robot shows with its head; values are those of `SignSentence`."""

    STATEMENT = 0
    YES_NO_QUESTION = 1
    WH_QUESTION = 2
    EXCLAMATION = 3


def sentence_type(clauses: Sequence[Clause], rules: TextRules | None = None) -> SentenceType:
    """The type of a sentence from its marks and, where they were not typed, from its question words.

    Args:
        clauses: Of the sentence.
        rules: Of its language; by default the default language's.
    """
    words = (rules or TextRules.load()).sentences
    asking = [clause for clause in clauses if clause.end == "?" or clause.opening == "¿"]
    if asking:
        wh = any(_asks_with_word(clause.words, words) for clause in asking)
        return SentenceType.WH_QUESTION if wh else SentenceType.YES_NO_QUESTION
    if any(clause.end == "!" or clause.opening == "¡" for clause in clauses):
        return SentenceType.EXCLAMATION
    if clauses and _starts_unmarked_question(clauses[-1].words, words):
        return SentenceType.WH_QUESTION
    return SentenceType.STATEMENT


def is_negated(clauses: Sequence[Clause], rules: TextRules | None = None) -> bool:
    """Whether a sentence holds a negative word, other than the tag "…, ¿no?" and the reply "de nada".

    Args:
        clauses: Of the sentence.
        rules: Of its language; by default the default language's.
    """
    listed = (rules or TextRules.load()).sentences
    for index, clause in enumerate(clauses):
        words = [shortened(word.lower) for word in clause.words]
        if index and len(words) == 1 and words[0] in listed.tags and clause.end == "?":
            continue
        for place, word in enumerate(words):
            if word in listed.negatives and (words[max(0, place - 1)], word) not in listed.not_negative:
                return True
    return False


def _asks_with_word(words: Sequence[Word], listed: SentenceWords) -> bool:
    """Whether a question has its question word first (behind leading words), or last: "¿Haces qué?"."""
    lower = [word.lower for word in words]
    if lower and lower[-1] in listed.interrogatives:
        return True
    for word in words:
        if word.fold in listed.folded_interrogatives:
            return True
        if word.lower not in listed.leading:
            return False
    return False


def _starts_unmarked_question(words: Sequence[Word], listed: SentenceWords) -> bool:
    first = next((i for i, word in enumerate(words) if word.lower not in listed.leading), None)
    if first is None:
        return False
    if words[first].lower in listed.interrogatives | listed.unmarked_starts:
        return True
    return len(words) > first + 1 and (words[first].lower, words[first + 1].lower) in listed.unmarked_pairs
