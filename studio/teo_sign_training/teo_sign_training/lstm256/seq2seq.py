# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The published encoder-decoder LSTM on plain arrays: its tokens, its inference, its files."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from teo_common.text_folding import fold
from teo_sign_training.corpus.paper_pairs import SLOTS
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import Weights, read_model, write_model
from teo_sign_translator.pointer.array_model import Array, LstmLayer, softmax
from teo_sign_translator.pointer.config import check_weights
from teo_sign_translator.text.cleaning import clean

#: Ends and begins every output sequence; always the first two of an output vocabulary.
END = "<end>"
START = "<start>"
#: Marks that are tokens of their own.
MARKS = ("?", "!")

_TOKEN = re.compile("|".join([*map(re.escape, SLOTS), r"\w+", "[?!]"]))


def published_tokens(sentence: str) -> tuple[str, ...]:
    """Tokens as in the paper: words in lower case with their accents, `!` and `?` tokens of their own.

    Opening marks, commas and points are left out: `"¿Qué tal?"` is `qué tal ?`.
    """
    return tuple(_TOKEN.findall(clean(sentence).text.lower()))


def folded_tokens(sentence: str) -> tuple[str, ...]:
    """The same without accents (`ñ` stays), which makes one token of all ways of typing a word."""
    return tuple(token if token in SLOTS else fold(token) for token in published_tokens(sentence))


def mark_variants(tokens: tuple[str, ...]) -> list[tuple[str, ...]]:
    """The same sentence with its marks typed in every likely way: as given, left out, or others."""
    inner = tokens[:-1] if tokens[-1:] and tokens[-1] in MARKS else tokens
    bare = tuple(token for token in inner if token not in MARKS)
    return list(
        dict.fromkeys([tokens, *((*body, *end) for body in (bare, inner) for end in ((), ("?",), ("!",)))])
    )


class TokenList:
    """An ordered set of tokens."""

    def __init__(self, tokens: Sequence[str]) -> None:
        """Number the tokens from 0.

        Raises:
            TranslationError: "invalid_model" if a token occurs twice or there is none.
        """
        self.tokens = tuple(tokens)
        self._index = {token: index for index, token in enumerate(self.tokens)}
        if not self.tokens or len(self._index) != len(self.tokens):
            raise TranslationError("invalid_model", "expected a vocabulary of one or more tokens, each once")

    @classmethod
    def of_inputs(cls, sequences: Iterable[Sequence[str]]) -> TokenList:
        """The vocabulary of input sequences, sorted."""
        return cls(sorted({token for sequence in sequences for token in sequence}))

    @classmethod
    def of_outputs(cls, sequences: Iterable[Sequence[str]]) -> TokenList:
        """The vocabulary of output sequences: END, START, then the tokens sorted."""
        return cls([END, START, *sorted({token for sequence in sequences for token in sequence})])

    def __len__(self) -> int:
        return len(self.tokens)

    def __contains__(self, token: object) -> bool:
        return token in self._index

    def indices(self, tokens: Iterable[str]) -> list[int]:
        """The places of tokens.

        Raises:
            TranslationError: "unknown_token" for one that is not in the vocabulary.
        """
        try:
            return [self._index[token] for token in tokens]
        except KeyError as error:
            raise TranslationError(
                "unknown_token", f"expected a token of the vocabulary, got {error}"
            ) from None


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


#: Of the cards of this kind of model.
_SCHEMA = 1


def load_model(name: str, directory: Path | None = None) -> LstmModel:
    """Load a model; arguments and errors are those of `model_files.read_model`."""
    return read_model(name, _SCHEMA, directory, _built)


def _built(card: dict[str, Any], weights: Weights) -> LstmModel:
    lists = card["vocabulary"]
    return LstmModel(TokenList(lists["input"]), TokenList(lists["output"]), weights)


def save_model(
    name: str,
    directory: Path,
    *,
    inputs: TokenList,
    outputs: TokenList,
    weights: Weights,
    card: Mapping[str, Any],
) -> None:
    """Write weights, in half precision, and card.

    Args:
        name: Of the model and its two files.
        directory: Made if it is missing.
        inputs: Goes into the card, in the order of the weights' columns.
        outputs: Likewise.
        weights: As `LstmModel` takes them.
        card: What else the card says.
    """
    lists = {"input": list(inputs.tokens), "output": list(outputs.tokens)}
    write_model(name, directory, _SCHEMA, weights, {**card, "vocabulary": lists}, indent=2)
