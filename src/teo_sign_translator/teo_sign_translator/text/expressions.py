# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Short forms and symbols, and the words that they stand for."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from teo_sign_translator.data_files import data_file, invalid_line, read_rows

_CLASSES = ("title", "unit", "word", "chat")


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

    def __init__(self, entries: dict[str, Expression]) -> None:
        """Index the entries by how they are typed, in lower case."""
        self._entries = dict(entries)
        # Longest first: "p. ej." before "p".
        forms = sorted(entries, key=len, reverse=True)
        pattern = "|".join(map(_form_pattern, forms))
        self._pattern = re.compile(f"(?:{pattern})", re.IGNORECASE) if forms else None
        self._initials = {form[0] for form in forms} | {form[0].upper() for form in forms}

    @classmethod
    def load(cls, path: Path | None = None) -> Expressions:
        """Read the list.

        Args:
            path: The file; by default the package's `text/expressions.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = path or data_file("expressions.tsv")
        entries: dict[str, Expression] = {}
        for number, (forms, category, said) in read_rows(path, columns=3):
            words = tuple(word.replace("_", " ") for word in said.split())
            for form in (form.strip() for form in forms.split(",")):
                if category not in _CLASSES or not form or form != form.lower() or form in entries:
                    expected = "short forms in lower case, each listed once, and a class of "
                    got = f"'{form}' and '{category}'"
                    raise invalid_line(path, number, expected + ", ".join(_CLASSES), got)
                entries[form] = Expression(category, words)
        return cls(entries)

    def stands_for(self, form: str) -> tuple[str, ...]:
        """The words that a form in lower case stands for; none if it is not listed."""
        expression = self._entries.get(form.lower())
        return expression.words if expression else ()

    def match(self, text: str, start: int) -> Found | None:
        """The longest expression that begins at a place of a clean text where a word may begin.

        Whether a number stands before a unit is for the caller to see.
        """
        if text[start] not in self._initials or self._pattern is None:
            return None
        match = self._pattern.match(text, start)
        if match is None:
            return None
        typed = match.group()
        form = " ".join(typed.lower().split())
        expression = self._entries.get(form) or self._entries.get(form.removesuffix("."))
        if expression is None:
            return None
        if expression.category == "chat" and len(form) == 1 and typed.isupper():
            before = text[:start].rstrip(" ¿¡")
            if before and before[-1] not in ".?!…\n":
                return None
        if expression.category == "title" and form in self._entries and typed.endswith("."):
            following = text[match.end() :].lstrip(" ")[:1]
            if not following.isupper():  # "D. Juan", but not "vitamina d."
                return None
        return Found(expression, match.end(), typed.endswith("."))


def _form_pattern(form: str) -> str:
    """Matches a form as typed, as a whole word, with a point behind it if it has none of its own."""
    escaped = re.escape(form).replace(r"\ ", r" +")
    if not form[-1].isalpha():
        return escaped
    # "km." at the end of a sentence keeps its point: it may be both.
    return rf"{escaped}(?!\w)\.?(?![\w])" if form.isalpha() else rf"{escaped}(?!\w)"
