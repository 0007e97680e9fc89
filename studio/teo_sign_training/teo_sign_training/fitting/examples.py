# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Training pairs as arrays, and how people type them.

Each different word is read once; a pair is places in tables. Typing leaves out accents, capitals and marks.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from teo_common.text_folding import without_accents
from teo_sign_training.corpus import Pair
from teo_sign_training.corpus.paper_pairs import Reader
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.vocabulary import READINGS, copied_gloss
from teo_sign_translator.text.source_word import SourceWord

Ints = NDArray[np.int64]

#: Columns of `WordTable.variants`: bit 0 set if accents are dropped, bit 1 if capitals are.
VARIANTS = 4


@dataclass(frozen=True, slots=True)
class Examples:
    """Pairs as flat arrays; pair i has the words `word_start[i]:word_start[i + 1]`, and so on.

    Attributes:
        words: Rows of the `WordTable`. Shape (n_words,).
        word_start: Shape (n + 1,).
        glosses: Places in the `WordTable`'s glosses. Shape (n_glosses,).
        gloss_start: Shape (n + 1,).
        link_gloss: For each gloss and each word that it stands for: place in `glosses`. Shape (n_links,).
        link_word: Likewise: place in `words`. Shape (n_links,).
        link_start: Shape (n + 1,).
    """

    words: Ints
    word_start: Ints
    glosses: Ints
    gloss_start: Ints
    link_gloss: Ints
    link_word: Ints
    link_start: Ints

    def __len__(self) -> int:
        return len(self.word_start) - 1

    def take(self, pairs: Ints) -> Examples:
        """The chosen pairs, in the order given; a pair may be taken several times."""
        words, word_start = _spans(self.word_start, pairs)
        glosses, gloss_start = _spans(self.gloss_start, pairs)
        links, link_start = _spans(self.link_start, pairs)
        counts = np.diff(link_start)
        return Examples(
            self.words[words],
            word_start,
            self.glosses[glosses],
            gloss_start,
            self.link_gloss[links] + np.repeat(gloss_start[:-1] - self.gloss_start[pairs], counts),
            self.link_word[links] + np.repeat(word_start[:-1] - self.word_start[pairs], counts),
            link_start,
        )


def _spans(start: Ints, chosen: Ints) -> tuple[Ints, Ints]:
    """Places of all elements of chosen spans (span i is `start[i]:start[i + 1]`), and their new starts."""
    counts = start[chosen + 1] - start[chosen]
    new_start = np.concatenate([[0], np.cumsum(counts)])
    offset = np.repeat(start[chosen] - new_start[:-1], counts)
    return np.arange(new_start[-1]) + offset, new_start


@dataclass(frozen=True)
class WordTable:
    """Every different word of the pairs, in every way of typing that training shows.

    Attributes:
        words: The words; row 0 and 1 are the root and the blank, which are no words.
        variants: Row of each word with accents and capitals dropped; see `VARIANTS`. Shape (rows, 4).
        marks: Whether a row is a punctuation mark. Shape (rows,).
        glosses: Every gloss that occurs or can be copied.
        copies: For each reading the place of its copy in `glosses`, -1 where there is no reading.
            Shape (rows, READINGS).
    """

    words: tuple[SourceWord | None, ...]
    variants: Ints
    marks: NDArray[np.bool_]
    glosses: tuple[str, ...]
    copies: Ints


ROOT_ROW, BLANK_ROW = 0, 1


@dataclass
class ExampleReader:
    """Collects pairs and the words that occur in them."""

    read: Reader
    _rows: dict[SourceWord, int] = field(default_factory=dict)
    _words: list[SourceWord | None] = field(default_factory=lambda: [None, None])
    _glosses: dict[str, int] = field(default_factory=dict)

    def examples(self, pairs: Iterable[Pair]) -> Examples:
        """Pairs as arrays.

        Raises:
            TranslationError: "invalid_data" if an alignment does not fit its sentence.
        """
        words: list[int] = []
        glosses: list[int] = []
        links: list[tuple[int, int]] = []
        starts: list[tuple[int, int, int]] = [(0, 0, 0)]
        for pair in pairs:
            rows = [self._row(word) for word in self.read(pair.text)]
            if len(pair.alignment) != len(pair.glosses) or any(
                not 0 <= place < len(rows) for places in pair.alignment for place in places
            ):
                raise TranslationError(
                    "invalid_data",
                    f"expected for each gloss of '{pair.text}' places among its {len(rows)} words, got "
                    f"{pair.alignment} for {pair.glosses}",
                )
            links += (
                (len(glosses) + gloss, len(words) + place)
                for gloss, places in enumerate(pair.alignment)
                for place in places
            )
            words += rows
            glosses += (self._gloss(gloss) for gloss in pair.glosses)
            starts.append((len(words), len(glosses), len(links)))
        word_start, gloss_start, link_start = np.array(starts, np.int64).T
        link_gloss, link_word = np.array(links, np.int64).reshape(-1, 2).T
        return Examples(
            np.array(words, np.int64),
            word_start,
            np.array(glosses, np.int64),
            gloss_start,
            link_gloss,
            link_word,
            link_start,
        )

    def table(self) -> WordTable:
        """The words of all pairs read so far."""
        variants = [[ROOT_ROW] * VARIANTS, [BLANK_ROW] * VARIANTS]
        for word in self._words[2:]:
            assert word is not None
            variants.append([self._variant(word, bits) for bits in range(VARIANTS)])
        # A variant may be a word of its own that has not been met; it has no need of variants.
        variants += ([row] * VARIANTS for row in range(len(variants), len(self._words)))
        copies = np.full((len(self._words), READINGS), -1, np.int64)
        for row, word in enumerate(self._words):
            for place, reading in enumerate(word.readings[:READINGS] if word else ()):
                copies[row, place] = self._gloss(copied_gloss(reading))
        marks = [word is not None and word.readings[0].tag == "MARK" for word in self._words]
        return WordTable(
            tuple(self._words),
            np.array(variants, np.int64),
            np.array(marks, np.bool_),
            tuple(self._glosses),
            copies,
        )

    def _row(self, word: SourceWord) -> int:
        row = self._rows.setdefault(word, len(self._words))
        if row == len(self._words):
            self._words.append(word)
        return row

    def _gloss(self, gloss: str) -> int:
        return self._glosses.setdefault(gloss, len(self._glosses))

    def _variant(self, word: SourceWord, bits: int) -> int:
        text = without_accents(word.text) if bits & 1 else word.text
        capital = word.capital
        if bits & 2:
            text, capital = text.lower(), False
        if text == word.text:
            return self._row(word)
        # Behind another word, as inside a sentence: there a capital means something.
        read = self.read(f"y {text}" if capital else text)[-1:]
        if not read or read[0].text != text:
            return self._row(word)
        return self._row(read[0])


