# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recurrent layers on plain arrays, with PyTorch's weights and gate orders."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from teo_sign_translator.pointer.config import Cell

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


class RnnLayer(Layer):
    """Elman's: h' = tanh(W x + U h + b)."""

    def step(self, projected: Array, state: Array) -> Array:
        """See `Layer`; the state is h."""
        result: Array = np.tanh(projected + state @ self._recurrent)
        return result


class GruLayer(Layer):
    """Cho's, gates in the order reset, update, new; the reset gate acts on U h + b as in PyTorch."""

    def project(self, inputs: Array) -> Array:
        """See `Layer`."""
        return inputs @ self._input + self._input_bias

    def step(self, projected: Array, state: Array) -> Array:
        """See `Layer`; the state is h."""
        size = self._hidden
        recurrent = state @ self._recurrent + self._recurrent_bias
        gates = sigmoid(projected[:, : 2 * size] + recurrent[:, : 2 * size])
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
    "rnn": RnnLayer,
    "gru": GruLayer,
    "lstm": LstmLayer,
}


def make_layer(cell: Cell, weights: Mapping[str, Array], prefix: str, suffix: str) -> Layer:
    """The layer of a kind of cell."""
    return _LAYERS[cell](weights, prefix, suffix)


def sigmoid(values: Array) -> Array:
    """1 / (1 + exp(-x)), without overflow."""
    result: Array = 0.5 * np.tanh(0.5 * values) + 0.5
    return result


def run_layer(layer: Layer, inputs: Array, state_size: int, hidden: int, *, backwards: bool) -> Array:
    """Outputs of a layer at every word, from a state of zeros. Shape (B, W, inputs) -> (B, W, hidden)."""
    count, length = inputs.shape[:2]
    projected = layer.project(inputs).swapaxes(0, 1)
    state = np.zeros((count, state_size), np.float32)
    result = np.empty((count, length, hidden), np.float32)
    for place in reversed(range(length)) if backwards else range(length):
        state = layer.step(projected[place], state)
        result[:, place] = state[:, :hidden]
    return result
