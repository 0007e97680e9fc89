# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The encoder-decoder LSTM, evaluated with plain arrays: no training framework is needed to translate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_sign_training.lstm256.tokens import END, START, TokenList
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.array_model import Array, LstmLayer, softmax
from teo_sign_translator.pointer.config import check_weights

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


class LstmModel:
    """One LSTM layer reads one-hot words; another, from its state on, writes glosses through a softmax.

    Weights are named and laid out as in PyTorch: gates in the order input, forget, cell, output.
    """

    def __init__(
        self, inputs: TokenList, outputs: TokenList, weights: Mapping[str, NDArray[np.floating]]
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
        check_weights(shapes, weights)
        full: dict[str, Array] = {name: np.asarray(value, np.float32) for name, value in weights.items()}
        for part in ("encoder", "decoder"):
            full[f"{part}.bias_ih_l0"] = full[f"{part}.bias"]
            full[f"{part}.bias_hh_l0"] = np.zeros_like(full[f"{part}.bias"])
        self._encoder, self._decoder = (LstmLayer(full, part, "l0") for part in ("encoder", "decoder"))
        # First gates after each token, in its row: a one-hot input chooses one.
        self._read = self._encoder.project(np.eye(len(inputs), dtype=np.float32))
        self._said = self._decoder.project(np.eye(len(outputs), dtype=np.float32))
        self._output = np.ascontiguousarray(full["output.weight"].T)
        self._end, self._start = outputs.indices([END, START])
        self._output_bias = full["output.bias"].copy()
        self._output_bias[self._start] = -np.inf  # never said, only read
        self._hidden = hidden

    def predict(self, tokens: Sequence[str]) -> Prediction:
        """Translate, taking the likeliest gloss at each step.

        Raises:
            TranslationError: "unknown_token" for a token outside `inputs`, "empty_text" for none.
        """
        if not tokens:
            raise TranslationError("empty_text", "expected at least one token, got none")
        state = np.zeros((1, 2 * self._hidden), np.float32)
        for index in self.inputs.indices(tokens):
            state = self._encoder.step(self._read[[index]], state)
        token = self._start
        result: list[str] = []
        probabilities: list[float] = []
        while len(result) < MAX_OUTPUT:
            state = self._decoder.step(self._said[[token]], state)
            probability = softmax(state[0, : self._hidden] @ self._output + self._output_bias)
            token = int(probability.argmax())
            if token == self._end:
                return Prediction(tuple(result), tuple(probabilities), complete=True)
            result.append(self.outputs.tokens[token])
            probabilities.append(float(probability[token]))
        return Prediction(tuple(result), tuple(probabilities), complete=False)
