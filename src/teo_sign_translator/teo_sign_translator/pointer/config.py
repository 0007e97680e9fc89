# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a network is built, and the weights that it then has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.vocabulary import READINGS, Vocabulary

Cell = Literal["rnn", "gru", "lstm"]
Layout = Literal["equal_length", "encoder_decoder"]


@dataclass(frozen=True, kw_only=True, slots=True)
class NetworkConfig:
    """The shape of a network.

    Attributes:
        cell: Recurrent unit: simple (Elman) RNN, GRU or LSTM.
        layers: Recurrent layers on each other, in the encoder and in the decoder.
        layout: Many to many: `equal_length` says one gloss, or nothing more, at each word; `encoder_decoder`
            reads all words first.
        bidirectional: Whether the words are read from both ends.
        attention: Whether each gloss looks back at the words.
        copy: Whether a word's lemma can be carried over as a gloss; needs attention.
        hidden: Units of each recurrent layer and direction. 160 keep a short sentence under 3 ms on one
            core, and the training on 200,000 pairs under an hour on two.
        embedding: Size of each embedding.
        members: Networks of this shape, from other seeds, whose probabilities are averaged.
    """

    cell: Cell = "lstm"
    layers: int = 1
    layout: Layout = "encoder_decoder"
    bidirectional: bool = False
    attention: bool = False
    copy: bool = False
    hidden: int = 160
    embedding: int = 96
    members: int = 1

    def __post_init__(self) -> None:
        """Refuse shapes that cannot be built."""
        problems = [
            f"cell of {get_args(Cell)}" if self.cell not in get_args(Cell) else "",
            f"layout of {get_args(Layout)}" if self.layout not in get_args(Layout) else "",
            "layers, hidden, embedding and members of at least 1"
            if min(self.layers, self.hidden, self.embedding, self.members) < 1
            else "",
            "attention only with encoder_decoder" if self.attention and self.layout == "equal_length" else "",
            "copy only with attention" if self.copy and not self.attention else "",
        ]
        refuse(problems, self)


def refuse(problems: list[str], config: object) -> None:
    """Refuse a configuration that has problems; an empty text is none.

    Raises:
        TranslationError: "invalid_config", naming them.
    """
    expected = ", ".join(filter(None, problems))
    if expected:
        raise TranslationError("invalid_config", f"expected {expected}, got {config}")


#: The model that translates unseen sentences: attention and copying over words read from both ends.
POINTER = "pointer"

_GATES = {"rnn": 1, "gru": 3, "lstm": 4}


def weight_shapes(config: NetworkConfig, vocabulary: Vocabulary) -> dict[str, tuple[int, ...]]:
    """Shape of each weight by its name in `Network`."""
    size, hidden = config.embedding, config.hidden
    memory = hidden * (1 + config.bidirectional)
    glosses = len(vocabulary.glosses)
    shapes: dict[str, tuple[int, ...]] = {
        "form.weight": (len(vocabulary.forms), size),
        "capital.weight": (2, size),
        "lemma.weight": (len(vocabulary.lemmas), size),
        "tag.weight": (len(vocabulary.tags), size),
        "part": (len(vocabulary.parts), size),
        "rank": (READINGS, size),
    }
    for layer in range(config.layers):
        for direction in ("", "_reverse")[: 1 + config.bidirectional]:
            inputs = 2 * size if layer == 0 else memory
            shapes |= _recurrent(config, "encoder", f"l{layer}{direction}", inputs)
    if config.layout == "equal_length":
        return shapes | _linear("output", memory, glosses)
    for layer in range(config.layers):
        shapes |= _recurrent(config, "decoder", f"l{layer}", size if layer == 0 else hidden)
    shapes |= {"said.weight": (glosses, size)}
    shapes |= _linear("start", memory, hidden * config.layers) | _linear("output", hidden, glosses)
    if config.attention:
        shapes |= _linear("key", memory, hidden) | _linear("readout", hidden + memory, hidden)
    if config.copy:
        shapes |= _linear("copy_memory", memory, hidden) | _linear("said_memory", memory, size)
        shapes |= {"copy_reading.weight": (hidden, size), "said_reading.weight": (size, size)}
    return shapes


def check_weights(shapes: Mapping[str, tuple[int, ...]], weights: Mapping[str, NDArray[np.floating]]) -> None:
    """Refuse weights that do not have the shapes.

    Raises:
        TranslationError: "invalid_model" if a weight is missing, has another shape or is not finite.
    """
    for name, shape in shapes.items():
        if name not in weights or weights[name].shape != shape or not np.isfinite(weights[name]).all():
            got = f"shape {weights[name].shape}" if name in weights else "none"
            raise TranslationError(
                "invalid_model", f"expected finite weights '{name}' of shape {shape}, got {got}"
            )


def _recurrent(config: NetworkConfig, part: str, suffix: str, inputs: int) -> dict[str, tuple[int, ...]]:
    gates = _GATES[config.cell] * config.hidden
    return {
        f"{part}.weight_ih_{suffix}": (gates, inputs),
        f"{part}.weight_hh_{suffix}": (gates, config.hidden),
        f"{part}.bias_ih_{suffix}": (gates,),
        f"{part}.bias_hh_{suffix}": (gates,),
    }


def _linear(name: str, inputs: int, outputs: int) -> dict[str, tuple[int, ...]]:
    return {f"{name}.weight": (outputs, inputs), f"{name}.bias": (outputs,)}
