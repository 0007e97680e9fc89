# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The published model's files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from teo_sign_training.lstm256.seq2seq import LstmModel
from teo_sign_training.lstm256.tokens import TokenList
from teo_sign_translator.model_files import Weights, read_model, write_model

#: Of the cards of this kind of model.
SCHEMA = 1


def load_model(name: str, directory: Path | None = None) -> LstmModel:
    """Load a model; arguments and errors are those of `model_files.read_model`."""
    return read_model(name, SCHEMA, directory, _built)


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
    write_model(name, directory, SCHEMA, weights, {**card, "vocabulary": lists}, indent=2)
