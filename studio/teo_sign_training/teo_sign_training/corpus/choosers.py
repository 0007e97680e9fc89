# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Choices while a sentence is made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from random import Random
from typing import TypeVar

from teo_sign_training.corpus.grammar import Rule, Shape
from teo_sign_training.corpus.words import ListedWord, Pool

_Weighted = TypeVar("_Weighted", Rule, Shape)

#: Share of the slots that are given a held-out word, where there is one, in sentences that test words.
_HELD_SHARE = 0.5
#: Share of contractions that are written where both ways are right ("don't", "do not"): most are in messages,
#: few in school texts, and a model has to read both.
_CONTRACTED_SHARE = 0.6
#: Numbers up to this are mostly written in words, as people do.
_WORDS_UP_TO = 12


@dataclass
class Chooser:
    """Chooses by weight at each place of a sentence; its `path` (`S.P.n`) names the place.

    Attributes:
        random: Source of chance.
        held: Whether held-out words are to be taken.
    """

    random: Random
    held: bool = False

    def rule(self, path: str, rules: Sequence[Rule]) -> Rule:
        """One of the alternatives, by weight."""
        del path
        return self._by_weight(rules)

    def word(self, path: str, pool: Pool) -> ListedWord | None:
        """A word, by weight."""
        del path
        return pool.draw(self.random, self.held and self.random.random() < _HELD_SHARE)

    def shape(self, path: str, shapes: Sequence[Shape]) -> Shape:
        """A verb shape, by weight."""
        del path
        return self._by_weight(shapes)

    def number(self, path: str, low: int, high: int, step: int) -> int:
        """A number, the small ones more often where there are many."""
        del path
        count = (high - low) // step + 1
        return low + step * int(count * self.random.random() ** 1.5)

    def in_words(self, path: str, value: int) -> bool:
        """Small numbers mostly in words, large ones mostly in digits."""
        del path
        return self.random.random() < (0.7 if value <= _WORDS_UP_TO else 0.3)

    def contracted(self) -> bool:
        """Whether two words are written as one where both ways are right."""
        return self.random.random() < _CONTRACTED_SHARE

    def _by_weight(self, items: Sequence[_Weighted]) -> _Weighted:
        return self.random.choices(items, cum_weights=list(accumulate(item.weight for item in items)))[0]
