# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers that a sign takes up: two weeks are one sign, made with the hand of the number.

Signers of LSE take numbers up to five into units of time and into pronouns (GramLSE, CNLSE, Morphology
3.1.1.3: THREE-MONTH; the corpus LSE-Health-UVigo: SEMANA(TRES), MES(DOS); the dual of pronouns: SignHub,
LSE, Lexicon 3.7.2.2). It is done where the table has the sign; else noun and number stay two signs.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace

from teo_sign_translator.output.output_words import OutputWord
from teo_sign_translator.output.translation import Kind

_NUMBERS = {"2": "DOS", "3": "TRES", "4": "CUATRO", "5": "CINCO"}
_UNITS = {"SEMANA": "SEMANAS", "MES": "MESES"}
# The forms are those of the masculine: LSE's pronouns have no gender.
_PRONOUNS = {
    "NOSOTROS": "NOSOTROS",
    "NOSOTRAS": "NOSOTROS",
    "VOSOTROS": "VOSOTROS",
    "VOSOTRAS": "VOSOTROS",
    "ELLOS": "ELLOS",
    "ELLAS": "ELLOS",
}


def with_numbers_incorporated(output_words: Sequence[OutputWord], signs: Set[str] | None) -> list[OutputWord]:
    """Output words, a unit of time or a pronoun and the number beside it as one where that has a sign.

    Args:
        output_words: Of one sentence.
        signs: Glosses that have a sign; None if that is not known: then nothing is put together.
    """
    result: list[OutputWord] = []
    for word in output_words:
        gloss = _together(result[-1], word) if result else ""
        if signs is not None and gloss and gloss in signs:
            before = result.pop()
            noun = before if before.kind is Kind.LEXICAL else word
            confidence = min(before.confidence, word.confidence)
            said = (*before.words, *(each for each in word.words if each not in before.words))
            result.append(replace(noun, signs=(gloss,), confidence=confidence, words=said))
        else:
            result.append(word)
    return result


def _together(first: OutputWord, second: OutputWord) -> str:
    """The gloss that says both; empty if they are no noun and number that go together."""
    for noun, number in ((first, second), (second, first)):
        if (
            noun.kind is Kind.LEXICAL
            and number.kind is Kind.NUMBER
            and len(noun.signs) == len(number.signs) == 1
        ):
            count = _NUMBERS.get(number.signs[0], "")
            unit, pronoun = _UNITS.get(noun.signs[0], ""), _PRONOUNS.get(noun.signs[0], "")
            if count and unit:
                return f"{count}_{unit}"
            if count and pronoun:
                return f"{pronoun}_{count}"
    return ""
