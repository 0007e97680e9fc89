# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which glosses have signs, how much of a text these show, and which missing ones would help most."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Set
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import groupby
from pathlib import Path

from teo_sign_translator.data_files import invalid_line, read_lines
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.sign_choice import SIGN_NAME
from teo_sign_translator.output.translation import Kind, Origin, Sentence, Token, Translation

#: How well founded a sign may be, the best first, as the entries of a table name it.
STANDINGS = ("reviewed", "recorded", "measured", "described", "sketched")
#: The executor's default: what is only sketched is spelled.
LEAST_STANDING = "described"


def read_signs(path: Path, least_standing: str = LEAST_STANDING) -> frozenset[str]:
    """The glosses that have signs.

    Args:
        path: A file with one gloss on each line, or a folder of a table's entries (`HOLA.json`).
        least_standing: Of a folder's entries, which count: those at least as well founded.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    if path.is_dir():
        return _entries(path, least_standing)
    signs: set[str] = set()
    for line_number, line in read_lines(path):
        gloss = line.strip().upper()
        if not SIGN_NAME.fullmatch(gloss):
            raise invalid_line(path, line_number, "one gloss", f"'{line.strip()}'")
        signs.add(gloss)
    return frozenset(signs)


def _entries(folder: Path, least_standing: str) -> frozenset[str]:
    """The glosses of a table's lexical entries; letters and numbers are no glosses."""
    if least_standing not in STANDINGS:
        raise TranslationError(
            "invalid_data", f"expected a standing of {', '.join(STANDINGS)}, got {least_standing!r}"
        )
    founded = STANDINGS[: STANDINGS.index(least_standing) + 1]
    signs: set[str] = set()
    files = sorted(folder.glob("*.json"))
    if not files:
        raise TranslationError("invalid_data", f"{folder}: expected entries of a table (*.json), got none")
    for file in files:
        try:
            entry = json.loads(file.read_text(encoding="utf-8"))
            gloss, kind, standing = entry["gloss"], entry["kind"], entry["provenance"]["standing"]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise TranslationError(
                "invalid_data",
                f"{file}: expected an entry of a table with gloss, kind and provenance.standing: {error!r}",
            ) from error
        if kind == "lexical" and standing in founded:
            signs.add(gloss)
    return frozenset(signs)


# A gloss is shown by another sign than its own.
_SUBSTITUTES = (Origin.LEMMA, Origin.SYNONYM, Origin.PARAPHRASE)


class Showing(StrEnum):
    """What shows an output word."""

    SIGN = "sign"
    NUMBER = "number"
    SUBSTITUTE = "substitute"
    GUESS = "guess"
    NAME = "name"
    LETTERS = "letters"


@dataclass(frozen=True, slots=True)
class ShownWord:
    """One output word of a sentence and what shows it.

    Attributes:
        gloss: What the translation means: the gloss that was looked for; the letters of a name.
        signs: What is signed, in order: one gloss, the signs of a paraphrase, letters, a number.
        showing: How the signs stand for the gloss.
        source_words: Words of the text that it stands for, as typed.
    """

    gloss: str
    signs: tuple[str, ...]
    showing: Showing
    source_words: tuple[str, ...]


def shown_words(sentence: Sentence, guesses: Set[str] = frozenset()) -> list[ShownWord]:
    """What shows each output word of a sentence, pauses apart.

    Args:
        sentence: Translated with the signs of a table.
        guesses: Glosses of that table whose form has no source: as many as these were signed if guesses were
            allowed, and are spelled if not.
    """
    tokens = (token for token in sentence.tokens if token.kind is not Kind.PAUSE)
    return [_shown(tuple(run), guesses) for _, run in groupby(tokens, key=_word)]


def _word(token: Token) -> str | int:
    """What the tokens of one word share: the gloss that they show together, else the word's number."""
    return token.meant or token.word_index


def _shown(tokens: tuple[Token, ...], guesses: Set[str]) -> ShownWord:
    first = tokens[0]
    signs = tuple(token.gloss for token in tokens)
    gloss = first.meant or "".join(signs)
    if first.kind is Kind.NUMBER:
        showing = Showing.NUMBER
    elif any(token.kind is Kind.LETTER for token in tokens):
        showing = Showing.NAME if not first.meant else Showing.GUESS if gloss in guesses else Showing.LETTERS
    else:
        showing = Showing.SUBSTITUTE if first.origin in _SUBSTITUTES else Showing.SIGN
    return ShownWord(gloss, signs, showing, first.source_words)


@dataclass
class Coverage:
    """Counts over texts.

    Attributes:
        showings: How many output words are shown how.
        sentences: How many sentences there were.
        whole: How many of them need no letters but for names.
        missing: Glosses that are spelled for want of a sign, by how often they were wanted.
        guessed: Those of them that have a sign without a source.
        examples: For each of them the first sentence that wants it.
        dropped: Words of the texts that nothing was signed for, by how often.
    """

    showings: Counter[Showing] = field(default_factory=Counter)
    sentences: int = 0
    whole: int = 0
    missing: Counter[str] = field(default_factory=Counter)
    guessed: Counter[str] = field(default_factory=Counter)
    examples: dict[str, str] = field(default_factory=dict)
    dropped: Counter[str] = field(default_factory=Counter)

    def add(self, translation: Translation, guesses: Set[str] = frozenset()) -> None:
        """Count a text that was translated with the signs of a table; `guesses` as in `shown_words`."""
        for sentence in translation.sentences:
            words = shown_words(sentence, guesses)
            self.sentences += 1
            self.whole += not any(word.showing in (Showing.LETTERS, Showing.GUESS) for word in words)
            self.showings.update(word.showing for word in words)
            self.dropped.update(sentence.dropped)
            for word in words:
                if word.showing is Showing.LETTERS:
                    self.missing[word.gloss] += 1
                elif word.showing is Showing.GUESS:
                    self.guessed[word.gloss] += 1
                if word.showing in (Showing.LETTERS, Showing.GUESS):
                    self.examples.setdefault(word.gloss, sentence.text)

    @property
    def words(self) -> int:
        """Output words, pauses apart."""
        return self.showings.total()

    @property
    def signed(self) -> int:
        """Output words that a sign shows: its own, a number's, or another's that means the same."""
        return sum(self.showings[showing] for showing in (Showing.SIGN, Showing.NUMBER, Showing.SUBSTITUTE))


def most_wanted(coverage: Coverage, count: int) -> Iterable[tuple[str, int]]:
    """Glosses whose sign would help most: spelled or only guessed now, the most frequent first."""
    return (coverage.missing + coverage.guessed).most_common(count)
