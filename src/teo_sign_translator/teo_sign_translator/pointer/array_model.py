# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The zoo's models on plain arrays: no training framework is needed to translate."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_sign_translator.pointer.config import Cell, NetworkConfig, check_weights, weight_shapes
from teo_sign_translator.pointer.vocabulary import BLANK, READINGS, ROOT, Vocabulary, WordFeatures, tag_parts
from teo_sign_translator.text.source_word import SourceWord

Array = NDArray[np.float32]


class Layer(ABC):
    """One recurrent layer in one direction.

    A state is an array of shape (rows, state size) whose first `hidden` columns are the layer's output.
    """

    def __init__(self, weights: Mapping[str, Array], prefix: str, suffix: str) -> None:
        """Take over the weights that PyTorch calls `{prefix}.weight_ih_{suffix}` and so on."""
        # Transposed and contiguous for `inputs @ weights`.
        self._input: Array = np.ascontiguousarray(weights[f"{prefix}.weight_ih_{suffix}"].T)
        self._recurrent: Array = np.ascontiguousarray(weights[f"{prefix}.weight_hh_{suffix}"].T)
        self._input_bias: Array = weights[f"{prefix}.bias_ih_{suffix}"]
        self._recurrent_bias: Array = weights[f"{prefix}.bias_hh_{suffix}"]
        self._bias = self._input_bias + self._recurrent_bias
        self._hidden = len(self._recurrent)

    def project(self, inputs: Array) -> Array:
        """The part of the gates that the input alone decides; shape (..., inputs) -> (..., gates)."""
        return inputs @ self._input + self._bias

    @abstractmethod
    def step(self, projected: Array, state: Array) -> Array:
        """The next state; shapes (rows, gates), (rows, state size)."""


class _RnnLayer(Layer):
    """Elman's: h' = tanh(W x + U h + b)."""

    def step(self, projected: Array, state: Array) -> Array:
        """See `Layer`; the state is h."""
        result: Array = np.tanh(projected + state @ self._recurrent)
        return result


class _GruLayer(Layer):
    """Cho's, gates in the order reset, update, new; the reset gate acts on U h + b as in PyTorch."""

    def project(self, inputs: Array) -> Array:
        """See `Layer`."""
        return inputs @ self._input + self._input_bias

    def step(self, projected: Array, state: Array) -> Array:
        """See `Layer`; the state is h."""
        size = self._hidden
        recurrent = state @ self._recurrent + self._recurrent_bias
        # sigmoid(x) = (tanh(x / 2) + 1) / 2, without overflow
        both: Array = projected[:, : 2 * size] + recurrent[:, : 2 * size]
        gates: Array = 0.5 * np.tanh(0.5 * both) + 0.5
        reset, update = gates[:, :size], gates[:, size:]
        new = np.tanh(projected[:, 2 * size :] + reset * recurrent[:, 2 * size :])
        result: Array = new + update * (state - new)
        return result


class LstmLayer(Layer):
    """Hochreiter's and Schmidhuber's, gates in the order input, forget, cell, output."""

    def step(self, projected: Array, state: Array) -> Array:
        """See `Layer`; the state is h, then c."""
        size = self._hidden
        gates = projected + state[:, :size] @ self._recurrent
        # One tanh over all four gates: sigmoid(x) = (tanh(x / 2) + 1) / 2.
        cell_gate = gates[:, 2 * size : 3 * size]
        cell_gate *= 2
        gates *= 0.5
        np.tanh(gates, out=gates)
        opened = 0.5 * gates + 0.5
        result: Array = np.empty_like(state)
        memory = result[:, size:]
        np.multiply(opened[:, size : 2 * size], state[:, size:], out=memory)
        memory += opened[:, :size] * cell_gate
        np.multiply(opened[:, 3 * size :], np.tanh(memory), out=result[:, :size])
        return result


_LAYERS: Mapping[Cell, type[Layer]] = {
    "rnn": _RnnLayer,
    "gru": _GruLayer,
    "lstm": LstmLayer,
}


