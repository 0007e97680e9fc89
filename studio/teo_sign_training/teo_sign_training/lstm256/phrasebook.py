# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The sentences that the model was trained on: recognising them, and the words their glosses stand for."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_common.text_folding import strip_marks
from teo_sign_training.corpus.paper_pairs import NAME, NUMBER, SLOTS, AlignedPair, training_pairs
from teo_sign_training.lstm256.seq2seq import MARKS, folded_tokens
from teo_sign_training.lstm256.word_by_word import GlossList
from teo_sign_translator.data_files import data_file
from teo_sign_translator.text.reading import SentenceType, Word, WordKind, read, sentence_type

#: Most words that are taken for one name ("María del Carmen de la Torre").
_MAX_NAME_WORDS = 6

# Lower-case words inside names.
_PARTICLES = frozenset({"de", "del", "la", "las", "los"})


@dataclass(frozen=True, slots=True)
class Pattern:
    """A sentence of the training data.

    Attributes:
        tokens: Its words and slots as the model reads them, without marks.
        glosses: What it is translated to, with slots.
        sources: For each gloss the places in `tokens` that it stands for.
        type: Its type, by its own marks.
        inner_stop: Whether a mark that ends a sentence stands inside it ("¡Cuidado! Eso puede romperse!").
    """

    tokens: tuple[str, ...]
    glosses: tuple[str, ...]
    sources: tuple[tuple[int, ...], ...]
    type: SentenceType
    inner_stop: bool


@dataclass(frozen=True, slots=True)
class Match:
    """A pattern found in a text.

    Attributes:
        pattern: What was found.
        words: For each token of the pattern the words of the text that it stands for: one, or several in a
            name.
    """

    pattern: Pattern
    words: tuple[tuple[Word, ...], ...]


class Phrasebook:
    """Finds sentences of the training data, however they are typed."""

    def __init__(self, pairs: Iterable[AlignedPair], glosses: GlossList) -> None:
        """Index the pairs.

        Args:
            pairs: The training data.
            glosses: Words listed there are taken for names only with a capital ("Soy Ángel", but "soy yo").
        """
        self._glosses = glosses
        self._literal: dict[tuple[str, ...], Pattern] = {}
        self._with_slots: dict[str, list[Pattern]] = defaultdict(list)
        for pair in pairs:
            pattern = _pattern(pair)
            key = tuple(strip_marks(token) for token in pattern.tokens)
            if any(token in SLOTS for token in pattern.tokens):
                first = pattern.tokens[0]
                self._with_slots[first if first in SLOTS else key[0]].append(pattern)
            else:
                self._literal.setdefault(key, pattern)
        slotted = [pattern for patterns in self._with_slots.values() for pattern in patterns]
        #: Words of the longest sentence that can match.
        self.longest = max(
            [len(key) for key in self._literal]
            + [len(pattern.tokens) + (_MAX_NAME_WORDS - 1) * (NAME in pattern.tokens) for pattern in slotted],
            default=0,
        )

    @classmethod
    def load(cls, folder: Path | None = None) -> Phrasebook:
        """That of a language; empty if the language has no sentences that are known by heart.

        Args:
            folder: The language's text folder; by default that of the default language.

        Raises:
            TranslationError: "invalid_data", with file and line.
        """
        pairs = training_pairs(folder)
        return cls(
            pairs, GlossList.load((folder or data_file("")) / "glosses.tsv") if pairs else GlossList({})
        )

    def match(
        self, words: Sequence[Word], *, crosses_stop: bool = False, crosses_pause: bool = False
    ) -> Match | None:
        """The pattern that all the words together are; None if they are none.

        Args:
            words: Of one clause, or of several that follow one another.
            crosses_stop: Whether a sentence ends between them; only patterns with such a mark inside match
                then.
            crosses_pause: Whether a comma stands between them; patterns with slots do not match then.
        """
        if len(words) > self.longest:
            return None
        pattern = self._literal.get(tuple(word.key for word in words))
        if pattern is not None:
            return (
                Match(pattern, tuple((word,) for word in words))
                if pattern.inner_stop or not crosses_stop
                else None
            )
        if crosses_stop or crosses_pause or not words:
            return None
        for first in (words[0].key, *SLOTS):
            for candidate in self._with_slots.get(first, ()):
                filled = self._fill(candidate, words)
                if filled is not None:
                    return Match(candidate, filled)
        return None

    def _fill(self, pattern: Pattern, words: Sequence[Word]) -> tuple[tuple[Word, ...], ...] | None:
        """The words that each token of a pattern stands for, or None if they do not fit."""
        result: list[tuple[Word, ...]] = []
        rest = list(words)
        for index, token in enumerate(pattern.tokens):
            # One name in a pattern: it takes what the other tokens leave.
            size = len(rest) - (len(pattern.tokens) - index - 1) if token == NAME else 1
            taken, rest = tuple(rest[:size]), rest[size:]
            if not taken or size < 1 or not self._fits(token, taken):
                return None
            result.append(taken)
        return None if rest else tuple(result)

    def _fits(self, token: str, words: Sequence[Word]) -> bool:
        if token == NUMBER:  # "Yo tengo X años" may be typed as the paper prints it
            return words[0].kind is WordKind.NUMBER or words[0].key == "x"
        if token == NAME:
            return (
                len(words) <= _MAX_NAME_WORDS
                and self._is_name(words[0])
                and self._is_name(words[-1])
                and all(self._is_name(word) or word.lower in _PARTICLES for word in words)
            )
        return words[0].key == strip_marks(token)

    def _is_name(self, word: Word) -> bool:
        if word.kind is not WordKind.LETTERS:
            return False
        entry = self._glosses.find(word.lower)
        return entry is None or word.parts[0].istitle()


def _pattern(pair: AlignedPair) -> Pattern:
    tokens = tuple(token for token in folded_tokens(pair.sentence) if token not in MARKS)
    keys = [strip_marks(token) for token in tokens]
    sources = tuple(
        tuple(i for i, key in enumerate(keys) if key in {strip_marks(word) for word in words})
        for words in pair.sources
    )
    # Slots are braces, which are marks to a reader; their places do not matter for the type.
    clauses = read(re.sub(r"[{}]", "", pair.sentence)).clauses
    inner_stop = any(clause.closes for clause in clauses[:-1])
    return Pattern(tokens, pair.glosses, sources, sentence_type(clauses), inner_stop)
