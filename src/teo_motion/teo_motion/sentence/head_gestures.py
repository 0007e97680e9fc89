# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which head gestures a sentence has, and over which of its signs.

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
from collections.abc import Sequence
from dataclasses import dataclass

from teo_motion.sentence.sentence_form import SentenceForm, SentenceType, Word, default_grammar, words_of
from teo_sign_languages import HeadGrammar, HeadMove
from teo_signs.tokens import Kind, Token


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
    rules = grammar or default_grammar()
    words = words_of(tokens, rules)
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


def _negated(words: Sequence[Word], grammar: HeadGrammar) -> list[tuple[int, int]]:
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
