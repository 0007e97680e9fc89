"""Choices while a sentence is made: by chance for a corpus, as given for an example of the grammar."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from random import Random
from typing import Protocol, TypeVar

from teo_sign_translator.corpus.grammar import Rule, Shape
from teo_sign_translator.corpus.words import Pool, Word
from teo_sign_translator.errors import TranslationError

_Weighted = TypeVar("_Weighted", Rule, Shape)
_Item = TypeVar("_Item")

#: Share of the slots that are given a held-out word, where there is one, in sentences that test words.
_HELD_SHARE = 0.5
#: Numbers up to this are mostly written in words, as people do.
_WORDS_UP_TO = 12


class Chooser(Protocol):
    """Chooses at each place of a sentence."""

    def rule(self, path: str, rules: Sequence[Rule]) -> Rule:
        """One of the alternatives, of which there is at least one."""

    def word(self, path: str, pool: Pool) -> Word | None:
        """One of the words; None if there is none."""

    def shape(self, path: str, shapes: Sequence[Shape]) -> Shape:
        """One of the verb shapes, of which there is at least one."""

    def number(self, path: str, low: int, high: int, step: int) -> int:
        """A number."""

    def in_words(self, path: str, value: int) -> bool:
        """Whether a number is written in words."""


@dataclass
class RandomChooser:
    """Chooses by weight.

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

    def word(self, path: str, pool: Pool) -> Word | None:
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

    def _by_weight(self, items: Sequence[_Weighted]) -> _Weighted:
        return self.random.choices(items, cum_weights=list(accumulate(item.weight for item in items)))[0]


@dataclass
class ExampleChooser:
    """Takes what an example fixes and the first of everything else.

    Attributes:
        fixed: Choice by path (`S.P.n`), or by a slot's name alone, wherever it is.
        used: Paths that were asked for.
    """

    fixed: Mapping[str, str]
    used: set[str] = field(default_factory=set)

    def rule(self, path: str, rules: Sequence[Rule]) -> Rule:
        """The fixed alternative, or the first."""
        wanted = self._wanted(path)
        return rules[0] if wanted is None else self._named(path, wanted, {rule.name: rule for rule in rules})

    def word(self, path: str, pool: Pool) -> Word | None:
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
