# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The readable list of words that have a sign of their own."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_common.text_folding import fold, strip_marks
from teo_sign_translator.data_files import data_file, invalid_line, read_rows

_CLASSES = ("function", "interjection", "word")
_NO_SIGN = "-"


@dataclass(frozen=True, slots=True)
class GlossEntry:
    """What a word or phrase stands for.

    Attributes:
        gloss: Name of the sign; empty for a function word, which LSE leaves out.
        interjection: Whether it may stand before a sentence without a comma.
    """

    gloss: str
    interjection: bool = False

    @property
    def function(self) -> bool:
        """Whether the word has no sign of its own and goes with its neighbour."""
        return not self.gloss


class GlossList:
    """Words and phrases with a sign of their own, found however they are typed.

    The spelling with accents decides; typed without accents a word is found if no entry is spelled just so.
    """

    def __init__(self, entries: dict[str, GlossEntry]) -> None:
        """Index the entries by their spelling in lower case."""
        self._exact = dict(entries)
        self._tolerant: dict[str, GlossEntry] = {}
        for form in (fold, strip_marks):
            for text, entry in entries.items():
                self._tolerant.setdefault(form(text), entry)
        #: Words of the longest phrase.
        self.longest = max((len(text.split()) for text in entries), default=1)

    @classmethod
    def load(cls, path: Path | None = None) -> GlossList:
        """Read the list.

        Args:
            path: The file; by default the package's `text/glosses.tsv`, which explains its columns.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        path = path or data_file("glosses.tsv")
        entries: dict[str, GlossEntry] = {}
        for number, (gloss, category, words) in read_rows(path, columns=3):
            if category not in _CLASSES or (gloss == _NO_SIGN) != (category == "function") or " " in gloss:
                expected = f"a gloss without spaces ('{_NO_SIGN}' for function words) and a class of "
                got = f"'{gloss}' and '{category}'"
                raise invalid_line(path, number, expected + ", ".join(_CLASSES), got)
            for text in (word.strip().lower() for word in words.split(",")):
                if not text or text in entries:
                    raise invalid_line(path, number, "words, each listed once", f"'{text}'")
                entries[text] = GlossEntry("" if gloss == _NO_SIGN else gloss, category == "interjection")
        return cls(entries)

    def find(self, text: str) -> GlossEntry | None:
        """The entry of a word or phrase in lower case, accents typed or not; None if it is not listed."""
        entry = self._exact.get(text)
        if entry is None and text == fold(text):  # "té" is not "te": who types accents means them
            entry = self._tolerant.get(text)
        return entry

    def find_longest(self, words: Sequence[str]) -> tuple[GlossEntry, int] | None:
        """The entry of the longest phrase that the words (lower case) begin with, and its number of words."""
        for size in range(min(self.longest, len(words)), 0, -1):
            entry = self.find(" ".join(words[:size]))
            if entry is not None:
                return entry, size
        return None

    def __iter__(self) -> Iterator[str]:
        """Words and phrases in lower case."""
        return iter(self._exact)
