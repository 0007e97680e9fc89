# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What reading a text needs to know of its language: `reading.yaml` and `expressions.tsv`."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

from teo_common.text_folding import fold
from teo_sign_translator.data_files import data_file
from teo_sign_translator.data_sections import read_sections
from teo_sign_translator.text.expressions import Expressions
from teo_sign_translator.text.numerals import Numerals

_FILE = "reading.yaml"


@dataclass(frozen=True)
class SentenceWords:
    """Words that tell what kind of sentence it is; `sentences` in the file.

    Attributes:
        interrogatives: Question words, as written.
        unmarked_starts: Words that begin a question far more often than a statement, if no mark is typed.
        unmarked_pairs: The same of two words in a row, folded.
        leading: Words that may stand before the question word ("¿Y tú de dónde eres?").
        negatives: Words that negate a sentence.
        not_negative: Pairs whose second word does not negate it ("de nada").
        tags: Words that are no negation where they alone are asked behind a sentence ("…, ¿no?").
    """

    interrogatives: frozenset[str]
    unmarked_starts: frozenset[str]
    unmarked_pairs: frozenset[tuple[str, str]]
    leading: frozenset[str]
    negatives: frozenset[str]
    not_negative: frozenset[tuple[str, str]]
    tags: frozenset[str]

    @cached_property
    def folded_interrogatives(self) -> frozenset[str]:
        """The question words without accents."""
        return frozenset(map(fold, self.interrogatives))


@dataclass(frozen=True)
class SpecialWords:
    """Single words that reading treats in a way of their own; `words` in the file.

    Attributes:
        laughter: Pattern of laughter as it is typed, in any case.
        laugh: The word that laughter stands for.
        minus: The word of a minus sign.
        asked_reason: A word that is two words, those of `reason`, at the beginning of a question; or empty.
        reason: See `asked_reason`.
        introducing: Lemmas behind which a name stands ("me llamo Rosa").
        subject_tags: Ends of the tags of verbs that a name without an article may be the subject of.
    """

    laughter: re.Pattern[str]
    laugh: str
    minus: str
    asked_reason: str
    reason: tuple[str, ...]
    introducing: frozenset[str]
    subject_tags: tuple[str, ...]


@dataclass(frozen=True)
class GlossNames:
    """Glosses that have a part of their own in what is signed; `glosses` in the file.

    Attributes:
        decimal: Between the whole and the decimals of a number ("tres coma cinco").
        name: Behind it stands somebody's name.
        currencies: Beside them a number with decimals is a price.
    """

    decimal: str
    name: str
    currencies: frozenset[str]


@dataclass(frozen=True)
class GeneralityWords:
    """Words that tell whether a sentence stays true with a more general word; `generality` in the file.

    Attributes:
        strict: Words, folded, any of which makes a sentence one that may not stay true.
        of_kinds: Beginnings of folded verbs whose object is a kind, or need not exist.
    """

    strict: frozenset[str]
    of_kinds: tuple[str, ...]


@dataclass(frozen=True)
class TextRules:
    """All of it.

    Attributes:
        expressions: Short forms and symbols.
        numbers: How numbers are said and written.
        sentences: Words that tell kinds of sentence.
        words: Words that are read in a way of their own.
        glosses: Names of glosses.
        generality: Words that tell whether a word may give way to a more general one.
    """

    expressions: Expressions
    numbers: Numerals
    sentences: SentenceWords
    words: SpecialWords
    glosses: GlossNames
    generality: GeneralityWords

    @classmethod
    @cache
    def load(cls, folder: Path | None = None) -> TextRules:
        """Read the files of a language's text folder, once.

        Args:
            folder: By default that of the default language.

        Raises:
            TranslationError: "invalid_data" naming file and field.
        """
        folder = folder or data_file("")
        sections = {
            "numbers": Numerals,
            "sentences": SentenceWords,
            "words": SpecialWords,
            "glosses": GlossNames,
            "generality": GeneralityWords,
        }
        read = read_sections(folder / _FILE, sections)
        return cls(Expressions.load(folder / "expressions.tsv"), **read)
