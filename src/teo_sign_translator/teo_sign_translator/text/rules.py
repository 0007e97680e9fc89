# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What reading a text needs to know of its language: `reading.yaml` and `expressions.tsv`."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.data_files import data_file, invalid_line, read_rows, read_sections
from teo_sign_translator.text.numerals import Numerals

_CLASSES = ("title", "unit", "word", "chat", "particle")


@dataclass(frozen=True, slots=True)
class Expression:
    """What a short form or symbol stands for.

    Attributes:
        category: One of the classes that `text/expressions.tsv` explains.
        words: What it says, in lower case; a word of several parts has spaces inside.
    """

    category: str
    words: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Found:
    """An expression at a place of a text.

    Attributes:
        expression: What it is.
        stop: Where it ends, its point included.
        pointed: Whether its last character is a point.
    """

    expression: Expression
    stop: int
    pointed: bool


class Expressions:
    """Finds short forms and symbols at a place of a text."""

    def __init__(self, entries: dict[str, tuple[Expression, ...]]) -> None:
        """Index the entries, one of each class, by how they are typed, in lower case."""
        self._entries = dict(entries)
        # Longest first: "p. ej." before "p".
        forms = sorted(entries, key=len, reverse=True)
        pattern = "|".join(map(_form_pattern, forms))
        self._pattern = re.compile(f"(?:{pattern})", re.IGNORECASE) if forms else None
        self._initials = {form[0] for form in forms} | {form[0].upper() for form in forms}

    @classmethod
    def load(cls, path: Path) -> Expressions:
        """Read a language's `expressions.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        entries: dict[str, tuple[Expression, ...]] = {}
        for number, (forms, category, said) in read_rows(path, columns=3):
            words = tuple(word.replace("_", " ") for word in said.split())
            for form in (form.strip() for form in forms.split(",")):
                others = entries.get(form, ())
                again = any(each.category == category for each in others)
                if category not in _CLASSES or not form or form != form.lower() or again:
                    expected = "short forms in lower case, each once in a class, and a class of "
                    got = f"'{form}' and '{category}'"
                    raise invalid_line(path, number, expected + ", ".join(_CLASSES), got)
                entries[form] = (*others, Expression(category, words))
        return cls(entries)

    def stands_for(self, form: str) -> tuple[str, ...]:
        """The words that a form in lower case stands for; none if it is not listed."""
        expressions = self._entries.get(form.lower(), ())
        return expressions[0].words if expressions else ()

    def match(self, text: str, start: int, *, after_number: bool) -> Found | None:
        """The longest expression that begins at a place of a clean text where a word may begin.

        Args:
            text: The whole of it.
            start: The place.
            after_number: Whether a number stands just before, so that a unit may follow.
        """
        if text[start] not in self._initials or self._pattern is None:
            return None
        match = self._pattern.match(text, start)
        if match is None:
            return None
        typed = match.group()
        form = " ".join(typed.lower().split())
        expressions = self._entries.get(form) or self._entries.get(form.removesuffix("."), ())
        for expression in expressions:
            pointed = form in self._entries and typed.endswith(".")
            if _fits(expression.category, typed, text[:start], text[match.end() :], pointed, after_number):
                return Found(expression, match.end(), typed.endswith("."))
        return None


def _fits(category: str, typed: str, before: str, behind: str, pointed: bool, after_number: bool) -> bool:
    """Whether what was typed is a short form of a class there.

    Args:
        category: The class.
        typed: The form, its point included.
        before: The text before it.
        behind: The text behind it.
        pointed: Whether its point is its own.
        after_number: Whether a number stands just before.
    """
    if category == "unit":
        return after_number
    if category == "particle":
        return typed.islower() and behind[:1] == " " and behind[1:2].isalnum()
    if category == "chat" and len(typed.removesuffix(".")) == 1 and typed.isupper():
        said = before.rstrip(" ¿¡")
        return not said or said[-1] in ".?!…\n"
    # "D. Juan", but not "vitamina d."
    return not (category == "title" and pointed) or behind.lstrip(" ")[:1].isupper()


def _form_pattern(form: str) -> str:
    """Matches a form as typed, as a whole word, with a point behind it if it has none of its own."""
    escaped = re.escape(form).replace(r"\ ", r" +")
    if not form[-1].isalpha():
        return escaped
    # "km." at the end of a sentence keeps its point: it may be both.
    return rf"{escaped}(?!\w)\.?(?![\w])" if form.isalpha() else rf"{escaped}(?!\w)"


_FILE = "reading.yaml"


@dataclass(frozen=True)
class SentenceWords:
    """Words that tell what kind of sentence it is; `sentences` in the file.

    Attributes:
        interrogatives: Question words, as written.
        unmarked_starts: Words that begin a question far more often than a statement, if no mark is typed.
        unmarked_pairs: The same of two words in a row, folded.
        leading: Words that may stand before the question word ("¿Y tú de dónde eres?").
        negatives: Words that negate a sentence.
        not_negative: Pairs whose second word does not negate it ("de nada").
        tags: Words that are no negation where they alone are asked behind a sentence ("…, ¿no?").
    """

    interrogatives: frozenset[str]
    unmarked_starts: frozenset[str]
    unmarked_pairs: frozenset[tuple[str, str]]
    leading: frozenset[str]
    negatives: frozenset[str]
    not_negative: frozenset[tuple[str, str]]
    tags: frozenset[str]

    @cached_property
    def folded_interrogatives(self) -> frozenset[str]:
        """The question words without accents."""
        return frozenset(map(fold, self.interrogatives))


@dataclass(frozen=True)
class SpecialWords:
    """Single words that reading treats in a way of their own; `words` in the file.

    Attributes:
        laughter: Pattern of laughter as it is typed, in any case.
        laugh: The word that laughter stands for.
        minus: The word of a minus sign.
        asked_reason: A word that is two words, those of `reason`, at the beginning of a question; or empty.
        reason: See `asked_reason`.
        introducing: Lemmas behind which a name stands ("me llamo Rosa").
        inside_names: Words before a surname that are part of it ("de la Torre").
        subject_tags: Ends of the tags of verbs that a name without an article may be the subject of.
        sounds: By a pattern of what is typed by its sound, the spellings that sound so (`k`: `c qu`), "" for
            a letter that is not written.
        superlative: What an adjective is, without marks, if its form says a degree; empty for none.
        degree: The word that says it: "carísimo" is "muy caro".
    """

    laughter: re.Pattern[str]
    laugh: str
    minus: str
    asked_reason: str
    reason: tuple[str, ...]
    introducing: frozenset[str]
    inside_names: frozenset[str]
    subject_tags: tuple[str, ...]
    sounds: dict[str, str]
    superlative: re.Pattern[str]
    degree: str

    @cached_property
    def spellings(self) -> tuple[tuple[re.Pattern[str], tuple[str, ...]], ...]:
        """`sounds`, to be looked for."""
        return tuple((re.compile(sound), tuple(so.split()) or ("",)) for sound, so in self.sounds.items())


@dataclass(frozen=True)
class Neighbours:
    """Words that tell what the word behind them is; `neighbours` in the file.

    Attributes:
        before_nouns: Forms behind which no finite verb stands, and no preposition that is a noun too.
        before_masculine: Forms of which that holds where a masculine singular may follow: "el grito", but
            "el llama" is typed for "él llama".
        copulas: Lemmas of verbs behind which no finite verb stands.
        degrees: Forms that may stand between a copula and what it says.
        perfect: What is typed for a form of the perfect's verb, in haste, and that form ("me a dicho": ha).
        infinitive: What is typed for a form that an infinitive may follow, and that form ("se ir solo": sé).
        opening: What means something else before the first verb, and that word ("igual viene": quizás).
        conditional: Word that is another before a subjunctive that opens a sentence ("como no comas": si).
        not_conditional: Dictionary forms before which it is not ("como quieras").
        misspelled: Verbs typed without an accent behind a question word ("dónde estas").
        motion: Lemmas of verbs whose form is no noun before what one comes to do ("vino a cenar").
        amounts: Forms that are no verb before others, and these ("nada más", "nada de").
    """

    before_nouns: frozenset[str]
    before_masculine: frozenset[str]
    copulas: frozenset[str]
    degrees: frozenset[str]
    perfect: dict[str, str]
    infinitive: dict[str, str]
    opening: dict[str, str]
    conditional: dict[str, str]
    not_conditional: frozenset[str]
    misspelled: dict[str, str]
    motion: frozenset[str]
    amounts: dict[str, str]


@dataclass(frozen=True)
class GlossNames:
    """Glosses that have a part of their own in what is signed; `glosses` in the file.

    Attributes:
        decimal: Between the whole and the decimals of a number ("tres coma cinco").
        name: Behind it stands somebody's name.
        currencies: Beside them a number with decimals is a price.
        symbols: Between the letters of an address ("ana@correo.es").
    """

    decimal: str
    name: str
    currencies: frozenset[str]
    symbols: dict[str, str]


@dataclass(frozen=True)
class TextRules:
    """All of it.

    Attributes:
        expressions: Short forms and symbols.
        numbers: How numbers are said and written.
        sentences: Words that tell kinds of sentence.
        words: Words that are read in a way of their own.
        neighbours: Words that tell what stands behind them.
        glosses: Names of glosses.
    """

    expressions: Expressions
    numbers: Numerals
    sentences: SentenceWords
    words: SpecialWords
    neighbours: Neighbours
    glosses: GlossNames

    @classmethod
    @cache
    def load(cls, folder: Path | None = None) -> TextRules:
        """Read the files of a language's text folder, once.

        Args:
            folder: By default that of the default language.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        folder = folder or data_file("")
        sections = {
            "numbers": Numerals,
            "sentences": SentenceWords,
            "words": SpecialWords,
            "neighbours": Neighbours,
            "glosses": GlossNames,
        }
        read = read_sections(folder / _FILE, sections)
        return cls(Expressions.load(folder / "expressions.tsv"), **read)
