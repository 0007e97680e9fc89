"""The encoder-decoder LSTM, evaluated with plain arrays: no training framework is needed to translate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.lstm256.tokens import END, START, Vocabulary

Array = NDArray[np.float32]

#: Longest output [tokens]; the longest of the training pairs has 5. Ends a model that never says END.
MAX_OUTPUT = 32


@dataclass(frozen=True, slots=True)
class Prediction:
    """A model's output for one sentence.

    Attributes:
        tokens: Glosses and slots, without END.
        probabilities: Of each token, given those before it, 0 to 1.
        complete: Whether the model itself ended the sentence.
    """

    tokens: tuple[str, ...]
    probabilities: tuple[float, ...]
    complete: bool


class SequenceModel(Protocol):
    """What the translator asks of a model."""

    @property
    def inputs(self) -> Vocabulary:
        """Tokens that the model reads."""

    def predict(self, tokens: Sequence[str]) -> Prediction:
        """Translate a sequence of at least one token of `inputs`."""


class LstmModel:
    """One LSTM layer reads one-hot words; another, from its state on, writes glosses through a softmax.

    Weights are named and laid out as in PyTorch: gates in the order input, forget, cell, output.
    """

    def __init__(
        self, inputs: Vocabulary, outputs: Vocabulary, weights: Mapping[str, NDArray[np.floating]]
    ) -> None:
        """Take over the weights.

        Args:
            inputs: Tokens of the encoder.
            outputs: Tokens of the decoder, END and START among them.
            weights: `encoder.weight_ih_l0` (4h, inputs), `encoder.weight_hh_l0` (4h, h) and `encoder.bias`
                (4h,), the same for `decoder`, `output.weight` (outputs, h) and `output.bias` (outputs,).

        Raises:
            TranslationError: "invalid_model" if a weight is missing, has another shape or is not finite.
        """
        self.inputs = inputs
        self.outputs = outputs
        hidden = weights["encoder.weight_hh_l0"].shape[-1] if "encoder.weight_hh_l0" in weights else 0
        shapes = {"output.weight": (len(outputs), hidden), "output.bias": (len(outputs),)}
        for part, size in (("encoder", len(inputs)), ("decoder", len(outputs))):
            shapes[f"{part}.weight_ih_l0"] = (4 * hidden, size)
            shapes[f"{part}.weight_hh_l0"] = (4 * hidden, hidden)
            shapes[f"{part}.bias"] = (4 * hidden,)
        for name, shape in shapes.items():
            if name not in weights or weights[name].shape != shape or not np.isfinite(weights[name]).all():
                got = f"shape {weights[name].shape}" if name in weights else "none"
                raise TranslationError(
                    "invalid_model", f"expected finite weights '{name}' of shape {shape}, got {got}"
                )
        self._encoder = _Layer(weights, "encoder")
        self._decoder = _Layer(weights, "decoder")
        self._weight: Array = np.ascontiguousarray(weights["output.weight"], dtype=np.float32)
        self._end, self._start = outputs.indices([END, START])
        self._bias: Array = weights["output.bias"].astype(np.float32)
        self._bias[self._start] = -np.inf  # never said, only read
        self._hidden = hidden

    def predict(self, tokens: Sequence[str]) -> Prediction:
        """Translate, taking the likeliest gloss at each step.

        Raises:
            TranslationError: "unknown_token" for a token outside `inputs`, "empty_text" for none.
        """
        if not tokens:
            raise TranslationError("empty_text", "expected at least one token, got none")
        state = (np.zeros(self._hidden, np.float32), np.zeros(self._hidden, np.float32))
        for index in self.inputs.indices(tokens):
            state = self._encoder.step(index, state)
        token = self._start
        result: list[str] = []
        probabilities: list[float] = []
        while len(result) < MAX_OUTPUT:
            state = self._decoder.step(token, state)
            logits = self._weight @ state[0] + self._bias
            exponentials = np.exp(logits - logits.max())
            token = int(exponentials.argmax())
            if token == self._end:
                return Prediction(tuple(result), tuple(probabilities), complete=True)
            result.append(self.outputs.tokens[token])
            probabilities.append(float(exponentials[token] / exponentials.sum()))
        return Prediction(tuple(result), tuple(probabilities), complete=False)


class _Layer:
    """One LSTM layer with one-hot input, which is a choice of one column of its input weights."""

    def __init__(self, weights: Mapping[str, NDArray[np.floating]], part: str) -> None:
        columns = weights[f"{part}.weight_ih_l0"].astype(np.float32).T
        self._input: Array = np.ascontiguousarray(columns + weights[f"{part}.bias"].astype(np.float32))
        self._recurrent: Array = np.ascontiguousarray(weights[f"{part}.weight_hh_l0"], dtype=np.float32)

    def step(self, index: int, state: tuple[Array, Array]) -> tuple[Array, Array]:
        """One step: hidden and cell state (h,), each, after reading the token with this index."""
        hidden, cell = state
        gates = self._input[index] + self._recurrent @ hidden
        size = len(hidden)
        kept = _sigmoid(gates[: 2 * size])
        cell = kept[size:] * cell + kept[:size] * np.tanh(gates[2 * size : 3 * size])
        return _sigmoid(gates[3 * size :]) * np.tanh(cell), cell


def _sigmoid(values: Array) -> Array:
    # Through tanh, which does not overflow.
    result: Array = np.float32(0.5) * (np.float32(1) + np.tanh(np.float32(0.5) * values))
    return result
