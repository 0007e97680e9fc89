# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Files of the models of the zoo, `pointer` among them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from teo_sign_translator.model_files import Weights, read_model, write_model
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.decoding import SentenceModel
from teo_sign_translator.pointer.vocabulary import Vocabulary

#: Of the cards of sentence models.
SCHEMA = 2
# Of a card: the lists that number the words and glosses.
_LISTS = "lexis"


def load_sentence_model(name: str, directory: Path | None = None) -> SentenceModel:
    """Load a sentence model; arguments and errors are those of `model_files.read_model`."""

    def build(card: dict[str, Any], weights: Weights) -> SentenceModel:
        vocabulary = Vocabulary.from_dict(card[_LISTS])
        return SentenceModel(name, ArrayModel(NetworkConfig(**card["network"]), vocabulary, weights))

    return read_model(name, SCHEMA, directory, build)


def save_sentence_model(
    name: str,
    directory: Path,
    *,
    config: NetworkConfig,
    vocabulary: Vocabulary,
    weights: Weights,
    card: Mapping[str, Any],
) -> None:
    """Write weights, in half precision, and card.

    Args:
        name: Of the model and its two files.
        directory: Made if it is missing.
        config: Goes into the card.
        vocabulary: Likewise, in the order of the weights' rows.
        weights: As `ArrayModel` takes them.
        card: What else the card says.
    """
    content = {**card, "network": dataclasses.asdict(config), _LISTS: vocabulary.as_dict()}
    write_model(name, directory, SCHEMA, weights, content, indent=None)
