# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sentences whose translation is given, word for word: what that leaves out is no loss."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_sign_translator.data_files import read_rows
from teo_sign_translator.morphology import gloss_name
from teo_sign_translator.text.cleaning import clean
from teo_sign_translator.text.reading import Clause, read
from teo_sign_translator.text.rules import TextRules
from teo_sign_translator.text.sentence_type import SentenceType, sentence_type

# A language's file of them: sentence, and glosses separated by "/".
_FILE = "paper_pairs.tsv"


@dataclass(frozen=True, slots=True)
class GivenSentence:
    """A sentence's given translation.

    Attributes:
        glosses: In signing order.
        type: Of the sentence, by its own marks.
    """

    glosses: tuple[str, ...]
    type: SentenceType


class GivenSentences:
    """Finds given sentences, however they are typed: capitals, accents and marks do not count."""

    def __init__(self, by_words: Mapping[tuple[str, ...], GivenSentence]) -> None:
        """Take them by the `key` of their words."""
        self._by_words = dict(by_words)

    @classmethod
    def load(cls, folder: Path) -> GivenSentences:
        """Those of a language; none if its text folder has no file of them.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = folder / _FILE
        if not path.is_file():
            return cls({})
        rules = TextRules.load(folder)
        found: dict[tuple[str, ...], GivenSentence] = {}
        for _, (sentence, glosses) in read_rows(path, columns=2):
            clauses = read(clean(sentence).text, rules).clauses
            said = tuple(gloss_name(gloss.strip()) for gloss in glosses.split("/"))
            found[_key(clauses)] = GivenSentence(said, sentence_type(clauses, rules))
        return cls(found)

    def find(self, clauses: Sequence[Clause]) -> GivenSentence | None:
        """The given sentence that clauses are together; None if they are none."""
        return self._by_words.get(_key(clauses))


def _key(clauses: Sequence[Clause]) -> tuple[str, ...]:
    return tuple(word.key for clause in clauses for word in clause.words)
