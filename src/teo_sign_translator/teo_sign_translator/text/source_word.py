# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A word of a sentence, and what it may be."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from teo_sign_translator.morphology import Reading

#: How the tag of an object pronoun begins, before its person and number.
OBJECT = "PRON:obj:"
#: How those of the pronouns begin that lean on a verb.
CLITICS = (OBJECT, "PRON:refl")
#: How those begin of persons behind a preposition, or in one word with it.
COMPANIONS = ("PRON:with", "PRON:prep")
#: How those begin of verbs whose form says who does it, and of these with orders.
TELLING = ("V:ind", "V:sub", "V:cond")
FINITE = (*TELLING, "V:imp")
#: Of a verb that says by its form alone that it is neither the signer nor the addressee who does it.
THIRD_ALONE = re.compile(r"V:ind:(?!impf).*:3s")
#: What may stand between the beginning of a clause and its verb: what denies, and pronouns.
BEFORE_VERBS = ("ADV:neg", *CLITICS)
#: How those begin of what names somebody or something.
NOUNS = ("N:", "NAME")
#: What a clause ends before or opens with.
OPENING = ("MARK", "CONJ", "PRON:rel", "WH")


@dataclass(frozen=True, slots=True)
class SourceWord:
    """A word or mark of a sentence.

    Attributes:
        text: As typed. Words that one short form stands for have the same text (`EE. UU.`, `xfa`).
        form: What it says, in lower case with the accents that were typed: a short form or symbol in full
            (`sr.` is `señor`), a number in digits, also one of several words (`31`, `3,5`, `15:30`) or a
            Roman one (`21`), a word typed as it is drawn out or sounds as it is written (`holaaaa` is `hola`,
            `kasa` is `casa`). A mark is one of `,` (any mark that is a short pause), `.`, `?`, `!`; opening
            marks are left out.
        capital: Whether it was typed with a capital that neither the beginning of a sentence, a mark before
            it nor capitals all over explain.
        readings: What it may be, most likely first; one to four. A mark's only one has the tag MARK.
    """

    text: str
    form: str
    capital: bool
    readings: tuple[Reading, ...]

    @property
    def tag(self) -> str:
        """Of its likeliest reading."""
        return self.readings[0].tag

    @property
    def person(self) -> str:
        """Person and number that a verb's likeliest reading says, e.g. "3s"; what it ends with, of others."""
        return self.tag.rsplit(":", 1)[-1]

    @property
    def is_mark(self) -> bool:
        """Whether it is punctuation."""
        return self.tag == "MARK"


def between_marks(words: Sequence[SourceWord], place: int) -> tuple[int, int]:
    """Where the words between two marks begin and end."""
    start = max((index + 1 for index in range(place) if words[index].is_mark), default=0)
    stop = next((index for index in range(place, len(words)) if words[index].is_mark), len(words))
    return start, stop


def clause_end(words: Sequence[SourceWord], place: int, tags: tuple[str, ...] = OPENING) -> int:
    """Where what stands at a place ends: before the next word of some kinds."""
    return next((at for at in range(place, len(words)) if words[at].tag.startswith(tags)), len(words))


def opens_clause(words: Sequence[SourceWord], verb: int) -> bool:
    """Whether a verb is the first word behind a mark, but for what denies and its pronouns."""
    before = (word for word in reversed(words[:verb]) if not word.tag.startswith(BEFORE_VERBS))
    return next((word.is_mark for word in before), True)
