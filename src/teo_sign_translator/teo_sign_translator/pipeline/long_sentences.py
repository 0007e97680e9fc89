# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Dividing a sentence that is too much for the model."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

from teo_sign_translator.text.source_words import SourceWord

#: Words of a sentence that are translated together; a longer one is divided. The model has seen no longer
#: ones, and its time grows with their number.
MOST_WORDS = 40

# Tags of verbs that make a clause; "y" joins nouns too.
_FINITE = ("V:ind", "V:cond", "V:sub", "V:imp")


class Piece(NamedTuple):
    """Part of a sentence.

    Attributes:
        start: Place of its first word.
        stop: Place behind its last word or mark.
        joint: Place of the conjunction before it; None if there is none.
    """

    start: int
    stop: int
    joint: int | None = None


def parts(words: Sequence[SourceWord]) -> list[Sequence[SourceWord]]:
    """A sentence as it is; one that is too long divided, at marks where it has any. None is marks alone."""
    result: list[Sequence[SourceWord]] = []
    rest = words
    while len(rest) > MOST_WORDS:
        marks = [place for place in range(1, MOST_WORDS) if rest[place].is_mark]
        size = marks[-1] + 1 if marks else MOST_WORDS
        result.append(rest[:size])
        rest = rest[size:]
    result.append(rest)
    return [part for part in result if not all(word.is_mark for word in part)]


def pieces(words: Sequence[SourceWord], joints: Collection[str]) -> list[Piece]:
    """The clauses of a sentence: what stands between marks, or between conjunctions that join verbs.

    Args:
        words: Of the sentence.
        joints: The language's conjunctions that may join clauses.
    """
    result: list[Piece] = []
    start, joint = 0, None
    for place, word in enumerate(words):
        ends = word.is_mark
        joins = word.form in joints and _has_verb(words[start:place]) and _has_verb(words[place + 1 :])
        if ends or joins:
            stop = place + ends
            if not all(each.is_mark for each in words[start:stop]):
                result.append(Piece(start, stop, joint))
                joint = None
            elif result:
                result[-1] = result[-1]._replace(stop=stop)
            start, joint = place + 1, place if joins else joint
    if start < len(words):
        result.append(Piece(start, len(words), joint))
    return result


def _has_verb(words: Sequence[SourceWord]) -> bool:
    """Whether the words up to the next mark hold a verb that makes a clause."""
    for word in words:
        if word.is_mark:
            return False
        if word.readings[0].tag.startswith(_FINITE):
            return True
    return False
