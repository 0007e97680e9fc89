# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What kind of sentence it is, and whether it is negated; the robot shows both with its head."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum

from teo_common.text_folding import fold
from teo_sign_translator.data_files import words_of
from teo_sign_translator.text.cleaning import shortened
from teo_sign_translator.text.reading import Clause, Word


class SentenceType(IntEnum):
    """Values are those of `teo_sign_msgs/SignSentence`."""

    STATEMENT = 0
    YES_NO_QUESTION = 1
    WH_QUESTION = 2
    EXCLAMATION = 3


_INTERROGATIVES = frozenset(
    words_of("qué quién quiénes cuál cuáles cómo cuándo cuánto cuánta cuántos cuántas dónde adónde")
)
_FOLDED_INTERROGATIVES = frozenset(map(fold, _INTERROGATIVES))
# Typed without accents and marks these begin a question far more often than a statement; "que", "como" and
# "cuando" only together with the word behind them.
_UNMARKED_STARTS = frozenset(words_of("quien quienes cual cuales cuanto cuanta cuantos cuantas donde adonde"))
_UNMARKED_PAIRS = frozenset(
    {("que", second) for second in words_of("tal hora dia haces quieres pasa prefieres significa")}
    | {("como", second) for second in words_of("te se estas esta estan estais es vas")}
    | {("cuando", second) for second in words_of("vienes vas llegas sales es empieza")}
)
# Words that may stand before the question word: "¿Y tú de dónde eres?"
_LEADING = frozenset(
    words_of(
        "a con de desde en entre hacia hasta para por según sobre y e pero entonces pues "
        "tú tu usted ustedes vosotros hola oye bueno"
    )
)
_NEGATIVES = frozenset(
    words_of("no nunca jamás jamas tampoco nadie nada ningún ningun ninguno ninguna ningunos ningunas ni")
)


def sentence_type(clauses: Sequence[Clause]) -> SentenceType:
    """The type of a sentence from its marks and, where they were not typed, from its question words."""
    asking = [clause for clause in clauses if clause.end == "?" or clause.opening == "¿"]
    if asking:
        wh = any(_asks_with_word(clause.words) for clause in asking)
        return SentenceType.WH_QUESTION if wh else SentenceType.YES_NO_QUESTION
    if any(clause.end == "!" or clause.opening == "¡" for clause in clauses):
        return SentenceType.EXCLAMATION
    if clauses and _starts_unmarked_question(clauses[-1].words):
        return SentenceType.WH_QUESTION
    return SentenceType.STATEMENT


def is_negated(clauses: Sequence[Clause]) -> bool:
    """Whether a sentence holds a negative word, other than the tag "…, ¿no?" and the reply "de nada"."""
    for index, clause in enumerate(clauses):
        words = [shortened(word.lower) for word in clause.words]
        if index and words == ["no"] and clause.end == "?":
            continue
        for place, word in enumerate(words):
            if word in _NEGATIVES and not (word == "nada" and words[max(0, place - 1)] == "de"):
                return True
    return False


def _asks_with_word(words: Sequence[Word]) -> bool:
    """Whether a question has its question word first (behind leading words), or last: "¿Haces qué?"."""
    lower = [word.lower for word in words]
    if lower and lower[-1] in _INTERROGATIVES:
        return True
    for word in words:
        if word.fold in _FOLDED_INTERROGATIVES:
            return True
        if word.lower not in _LEADING:
            return False
    return False


def _starts_unmarked_question(words: Sequence[Word]) -> bool:
    first = next((i for i, word in enumerate(words) if word.lower not in _LEADING), None)
    if first is None:
        return False
    if words[first].lower in _INTERROGATIVES or words[first].lower in _UNMARKED_STARTS:
        return True
    return len(words) > first + 1 and (words[first].lower, words[first + 1].lower) in _UNMARKED_PAIRS
