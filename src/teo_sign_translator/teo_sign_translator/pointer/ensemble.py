# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Networks that were trained alike from other seeds, as one: the mean of their probabilities.

Networks that learned the same sentences agree on what these teach, and are wrong each in its own way
(Hansen and Salamon, 1990).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from teo_sign_translator.pointer.array_model import Array, ArrayModel, Ints, Memory, Step
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.vocabulary import Vocabulary
from teo_sign_translator.text.source_word import SourceWord


def member_weights(
    weights: Sequence[Mapping[str, NDArray[np.floating]]],
) -> dict[str, NDArray[np.floating]]:
    """The weights of all members in one file: each member's names behind its number."""
    return {f"{member}.{name}": value for member, own in enumerate(weights) for name, value in own.items()}


class Ensemble:
    """`ArrayModel`s of one configuration and vocabulary, asked together."""

    def __init__(
        self, config: NetworkConfig, vocabulary: Vocabulary, weights: Mapping[str, NDArray[np.floating]]
    ) -> None:
        """Take over the weights that `member_weights` put together.

        Raises:
            TranslationError: "invalid_model" if a weight is missing, has another shape or is not finite.
        """
        self.config = config
        self.vocabulary = vocabulary
        self._members = [
            ArrayModel(config, vocabulary, of_member(member, weights)) for member in range(config.members)
        ]

    def encode(self, sentences: Sequence[Sequence[SourceWord]], spare: int = 0) -> Memory:
        """See `ArrayModel.encode`; the states of all members follow one another."""
        first, *others = (member.encode(sentences, spare) for member in self._members)
        states = tuple(state for memory in (first, *others) for state in memory.first)
        return replace(first, first=states, others=tuple(others))

    def step(self, memory: Memory, said: Ints, states: tuple[Array, ...]) -> Step:
        """See `ArrayModel.step`."""
        size = len(states) // len(self._members)
        steps = [
            member.step(own, said, states[place * size : (place + 1) * size])
            for place, (member, own) in enumerate(zip(self._members, (memory, *memory.others), strict=True))
        ]
        return Step(
            _mean([step.probability for step in steps]),
            _mean([step.candidates for step in steps]),
            _mean([step.attention for step in steps]),
            tuple(state for step in steps for state in step.states),
        )

    def positions(self, memory: Memory) -> Array:
        """See `ArrayModel.positions`."""
        own = zip(self._members, (memory, *memory.others), strict=True)
        return _mean([member.positions(each) for member, each in own])


def _mean(arrays: Sequence[Array]) -> Array:
    total: Array = reduce(np.add, arrays)
    result: Array = total / np.float32(len(arrays))
    return result


def of_member(member: int, weights: Mapping[str, NDArray[np.floating]]) -> dict[str, NDArray[np.floating]]:
    """The weights of one member of those that `member_weights` put together."""
    beginning = f"{member}."
    return {
        name.removeprefix(beginning): value for name, value in weights.items() if name.startswith(beginning)
    }