def _run_layer(layer: Layer, inputs: Array, state_size: int, hidden: int, *, backwards: bool) -> Array:
    """Outputs of a layer at every word, from a state of zeros. Shape (B, W, inputs) -> (B, W, hidden)."""
    count, length = inputs.shape[:2]
    projected = layer.project(inputs).swapaxes(0, 1)
    state = np.zeros((count, state_size), np.float32)
    result = np.empty((count, length, hidden), np.float32)
    for place in reversed(range(length)) if backwards else range(length):
        state = layer.step(projected[place], state)
        result[:, place] = state[:, :hidden]
    return result


Ints = NDArray[np.int64]

#: Words whose features are kept; a few megabytes, and nearly every word of a conversation.
_CACHED_WORDS = 20_000


@dataclass(frozen=True, slots=True)
class Memory:
    """What the decoder attends to: sentences of the same length W, the root included.

    Attributes:
        words: Outputs of the encoder. Shape (B, W, m).
        keys: What attention compares with. Shape (B, hidden, W); empty without attention.
        pointer: What the pointer compares with. Shape (B, hidden, C), C = W * READINGS; empty without copy.
        said: First gates of the decoder after each candidate was said. Shape (B, C, gates); likewise.
        first: Decoder states before the first gloss, one array a layer. Shape (B, state size).
        slots: Where each candidate's gloss stands: in the closed list, or (its size) + the first candidate
            with the same gloss. Shape (B, C).
        barred: 0 for each candidate that is a reading, minus infinity for the others. Shape (B, C).
        glosses: The candidates' glosses, of each sentence.
        others: Of the other members of an ensemble, whose first states follow in `first`.
    """

    words: Array
    keys: Array
    pointer: Array
    said: Array
    first: tuple[Array, ...]
    slots: Ints
    barred: Array
    glosses: tuple[tuple[str, ...], ...]
    others: tuple[Memory, ...] = ()


@dataclass(frozen=True, slots=True)
class Step:
    """Probabilities of the next gloss for several rows.

    Attributes:
        probability: Of each closed gloss, then of each candidate's gloss at the first candidate that has it.
            Shape (rows, V + C).
        candidates: Of each candidate alone. Shape (rows, C).
        attention: On the words. Shape (rows, W); empty without attention.
        states: Of the decoder afterwards, one a layer. Shape (rows, state size).
    """

    probability: Array
    candidates: Array
    attention: Array
    states: tuple[Array, ...]


