# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Words that have a sign of their own, and signing with them a sentence that the model does not know."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

from teo_common.text_folding import fold, strip_marks
from teo_sign_translator.data_files import data_file, invalid_line, read_rows
from teo_sign_translator.output.output_words import (
    SPELLED_CONFIDENCE,
    OutputWord,
    carried,
    lexical,
    number,
    spelled,
)
from teo_sign_translator.output.translation import Origin
from teo_sign_translator.text.reading import Word, WordKind

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
        for line, (gloss, category, words) in read_rows(path, columns=3):
            if category not in _CLASSES or (gloss == _NO_SIGN) != (category == "function") or " " in gloss:
                expected = f"a gloss without spaces ('{_NO_SIGN}' for function words) and a class of "
                got = f"'{gloss}' and '{category}'"
                raise invalid_line(path, line, expected + ", ".join(_CLASSES), got)
            for text in (word.strip().lower() for word in words.split(",")):
                if not text or text in entries:
                    raise invalid_line(path, line, "words, each listed once", f"'{text}'")
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


#: A listed word that is a clause of its own ("Hola", "Gracias"): nothing is left to order, only the sense may
#: be wrong.
_ALONE_CONFIDENCE = 0.9
#: A listed word among others: its sign is right, its place and form in the sentence are not looked at.
_LISTED_CONFIDENCE = 0.5
#: A name, or digits: spelled and counted as they are, at a place that is not looked at.
_NAME_CONFIDENCE = 0.5


def word_by_word(words: Sequence[Word], glosses: GlossList) -> list[OutputWord]:
    """Sign each word: listed words and phrases by their gloss, numbers by digits, all others spelled.

    Function words have no sign and go with the next word. A capital in the middle marks a name, which is
    spelled even if the word is listed, unless everything is in capitals.
    """
    shouted = all(word.parts[0].isupper() for word in words)
    content = [word for word in words if not _is_function(word, glosses)]
    result: list[OutputWord] = []
    index = 0
    while index < len(words):
        word = words[index]
        if word.kind is WordKind.NUMBER:
            confidence = _NAME_CONFIDENCE if len(content) > 1 else _ALONE_CONFIDENCE
            result += number(word.value, word.parts, confidence)
            index += 1
            continue
        name = index > 0 and word.capitalised and not shouted and not _is_function(word, glosses)
        found = None if name else glosses.find_longest(_run(words, index, glosses.longest))
        if found is None:
            likely_name = word.capitalised and not shouted
            confidence = _NAME_CONFIDENCE if likely_name else SPELLED_CONFIDENCE
            result += spelled(word.lower, word.parts, confidence)
            index += 1
            continue
        entry, size = found
        typed = tuple(part for w in words[index : index + size] for part in w.parts)
        if entry.function:
            result += [carried(w.lower, w.parts) for w in words[index : index + size]]
        else:
            alone = size == len(words)
            confidence = _ALONE_CONFIDENCE if alone else _LISTED_CONFIDENCE
            result.append(lexical(entry.gloss, typed, confidence, Origin.WORD_LIST))
        index += size
    return result


def _is_function(word: Word, glosses: GlossList) -> bool:
    entry = glosses.find(word.lower) if word.kind is not WordKind.NUMBER else None
    return entry is not None and entry.function


def _run(words: Sequence[Word], start: int, longest: int) -> list[str]:
    """Words in lower case from a place on, up to the next number, at most `longest`."""
    run = takewhile(lambda word: word.kind is not WordKind.NUMBER, words[start : start + longest])
    return [word.lower for word in run]
