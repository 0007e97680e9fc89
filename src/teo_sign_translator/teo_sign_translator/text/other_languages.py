# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recognises a text of another language, and keyboard noise: spelled, either is half a minute of letters."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from teo_common.text_folding import fold
from teo_sign_translator.data_files import read_listed
from teo_sign_translator.morphology import Morphology
from teo_sign_translator.text.reading import Clause, Word, WordKind

_FILE = "other_languages.tsv"
#: What noise is called where a language has a name.
NOISE = "keyboard noise"
#: Share of the words that must be unknown. A text of another language shares some of its words with this one;
#: of 975 sentences of the evaluation one reaches half ("tienes whatsapp?"), the next 0.38.
_UNKNOWN = 0.5
#: With several words that tell the language, a smaller share is enough: "M'agrada molt la platja amb tu".
_UNKNOWN_TOLD = 0.4
_TOLD = 2
# Five consonants in a row, or four letters without a vowel: no word of a European language that has such
# letters is spelled without a capital (Schwartz has four).
_NOISE = re.compile(r"[a-zñç]*[bcdfghjklmnñpqrstvwxz]{5,}[a-zñç]*|[bcdfghjklmnñpqrstvwxz]{4,}")


class OtherLanguage(NamedTuple):
    """What a text looks like.

    Attributes:
        name: Of the language, in English, or `NOISE`.
        unknown: Words of it that this language does not have, in order.
        words: How many it has, names and numbers not counted.
    """

    name: str
    unknown: tuple[str, ...]
    words: int


class OtherLanguages:
    """Knows words of this language, and some that tell others.

    Attributes:
        spoken: This language's name, in English.
    """

    def __init__(self, telling: Mapping[str, frozenset[str]], spoken: str, morphology: Morphology) -> None:
        """Take each language's telling words, and the name and words of this one."""
        self.spoken = spoken
        self._telling = {name: frozenset(map(fold, words)) for name, words in telling.items()}
        self._morphology = morphology

    @classmethod
    def load(cls, folder: Path, spoken: str, morphology: Morphology) -> OtherLanguages:
        """Read a language's `other_languages.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = folder / _FILE
        return cls(read_listed(path, str.istitle, "a language's name"), spoken, morphology)

    def find(self, clauses: Sequence[Clause]) -> OtherLanguage | None:
        """What a text looks like; None for this language, and for what cannot be told from it."""
        words = [
            word.lower
            for clause in clauses
            for place, word in enumerate(clause.words)
            if _may_tell(word, first=place == 0)
        ]
        unknown = [word for word in words if not any(each.exact for each in self._morphology.readings(word))]
        if not unknown:
            return None
        share = len(unknown) / len(words)
        told = Counter(
            name for word in unknown for name, telling in self._telling.items() if fold(word) in telling
        )
        noise = sum(_NOISE.fullmatch(fold(word)) is not None for word in unknown)
        if share > _UNKNOWN and 2 * noise >= len(unknown):
            return OtherLanguage(NOISE, tuple(unknown), len(words))
        if not told:
            return None
        name, count = told.most_common(1)[0]
        if share > _UNKNOWN or (count >= _TOLD and share >= _UNKNOWN_TOLD):
            return OtherLanguage(name, tuple(unknown), len(words))
        return None


def _may_tell(word: Word, *, first: bool) -> bool:
    """Whether a word may tell the language: no short form, no number, no name."""
    return word.kind is WordKind.LETTERS and not word.stands_for and (first or not word.capitalised)
