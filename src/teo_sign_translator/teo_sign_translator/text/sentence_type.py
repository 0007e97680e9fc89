# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What kind of sentence it is, and whether it is negated; the robot shows both with its head."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum

from teo_sign_translator.text.cleaning import shortened
from teo_sign_translator.text.reading import Clause, Word
from teo_sign_translator.text.rules import SentenceWords, TextRules


class SentenceType(IntEnum):
    """Values are those of `teo_sign_msgs/SignSentence`."""

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