class ArrayModel:
    """Embeddings, encoder, decoder step; `decoding.py` searches with it."""

    def __init__(
        self, config: NetworkConfig, vocabulary: Vocabulary, weights: Mapping[str, NDArray[np.floating]]
    ) -> None:
        """Take over the weights of a `Network` of the same configuration.

        Raises:
            TranslationError: "invalid_model" if a weight is missing, has another shape or is not finite.
        """
        check_weights(weight_shapes(config, vocabulary), weights)
        full: dict[str, Array] = {name: np.asarray(value, np.float32) for name, value in weights.items()}
        self.config = config
        self.vocabulary = vocabulary
        self._form = full["form.weight"]
        self._capital = full["capital.weight"]
        self._lemma = full["lemma.weight"]
        self._rank = full["rank"]
        self._part = full["part"]
        self._parts = {part: place for place, part in enumerate(vocabulary.parts)}
        own = full["tag.weight"]
        self._tags = {key: own[row] + self._by_parts(key) for row, key in enumerate(vocabulary.tags)}
        self._state_size = config.hidden * (1 + (config.cell == "lstm"))
        layer_of = _LAYERS[config.cell]
        directions = ("", "_reverse")[: 1 + config.bidirectional]
        self._encoder = [
            [layer_of(full, "encoder", f"l{layer}{each}") for each in directions]
            for layer in range(config.layers)
        ]
        self._output = np.ascontiguousarray(full["output.weight"].T)
        self._output_bias = full["output.bias"]
        self._features: dict[SourceWord, tuple[WordFeatures, Array, Array]] = {}
        if config.layout == "equal_length":
            return
        self._decoder = [layer_of(full, "decoder", f"l{layer}") for layer in range(config.layers)]
        self._start, self._start_bias = full["start.weight"].T, full["start.bias"]
        #: First gates of the decoder after each closed gloss.
        self._said = self._decoder[0].project(full["said.weight"])
        if config.attention:
            self._key, self._key_bias = full["key.weight"].T, full["key.bias"]
            self._readout = np.ascontiguousarray(full["readout.weight"].T)
            self._readout_bias = full["readout.bias"]
        if config.copy:
            self._copy_memory, self._copy_bias = full["copy_memory.weight"].T, full["copy_memory.bias"]
            self._copy_reading = np.ascontiguousarray(full["copy_reading.weight"].T)
            self._said_memory, self._said_bias = full["said_memory.weight"].T, full["said_memory.bias"]
            self._said_reading = np.ascontiguousarray(full["said_reading.weight"].T)

    def encode(self, sentences: Sequence[Sequence[SourceWord]], spare: int = 0) -> Memory:
        """Read sentences that have the same number of words.

        Args:
            sentences: At least one.
            spare: Blanks read behind the words.
        """
        features = [[self._word(word) for word in words] for words in sentences]
        nothing = np.zeros((READINGS, self.config.embedding), np.float32)
        root, blank = ((self._bare(each), nothing) for each in (ROOT, BLANK))
        embedded = [
            [root, *((vector, readings) for _, vector, readings in row), *[blank] * spare] for row in features
        ]
        words = np.array([[vector for vector, _ in row] for row in embedded], np.float32)
        for layers in self._encoder:
            words = np.concatenate(
                [
                    _run_layer(layer, words, self._state_size, self.config.hidden, backwards=bool(direction))
                    for direction, layer in enumerate(layers)
                ],
                axis=-1,
            )
        count, width = words.shape[:2]
        none = np.zeros((count, 0, 0), np.float32)
        keys = pointer = said = none
        slots, barred = np.zeros((count, 0), np.int64), np.zeros((count, 0), np.float32)
        glosses: tuple[tuple[str, ...], ...] = ((),) * count
        if self.config.attention:
            keys = (words @ self._key + self._key_bias).swapaxes(1, 2) * np.float32(self.config.hidden**-0.5)
        if self.config.copy:
            readings = np.array([[each for _, each in row] for row in embedded], np.float32)
            pointer = (
                np.tanh(
                    (words @ self._copy_memory + self._copy_bias)[:, :, None] + readings @ self._copy_reading
                )
                .reshape(count, width * READINGS, -1)
                .swapaxes(1, 2)
            )
            candidates = (words @ self._said_memory + self._said_bias)[
                :, :, None
            ] + readings @ self._said_reading
            said = self._decoder[0].project(candidates.reshape(count, width * READINGS, -1))
            glosses = tuple(_candidates(row) for row in features)
            barred = np.array([[0.0 if gloss else -np.inf for gloss in row] for row in glosses], np.float32)
            slots = np.array([self._slots(row) for row in glosses], np.int64)
        return Memory(words, keys, pointer, said, self._first_states(words), slots, barred, glosses)

    def step(self, memory: Memory, said: Ints, states: tuple[Array, ...]) -> Step:
        """Say one gloss more in each row.

        Args:
            memory: Of B sentences; each has the same number K of rows, those of one sentence together.
            said: Gloss said before: place in the closed list, or its size + candidate. Shape (rows,).
            states: Of the decoder before.
        """
        size = len(self._output_bias)
        count = len(memory.words)
        beam = len(said) // count
        projected = self._said[np.minimum(said, size - 1)]
        copied = np.flatnonzero(said >= size)
        if len(copied):
            projected[copied] = memory.said[copied // beam, said[copied] - size]
        after = [self._decoder[0].step(projected, states[0])]
        hidden = after[0][:, : self.config.hidden]
        for layer, state in zip(self._decoder[1:], states[1:], strict=True):
            after.append(layer.step(layer.project(hidden), state))
            hidden = after[-1][:, : self.config.hidden]
        attention = np.zeros((len(said), 0), np.float32)
        if self.config.attention:
            looks = softmax(hidden.reshape(count, beam, -1) @ memory.keys)
            seen = (looks @ memory.words).reshape(len(said), -1)
            attention = looks.reshape(len(said), -1)
            hidden = np.tanh(np.concatenate([hidden, seen], axis=1) @ self._readout + self._readout_bias)
        logits = hidden @ self._output + self._output_bias
        candidates = np.zeros((len(said), 0), np.float32)
        if self.config.copy:
            pointed = hidden.reshape(count, beam, -1) @ memory.pointer + memory.barred[:, None]
            both = softmax(np.concatenate([logits, pointed.reshape(len(said), -1)], axis=1))
            candidates = both[:, size:]
            probability = both.copy()
            probability[:, size:] = 0
            slots = np.repeat(memory.slots, beam, axis=0)
            np.add.at(probability, (np.arange(len(said))[:, None], slots), candidates)
        else:
            probability = softmax(logits)
        return Step(probability, candidates, attention, tuple(after))

    def positions(self, memory: Memory) -> Array:
        """Probabilities at each word of the equal-length layout. Shape (B, W, V)."""
        return softmax(memory.words @ self._output + self._output_bias)

    def _word(self, word: SourceWord) -> tuple[WordFeatures, Array, Array]:
        """Features of a word, its vector and those of its readings."""
        known = self._features.get(word)
        if known is None:
            features = self.vocabulary.features(word)
            readings = np.zeros((READINGS, self.config.embedding), np.float32)
            for place, key in enumerate(features.tag_keys):
                tag = self._tags.get(key)
                readings[place] = self._lemma[features.lemmas[place]] + (
                    self._by_parts(key) if tag is None else tag
                )
            form = self._form[features.form] + self._capital[features.capital]
            known = features, np.concatenate([form, (readings * self._rank).sum(axis=0)]), readings
            if len(self._features) < _CACHED_WORDS:
                self._features[word] = known
        return known

    def _bare(self, form: str) -> Array:
        """Vector of the root or a blank."""
        vector = self._form[self.vocabulary.form_index[form]] + self._capital[0]
        return np.concatenate([vector, np.zeros_like(vector)])

    def _by_parts(self, key: str) -> Array:
        places = [self._parts[part] for part in tag_parts(key) if part in self._parts]
        result: Array = self._part[places].sum(axis=0)
        return result

    def _slots(self, glosses: Sequence[str]) -> list[int]:
        size = len(self.vocabulary.glosses)
        first: dict[str, int] = {}
        return [
            self.vocabulary.gloss_index[gloss]
            if gloss in self.vocabulary.gloss_index
            else size + first.setdefault(gloss, place)
            for place, gloss in enumerate(glosses)
        ]

    def _first_states(self, words: Array) -> tuple[Array, ...]:
        if self.config.layout == "equal_length":
            return ()
        hidden = self.config.hidden
        last = words[:, -1, :hidden]
        if self.config.bidirectional:
            last = np.concatenate([last, words[:, 0, hidden:]], axis=1)
        start = np.tanh(last @ self._start + self._start_bias)
        states = []
        for layer in range(self.config.layers):
            own = start[:, layer * hidden : (layer + 1) * hidden]
            states.append(np.tile(own, (1, self._state_size // hidden)))
        return tuple(states)


def softmax(logits: Array) -> Array:
    """Probabilities along the last axis."""
    exponentials = np.exp(logits - logits.max(axis=-1, keepdims=True))
    result: Array = exponentials / exponentials.sum(axis=-1, keepdims=True)
    return result


def _candidates(features: Sequence[tuple[WordFeatures, Array, Array]]) -> tuple[str, ...]:
    """Glosses of all candidates, the root's first; the empty string where there is no reading."""
    glosses = [""] * READINGS
    for word, _, _ in features:
        glosses += [*word.copies, *[""] * (READINGS - len(word.copies))]
    return tuple(glosses)
