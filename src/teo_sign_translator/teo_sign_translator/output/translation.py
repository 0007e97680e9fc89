# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A translation: its sentences, their tokens with their kinds and origins, and lines that explain it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import groupby
from typing import Any

from teo_sign_languages import DEFAULT_LANGUAGE
from teo_sign_translator.text.reading import SentenceType


class Kind(IntEnum):
    """Kinds of token; values are those of `teo_sign_msgs/SignToken`."""

    LEXICAL = 0
    LETTER = 1
    NUMBER = 2
    PAUSE = 3


class Origin(IntEnum):
    """How a token came about; values are those of `teo_sign_msgs/SignToken`."""

    MODEL = 1
    LEMMA = 2
    SYNONYM = 3
    SPELLED = 4
    NUMBER = 5
    REPAIRED = 6
    WORD_LIST = 7
    PAUSE = 8
    PARAPHRASE = 9


@dataclass(frozen=True, slots=True, kw_only=True)
class Token:
    """One sign to be made.

    Attributes:
        gloss: Upper-case Spanish with accents, `_` for spaces; a letter; digits; empty for a pause.
        kind: Sign of its own, letter, number or pause.
        confidence: How sure the translator is, 0 (guess) to 1 (certain).
        duration_scale: Times the sign's recorded duration.
        word_index: Counts the words of the sentence's output from 0; letters of a spelled word and
            digits of a number of more than six share it.
        source_words: Words of the text, as typed, that the token stands for.
        origin: How it came about.
        inflection: Form of the sign: "2>1" from the addressee to the signer; empty for the citation form.
        meant: The gloss that it shows together with its neighbours of the same, if that is not its own: of a
            substitute, or of a spelled word that is no name; else empty.
    """

    gloss: str
    kind: Kind
    confidence: float
    word_index: int
    source_words: tuple[str, ...]
    origin: Origin
    duration_scale: float = 1.0
    inflection: str = ""
    meant: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sentence:
    """One sentence as tokens, in the order in which they are signed.

    Attributes:
        text: The sentence as typed.
        type: Statement, question or exclamation.
        negated: Whether it holds a negation.
        tokens: At least one.
        uncertain: Whether the confidence of a token is below the threshold of the translator.
        confidence: How likely it is right as a whole, 0 to 1; that of the least certain token if that is not
            known.
        dropped: Words of the text, as typed, that no token stands for: articles, prepositions and the like.
    """

    text: str
    type: SentenceType
    negated: bool
    tokens: tuple[Token, ...]
    uncertain: bool
    confidence: float
    dropped: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Translation:
    """A text as sentences.

    Attributes:
        text: As it was given.
        sentences: At least one, in the order of the text.
        ignored: Characters of the text that nothing is signed for, in order, e.g. emoji; punctuation is not
            among them.
        model: Name of the model used.
        language: Code of the sign language of the tokens.
    """

    text: str
    sentences: tuple[Sentence, ...]
    ignored: tuple[str, ...]
    model: str
    language: str = DEFAULT_LANGUAGE

    def __str__(self) -> str:
        """The glosses of all sentences on one line, a spelled word as `A-N-A`."""
        return " ".join(printed(sentence.tokens) for sentence in self.sentences)

    def as_dict(self) -> dict[str, Any]:
        """Everything, as plain values for JSON."""
        return {
            "text": self.text,
            "glosses": str(self),
            "language": self.language,
            "model": self.model,
            "ignored": list(self.ignored),
            "sentences": [
                {
                    "text": sentence.text,
                    "type": sentence.type.name.lower(),
                    "negated": sentence.negated,
                    "confidence": round(sentence.confidence, 4),
                    "uncertain": sentence.uncertain,
                    "dropped": list(sentence.dropped),
                    "tokens": [
                        {
                            "gloss": token.gloss,
                            "kind": token.kind.name.lower(),
                            "confidence": round(token.confidence, 4),
                            "duration_scale": token.duration_scale,
                            "word_index": token.word_index,
                            "source_words": list(token.source_words),
                            "origin": token.origin.name.lower(),
                            "inflection": token.inflection,
                            "meant": token.meant,
                        }
                        for token in sentence.tokens
                    ],
                }
                for sentence in self.sentences
            ],
        }


def printed(tokens: Iterable[Token]) -> str:
    """Tokens on one line: glosses separated by spaces, a spelled word as `A-N-A`, a number as `12`."""
    words: list[str] = []
    for (_, kind), group in groupby(tokens, key=lambda token: (token.word_index, token.kind)):
        if kind is not Kind.PAUSE:
            words.append(("-" if kind is Kind.LETTER else "").join(token.gloss for token in group))
    return " ".join(words)


_REASONS = {
    Origin.MODEL: "the model says it",
    Origin.LEMMA: "the sign of the dictionary form",
    Origin.SYNONYM: "a sign that means the same",
    Origin.SPELLED: "in letters",
    Origin.NUMBER: "a number",
    Origin.REPAIRED: "the model left it out; its place is a guess",
    Origin.WORD_LIST: "the word alone, from a list",
    Origin.PARAPHRASE: "one of the signs that say it together",
}


def explained(translation: Translation) -> Iterator[str]:
    """Lines about each sentence: its tokens with their words, then the words that have none."""
    for sentence in translation.sentences:
        yield sentence.text
        yield from _aligned([_row(group) for group in _words(sentence)])
        if sentence.dropped:
            yield f"  nothing is signed for: {', '.join(sentence.dropped)}"
    if translation.ignored:
        yield f"ignored: {' '.join(translation.ignored)}"


def _words(sentence: Sentence) -> list[list[Token]]:
    """A sentence's tokens without pauses, letters of one word together."""
    signed = (token for token in sentence.tokens if token.kind is not Kind.PAUSE)
    return [list(group) for _, group in groupby(signed, key=lambda token: (token.word_index, token.kind))]


def _row(tokens: Sequence[Token]) -> tuple[str, str, str]:
    """What is signed, for which words, and why."""
    first = tokens[0]
    reason = _REASONS[first.origin]
    if first.meant:
        reason += f", for {first.meant}"
    if first.inflection:
        reason += f", form {first.inflection}"
    if first.origin is Origin.MODEL:
        reason += f" ({min(token.confidence for token in tokens):.0%})"
    return printed(tokens), " ".join(first.source_words) or "-", reason


def _aligned(rows: Sequence[tuple[str, str, str]]) -> list[str]:
    """Rows as lines, their columns below each other."""
    widths = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    return [f"  {gloss:<{widths[0]}}  {words:<{widths[1]}}  {reason}" for gloss, words, reason in rows]
