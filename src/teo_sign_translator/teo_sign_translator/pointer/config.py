# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a network is built and how it is trained, and the zoo: the models that can be trained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
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
    """

    cell: Cell = "lstm"
    layers: int = 1
    layout: Layout = "encoder_decoder"
    bidirectional: bool = False
    attention: bool = False
    copy: bool = False
    hidden: int = 160
    embedding: int = 96

    def __post_init__(self) -> None:
        """Refuse shapes that cannot be built."""
        problems = [
            f"cell of {get_args(Cell)}" if self.cell not in get_args(Cell) else "",
            f"layout of {get_args(Layout)}" if self.layout not in get_args(Layout) else "",
            "layers, hidden and embedding of at least 1"
            if min(self.layers, self.hidden, self.embedding) < 1
            else "",
            "attention only with encoder_decoder" if self.attention and self.layout == "equal_length" else "",
            "copy only with attention" if self.copy and not self.attention else "",
        ]
        _refuse(problems, self)


@dataclass(frozen=True, kw_only=True, slots=True)
class TrainingConfig:
    """How a network is trained.

    Attributes:
        epochs: Most passes over the training pairs; three of 200,000 fit into that hour.
        patience: Epochs without a lower loss on the development pairs after which training ends.
        batch_size: Pairs per step.
        learning_rate: Highest step size of AdamW; rises over the first steps, then falls to zero in a line.
            0.003 trained without a jump of the loss.
        dropout: Part of each layer's input that is left out during training.
        rare_word: A word that occurs n times in the training pairs is shown as unknown with probability
            rare_word / (rare_word + n), so that words never seen are carried over too: a content word about
            every fifth time, a function word hardly ever.
        clean: Part of the pairs that is shown as written; the others as people type in haste
            (`training/typing_noise.py`).
        attention_weight: Weight of the loss by which attention follows the pairs' alignment.
        by_heart: Part of a pass that is pairs of the paper and the project, each repeated equally often:
            they are few, must be known by heart, and are exceptions to the grammar of the others.
        seed: Of initial weights, order, dropout and noise.
    """

    epochs: int = 3
    patience: int = 3
    batch_size: int = 128
    learning_rate: float = 0.003
    dropout: float = 0.15
    rare_word: float = 30.0
    clean: float = 0.4
    attention_weight: float = 0.3
    by_heart: float = 0.05
    seed: int = 2019

    def __post_init__(self) -> None:
        """Refuse values that cannot train anything."""
        problems = [
            "epochs, patience and batch_size of at least 1"
            if min(self.epochs, self.patience, self.batch_size) < 1
            else "",
            "learning_rate in (0, 1)" if not 0 < self.learning_rate < 1 else "",
            "dropout in [0, 1)" if not 0 <= self.dropout < 1 else "",
            "clean in [0, 1]" if not 0 <= self.clean <= 1 else "",
            "by_heart in [0, 1)" if not 0 <= self.by_heart < 1 else "",
            "rare_word and attention_weight of at least 0"
            if not min(self.rare_word, self.attention_weight) >= 0
            else "",
        ]
        _refuse(problems, self)


def _refuse(problems: list[str], config: object) -> None:
    expected = ", ".join(filter(None, problems))
    if expected:
        raise TranslationError("invalid_config", f"expected {expected}, got {config}")


#: The model that translates unseen sentences: attention and copying over words read from both ends.
POINTER = "pointer"

#: By name, from the simplest on. The first ones are the layouts of Figure 1 of arXiv:1907.04198, then its
#: future work. All read the same words and readings, so that a row of `compare` differs from the next by its
#: mechanism alone. The equal-length layout reads from both ends: its first gloss stands at the first word,
#: and may be said by the last.
ZOO = MappingProxyType(
    {
        "rnn_equal": NetworkConfig(cell="rnn", layout="equal_length", bidirectional=True),
        "lstm_equal": NetworkConfig(cell="lstm", layout="equal_length", bidirectional=True),
        "rnn": NetworkConfig(cell="rnn"),
        "gru": NetworkConfig(cell="gru"),
        "lstm": NetworkConfig(cell="lstm"),
        "lstm_stacked": NetworkConfig(cell="lstm", layers=2),
        "gru_attention": NetworkConfig(cell="gru", bidirectional=True, attention=True),
        "lstm_attention": NetworkConfig(cell="lstm", bidirectional=True, attention=True),
        "pointer_gru": NetworkConfig(cell="gru", bidirectional=True, attention=True, copy=True),
        POINTER: NetworkConfig(cell="lstm", bidirectional=True, attention=True, copy=True),
    }
)


def network_config(name: str) -> NetworkConfig:
    """The configuration of a model of the zoo.

    Raises:
        TranslationError: "unknown_model", with the names there are.
    """
    if name not in ZOO:
        raise TranslationError("unknown_model", f"expected a model of {', '.join(ZOO)}, got '{name}'")
    return ZOO[name]


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
