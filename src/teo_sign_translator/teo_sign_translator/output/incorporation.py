# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers that a sign takes up: two weeks are one sign, made with the hand of the number.

It is done where the table has the sign; else noun and number stay two signs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import replace
from pathlib import Path

from teo_sign_translator.data_files import invalid_line, read_rows
from teo_sign_translator.output.output_words import OutputWord
from teo_sign_translator.output.substitutes import SIGN_NAME
from teo_sign_translator.output.translation import Kind

#: Where a language's text folder says which; the file explains its columns.
INCORPORATED_NUMBERS = "incorporated_numbers.tsv"

#: The gloss that is both, by the gloss and the number.
Incorporated = Mapping[tuple[str, str], str]


def read_incorporated(path: Path) -> Incorporated:
    """Which glosses take up which numbers.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    found: dict[tuple[str, str], str] = {}
    for line, (gloss, number, both) in read_rows(path, columns=3):
        valid = SIGN_NAME.fullmatch(gloss) and number.isdecimal() and SIGN_NAME.fullmatch(both)
        if not valid or (gloss, number) in found:
            got = f"'{gloss}', '{number}', '{both}'"
            raise invalid_line(path, line, "a gloss, a number and the gloss of both, once", got)
        found[gloss, number] = both
    return found


def with_numbers_incorporated(
    output_words: Sequence[OutputWord], signs: Set[str] | None, incorporated: Incorporated
) -> list[OutputWord]:
    """Output words, a gloss and the number beside it as one where that has a sign.

    Args:
        output_words: Of one sentence.
        signs: Glosses that have a sign; None if that is not known: then nothing is put together.
        incorporated: The glosses that are both.
    """
    result: list[OutputWord] = []
    for word in output_words:
        gloss = _together(result[-1], word, incorporated) if result else ""
        if signs is not None and gloss and gloss in signs:
            before = result.pop()
            noun = before if before.kind is Kind.LEXICAL else word
            confidence = min(before.confidence, word.confidence)
            said = (*before.words, *(each for each in word.words if each not in before.words))
            result.append(replace(noun, signs=(gloss,), confidence=confidence, words=said))
        else:
            result.append(word)
    return result


def _together(first: OutputWord, second: OutputWord, incorporated: Incorporated) -> str:
    """The gloss that says both; empty if they are no noun and number that go together."""
    for noun, number in ((first, second), (second, first)):
        if (
            noun.kind is Kind.LEXICAL
            and number.kind is Kind.NUMBER
            and len(noun.signs) == len(number.signs) == 1
        ):
            both = incorporated.get((noun.signs[0], number.signs[0]), "")
            if both:
                return both
    return ""
