# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sense of a word a sentence has, where the gloss's sign says another one."""

from __future__ import annotations

import re
from collections.abc import Sequence, Set
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from teo_sign_translator.data_files import invalid_line, read_rows
from teo_sign_translator.output.output_words import OutputWord, Spelling, spelled
from teo_sign_translator.output.sign_choice import SIGN_NAME
from teo_sign_translator.output.translation import Kind
from teo_sign_translator.text.reading import Clause

#: Where a language's text folder says them; the file explains its columns.
SENSES = "senses.tsv"


class Sense(NamedTuple):
    """What is signed for a word in some sentences."""

    glosses: tuple[str, ...]
    """Of the translation, beside each other."""
    meant: tuple[str, ...]
    """What says it; empty for nothing."""
    context: re.Pattern[str]
    """Found in the sentences where that is meant: folded, numbers in digits."""


def read_senses(path: Path) -> tuple[Sense, ...]:
    """The senses of a language; none if its text folder has no file of them.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    found: list[Sense] = []
    for number, (listed, meant, context) in read_rows(path, columns=3) if path.is_file() else ():
        glosses = tuple(listed.split())
        instead = () if meant == "-" else tuple(meant.split())
        try:
            pattern = re.compile(context)
        except re.error:
            pattern = None
        if pattern is None or not all(map(SIGN_NAME.fullmatch, (*glosses, *instead))):
            expected = 'glosses, those that are meant or "-", and a regular expression'
            raise invalid_line(path, number, expected, f"'{listed}', '{meant}', '{context}'")
        found.append(Sense(glosses, instead, pattern))
    return tuple(found)


def with_senses(
    output_words: Sequence[OutputWord],
    clauses: Sequence[Clause],
    senses: Sequence[Sense],
    signs: Set[str] | None,
    spelling: Spelling,
) -> list[OutputWord]:
    """Output words, each with the gloss of the sense that its sentence has; spelled if that has no sign.

    Several glosses for which one sign stands stay as they are where the table lacks it.

    Args:
        output_words: Of one sentence.
        clauses: Of it.
        senses: Of the language; the first that fits counts.
        signs: Glosses that have a sign; None if that is not known: then every gloss stays as it is.
        spelling: Of the language.
    """
    if signs is None:
        return list(output_words)
    said = " ".join(word.value or word.fold for clause in clauses for word in clause.words)
    fitting = [sense for sense in senses if sense.context.search(said)]
    result: list[OutputWord] = []
    rest = list(output_words)
    while rest:
        beginning = (sense for sense in fitting if _begin_with(rest, sense.glosses))
        sense = next((each for each in beginning if len(each.glosses) == 1 or signs >= {*each.meant}), None)
        words = [rest.pop(0) for _ in (sense.glosses if sense else rest[:1])]
        if sense is None:
            result += words
        elif sense.meant and signs >= {*sense.meant}:
            typed = tuple(text for word in words for text in word.words)
            sure = min(word.confidence for word in words)
            meant = replace(words[0], words=typed, confidence=sure)
            result += [replace(meant, signs=(gloss,)) for gloss in sense.meant]
        else:
            for word in words:
                letters = spelled(word.signs[0], word.words, word.confidence, spelling)
                result += [replace(each, meant=word.signs[0]) for each in letters]
    return result


def _begin_with(words: Sequence[OutputWord], glosses: Sequence[str]) -> bool:
    return len(words) >= len(glosses) and all(
        word.kind is Kind.LEXICAL and not word.is_name and word.signs == (gloss,)
        for word, gloss in zip(words, glosses, strict=False)
    )
