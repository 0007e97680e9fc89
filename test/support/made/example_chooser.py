# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Choices as an example of the grammar fixes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random
from typing import TypeVar

from teo_sign_training.corpus.derivation import Chooser
from teo_sign_training.corpus.grammar import Rule, Shape
from teo_sign_training.corpus.words import ListedWord, Pool
from teo_sign_translator.errors import TranslationError

_Item = TypeVar("_Item")


class ExampleChooser(Chooser):
    """Takes what an example fixes and the first of everything else.

    Attributes:
        fixed: Choice by path (`S.P.n`), or by a slot's name alone, wherever it is.
        used: Paths that were asked for.
    """

    def __init__(self, fixed: Mapping[str, str]) -> None:
        super().__init__(Random(0))
        self.fixed = fixed
        self.used: set[str] = set()

    def rule(self, path: str, rules: Sequence[Rule]) -> Rule:
        """The fixed alternative, or the first."""
        wanted = self._wanted(path)
        return rules[0] if wanted is None else self._named(path, wanted, {rule.name: rule for rule in rules})

    def word(self, path: str, pool: Pool) -> ListedWord | None:
        """The fixed word, or the first."""
        words = (*pool.known, *pool.held)
        wanted = self._wanted(path)
        if wanted is None:
            return words[0] if words else None
        return self._named(path, wanted, {word.lemma: word for word in reversed(words)})

    def shape(self, path: str, shapes: Sequence[Shape]) -> Shape:
        """The shape fixed under `path.shape`, or the first."""
        wanted = self._wanted(f"{path}.shape")
        return (
            shapes[0] if wanted is None else self._named(path, wanted, {each.name: each for each in shapes})
        )

    def number(self, path: str, low: int, high: int, step: int) -> int:
        """The fixed number, or the least."""
        del high, step
        return int(self._wanted(path) or low)

    def in_words(self, path: str, value: int) -> bool:
        """In words, unless `path.digits` is fixed."""
        del value
        return self._wanted(f"{path}.digits") is None

    def _wanted(self, path: str) -> str | None:
        end = path.rpartition(".")[2] if not path.endswith((".shape", ".digits")) else ""
        for key in (path, end):
            if key in self.fixed:
                self.used.add(key)
                return self.fixed[key]
        return None

    @staticmethod
    def _named(path: str, wanted: str, items: Mapping[str, _Item]) -> _Item:
        if wanted not in items:
            raise TranslationError(
                "invalid_grammar",
                f"example: expected for '{path}' one of {sorted(items)[:30]}, got '{wanted}'",
            )
        return items[wanted]
