# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the head says in a language: questions, negation, affirmation, and the signs that tell them."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from teo_common.text_folding import without_accents

HeadMove = Literal["forward", "back", "nod", "shake"]
Gloss = Annotated[str, msgspec.Meta(min_length=1)]


class HeadGrammar(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Which way the head moves over which signs of a sentence; not at all where nothing is said.

    Attributes:
        yes_no_question: Over a whole yes/no question.
        wh_question: Over the question words of a question; over all of it where it has none.
        exclamation: At the last sign of an exclamation that is not negated.
        negation: Over each negative sign and its neighbour; over the whole sentence where it has none.
        negated_neighbour: The sign that a negative sign negates: the one before it or the one after.
        question_words: Glosses that ask, as signs or, without accents, spelled; also as a part of a gloss
            (POR_QUÉ asks as QUÉ does).
        negative_signs: Glosses without accents that negate; also as a part of a gloss (NO_HAY).
        not_negative: Glosses without accents that hold a negative one and do not negate.
    """

    yes_no_question: HeadMove | None = None
    wh_question: HeadMove | None = None
    exclamation: HeadMove | None = None
    negation: HeadMove | None = None
    negated_neighbour: Literal["before", "after"] = "before"
    question_words: list[Gloss] = []
    negative_signs: list[Gloss] = []
    not_negative: list[Gloss] = []

    def asks(self, gloss: str, *, spelled: bool) -> bool:
        """Whether a gloss is a question word; CUÁNDO is one, CUANDO is none, and letters have no accents."""
        asking = [without_accents(word) for word in self.question_words] if spelled else self.question_words
        return not set(asking).isdisjoint(gloss.split("_"))

    def negates(self, gloss: str) -> bool:
        """Whether a gloss is a negative sign."""
        plain = without_accents(gloss)
        return plain not in self.not_negative and not set(self.negative_signs).isdisjoint(plain.split("_"))
