# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What kind of sentence it is, which of its words tell so, and the gestures by which the head shows it.

Which way the head moves is the language's (`teo_sign_languages.HeadGrammar`, with its sources in
`language.yaml`):

* negation: over the negative sign and the one that it negates, before or after it; without a negative sign
  over the whole sentence, for a head shake alone can negate;
* yes/no question: over the whole clause. A sentence's clauses are not told apart here: with a greeting before
  the question the head moves at the greeting too;
* question with a question word: on the question word at least;
* affirmation: an exclamation asserts, so that the head moves at its last sign, unless it is negated.

Brows, eyes and mouth, which carry as much, TEO does not have.
"""

from __future__ import annotations

import enum
import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from teo_sign_languages import DEFAULT_LANGUAGE, HeadGrammar, HeadMove, load_language
from teo_signs.errors import PlanError
from teo_signs.tokens import PRINTED_PAUSE, Kind, Token


class SentenceType(enum.IntEnum):
    """The numbers are those of `teo_sign_msgs/SignSentence`."""

    STATEMENT = 0
    YES_NO_QUESTION = 1
    WH_QUESTION = 2
    EXCLAMATION = 3


@dataclass(frozen=True, kw_only=True)
class SentenceForm:
    """A sentence's type, and whether it is negated as a whole."""

    type: SentenceType = SentenceType.STATEMENT
    negated: bool = False


STATEMENT = SentenceForm()

_MARKS = "¿?¡!"


class _Word(NamedTuple):
    """A sign, or the letters and numbers that spell one word."""

    first: int
    """Index of its first token."""
    last: int
    """Index of its last token."""
    text: str
    """Its gloss, or what is spelled; empty for a pause between words."""
    spelled: bool
    """Whether it is made of letters and numbers."""
    asks: bool
    """Whether it is a question word."""
    negates: bool
    """Whether it is a negative sign."""


@functools.cache
def _default_grammar() -> HeadGrammar:
    """What the head says in the default language."""
    return load_language(DEFAULT_LANGUAGE).head


def _words_of(tokens: Sequence[Token], grammar: HeadGrammar) -> tuple[_Word, ...]:
    """Group tokens by words: letters, numbers and the pauses among them by their word index."""
    words: list[tuple[int, int, str, bool]] = []
    for index, token in enumerate(tokens):
        joins = token.spelled or (
            token.kind == Kind.PAUSE and 0 < index < len(tokens) - 1 and tokens[index + 1].spelled
        )
        text = PRINTED_PAUSE if joins and not token.spelled else token.gloss
        first, _, before, spelled = words[-1] if words else (0, 0, "", False)
        if joins and spelled and tokens[index - 1].word_index == token.word_index:
            words[-1] = (first, index, before + text, True)
        else:
            gloss = "" if token.kind == Kind.PAUSE else token.gloss
            words.append((index, index, gloss, token.spelled))
    return tuple(
        _Word(first, last, text, spelled, grammar.asks(text, spelled=spelled), grammar.negates(text))
        for first, last, text, spelled in words
    )


def printed_form(text: str, tokens: Sequence[Token], grammar: HeadGrammar | None = None) -> SentenceForm:
    """The form of a sentence in the printed form: its marks and signs tell, as far as they can.

    Args:
        text: The printed form.
        tokens: Its tokens.
        grammar: Of the sentence's language; None for the default one.
    """
    words = _words_of(tokens, grammar or _default_grammar())
    sentence_type = SentenceType.STATEMENT
    if "?" in text:
        asking = any(word.asks for word in words)
        sentence_type = SentenceType.WH_QUESTION if asking else SentenceType.YES_NO_QUESTION
    elif "!" in text:
        sentence_type = SentenceType.EXCLAMATION
    return SentenceForm(type=sentence_type, negated=any(word.negates for word in words))


def without_marks(text: str) -> str:
    """The printed form without question and exclamation marks."""
    return text.translate({ord(mark): None for mark in _MARKS})


def check_form(form: SentenceForm) -> None:
    """Refuse a type that is none.

    Raises:
        PlanError: "bad_type".
    """
    if form.type not in tuple(SentenceType):
        names = ", ".join(f"{item.value} {item.name.lower()}" for item in SentenceType)
        raise PlanError("bad_type", f"expected a type of sentence of {names}, got {form.type}")


class GestureKind(enum.Enum):
    """What the head does."""

    SHAKE = "shake"
    FORWARD = "forward"
    BACK = "back"
    NOD = "nod"


@dataclass(frozen=True, kw_only=True)
class Gesture:
    """A head gesture and the tokens that it spans.

    Attributes:
        kind: What the head does.
        first: Index of the first token.
        last: Index of the last token.
    """

    kind: GestureKind
    first: int
    last: int


def head_gestures(
    tokens: Sequence[Token], form: SentenceForm, grammar: HeadGrammar | None = None
) -> tuple[Gesture, ...]:
    """The gestures of a sentence.

    Args:
        tokens: What is signed, letters for what is spelled.
        form: Type and negation.
        grammar: Of the sentence's language; None for the default one.
    """
    rules = grammar or _default_grammar()
    words = _words_of(tokens, rules)
    signed = [word for word in words if tokens[word.first].kind != Kind.PAUSE]
    if not signed:
        return ()
    whole = (signed[0].first, signed[-1].last)
    moves: list[tuple[HeadMove | None, list[tuple[int, int]]]] = []
    if form.negated:
        moves.append((rules.negation, _negated(words, rules) or [whole]))
    match form.type:
        case SentenceType.YES_NO_QUESTION:
            moves.append((rules.yes_no_question, [whole]))
        case SentenceType.WH_QUESTION:
            asking = [(word.first, word.last) for word in signed if word.asks]
            moves.append((rules.wh_question, asking or [whole]))
        case SentenceType.EXCLAMATION if not form.negated:
            moves.append((rules.exclamation, [(whole[1], whole[1])]))
    return tuple(
        Gesture(kind=GestureKind(move), first=first, last=last)
        for move, spans in moves
        if move is not None
        for first, last in spans
    )


def _negated(words: Sequence[_Word], grammar: HeadGrammar) -> list[tuple[int, int]]:
    """First and last token of each negation: negative signs, with their neighbour unless it is a pause."""
    spans: list[tuple[int, int]] = []
    step = -1 if grammar.negated_neighbour == "before" else 1
    for index, word in enumerate(words):
        if not word.negates:
            continue
        neighbour = words[index + step] if 0 <= index + step < len(words) else word
        both = (word, neighbour) if neighbour.text else (word, word)
        first, last = min(one.first for one in both), max(one.last for one in both)
        if spans and spans[-1][1] + 1 >= first:
            spans[-1] = (spans[-1][0], max(last, spans[-1][1]))
        else:
            spans.append((first, last))
    return spans
