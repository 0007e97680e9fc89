# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which head gestures a sentence has, and over which of its signs.

The grammar is that of LSE as commonly described (Á. Herrero Blanco, "Gramática didáctica de la lengua de
signos española", 2009; M. Á. Rodríguez González, "Lenguaje de signos", 1992, 2.4.1), and of the related
Catalan sign language, where yes/no questions differ from statements by these marks alone and a head shake
alone can negate (IEC, "Gramàtica de la llengua de signes catalana": interrogació, afirmació):

* negation: the head shakes from side to side over the negated verb and the negative sign. Negation follows
  its verb in LSE, so that these are the negative sign and the word before it; without a negative sign the
  whole sentence is shaken at;
* yes/no question: head forward over the whole clause. A sentence's clauses are not told apart here: with a
  greeting before the question the head is forward at the greeting too;
* question with a question word: head a little back, on the question word at least;
* affirmation: a nod. An exclamation asserts, so that its last sign is nodded at, unless it is negated.

Brows, eyes and mouth, which carry as much, TEO does not have.
"""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

from teo_motion.sentence.sentence_form import SentenceForm, SentenceType, Word, words_of
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


def head_gestures(tokens: Sequence[Token], form: SentenceForm) -> tuple[Gesture, ...]:
    """The gestures of a sentence.

    Args:
        tokens: What is signed, letters for what is spelled.
        form: Type and negation.
    """
    words = words_of(tokens)
    signed = [word for word in words if tokens[word.first].kind != Kind.PAUSE]
    if not signed:
        return ()
    whole = (signed[0].first, signed[-1].last)
    found: list[Gesture] = []
    if form.negated:
        found += [_gesture(GestureKind.SHAKE, *span) for span in _negated(words) or [whole]]
    match form.type:
        case SentenceType.YES_NO_QUESTION:
            found.append(_gesture(GestureKind.FORWARD, *whole))
        case SentenceType.WH_QUESTION:
            asking = [(word.first, word.last) for word in signed if word.asks]
            found += [_gesture(GestureKind.BACK, *span) for span in asking or [whole]]
        case SentenceType.EXCLAMATION if not form.negated:
            found.append(_gesture(GestureKind.NOD, whole[1], whole[1]))
    return tuple(found)


def _gesture(kind: GestureKind, first: int, last: int) -> Gesture:
    return Gesture(kind=kind, first=first, last=last)


def _negated(words: Sequence[Word]) -> list[tuple[int, int]]:
    """First and last token of each negation: negative signs, with the word before unless it is a pause."""
    spans: list[tuple[int, int]] = []
    for index, word in enumerate(words):
        if not word.negates:
            continue
        before = words[index - 1] if index else word
        first = before.first if before.text else word.first
        if spans and spans[-1][1] + 1 >= first:
            spans[-1] = (spans[-1][0], word.last)
        else:
            spans.append((first, word.last))
    return spans
