# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which weights a network of a configuration has."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.vocabulary import READINGS, Vocabulary

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