#: Of the pairs that are not shown as written, how many lose what. Not measured on people: half of each, so
#: that all eight ways of typing a sentence are about as frequent.
_NO_ACCENTS = 0.6
_NO_CAPITALS = 0.6
_NO_FINAL_MARK = 0.3
_NO_MARKS = 0.3


@dataclass(frozen=True, slots=True)
class Typing:
    """How each pair of a pass is typed.

    Attributes:
        variant: Column of `WordTable.variants`. Shape (n,).
        drop_final: Whether a mark at the end is left out. Shape (n,).
        drop_marks: Whether all marks are left out. Shape (n,).
    """

    variant: Ints
    drop_final: NDArray[np.bool_]
    drop_marks: NDArray[np.bool_]

    @classmethod
    def draw(cls, count: int, clean: float, random: np.random.Generator) -> Typing:
        """A way of typing for each pair; `clean` of them as written."""
        noisy = random.random(count) >= clean
        variant = (random.random(count) < _NO_ACCENTS) + 2 * (random.random(count) < _NO_CAPITALS)
        marks = random.random(count)
        return cls(
            np.where(noisy, variant, 0).astype(np.int64),
            noisy & (marks < _NO_FINAL_MARK),
            noisy & (marks >= _NO_FINAL_MARK) & (marks < _NO_FINAL_MARK + _NO_MARKS),
        )


def typed(examples: Examples, table: WordTable, typing: Typing) -> Examples:
    """The pairs as typed: words replaced by their variants, marks left out, the alignment kept.

    A mark that a gloss stands for stays.
    """
    lengths = np.diff(examples.word_start)
    words = table.variants[examples.words, np.repeat(typing.variant, lengths)]
    drop = np.repeat(typing.drop_marks, lengths)
    final = (examples.word_start[1:] - 1)[lengths > 0]
    drop[final] |= typing.drop_final[lengths > 0]
    drop &= table.marks[words]
    drop[examples.link_word] = False
    keep = ~drop
    place = np.concatenate([[0], np.cumsum(keep)])
    return Examples(
        words[keep],
        place[examples.word_start],
        examples.glosses,
        examples.gloss_start,
        examples.link_gloss,
        place[examples.link_word],
        examples.link_start,
    )


def copies(examples: Examples, table: WordTable) -> NDArray[np.bool_]:
    """For each link, which readings of its word would copy its gloss. Shape (n_links, READINGS)."""
    wanted = examples.glosses[examples.link_gloss]
    result: NDArray[np.bool_] = table.copies[examples.words[examples.link_word]] == wanted[:, None]
    return result


def unsayable(
    examples: Examples, table: WordTable, closed: NDArray[np.bool_], copy: bool
) -> NDArray[np.bool_]:
    """Which pairs hold a gloss that is neither in the closed list nor a copy. Shape (n,).

    Args:
        examples: The pairs.
        table: Their words.
        closed: For each gloss of the table whether it is in the closed list.
        copy: Whether the model can copy.
    """
    sayable = closed[examples.glosses]
    if copy:
        sayable[examples.link_gloss[copies(examples, table).any(axis=1)]] = True
    bad = np.concatenate([[0], np.cumsum(~sayable)])
    return bad[examples.gloss_start[1:]] > bad[examples.gloss_start[:-1]]


def typed_sayably(
    examples: Examples, table: WordTable, typing: Typing, closed: NDArray[np.bool_], copy: bool
) -> Examples:
    """`typed`, but with accents and capitals where a gloss could not be said without them."""
    lost = unsayable(typed(examples, table, typing), table, closed, copy)
    kept = Typing(np.where(lost, 0, typing.variant), typing.drop_final, typing.drop_marks)
    return typed(examples, table, kept)
