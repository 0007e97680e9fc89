"""The published model's files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.lstm256.seq2seq import LstmModel
from teo_sign_translator.lstm256.tokens import Vocabulary
from teo_sign_translator.model_files import (
    Weights,
    available_models,
    models_directory,
    read_card,
    read_weights,
    write_model,
)

#: Of the cards of this kind of model.
SCHEMA = 1


def load_model(name: str, directory: Path | None = None) -> LstmModel:
    """Load a model.

    Args:
        name: One of `model_files.available_models`.
        directory: Folder of the models; by default the package's.

    Raises:
        TranslationError: "unknown_model", or "invalid_model" if its files cannot be used.
    """
    directory = directory or models_directory()
    if name not in available_models(directory):
        known = ", ".join(available_models(directory)) or "none"
        raise TranslationError("unknown_model", f"expected a model of {directory} ({known}), got '{name}'")
    card = load_card(name, directory)
    path = directory / f"{name}.safetensors"
    weights = read_weights(path)
    try:
        return LstmModel(
            Vocabulary(card["vocabulary"]["input"]), Vocabulary(card["vocabulary"]["output"]), weights
        )
    except (KeyError, TypeError) as error:
        raise TranslationError(
            "invalid_model", f"{path.with_suffix('.json')}: no usable vocabulary: {error}"
        ) from error
    except TranslationError as error:
        raise TranslationError(error.code, f"{path}: {error}") from error


def load_card(name: str, directory: Path | None = None) -> dict[str, Any]:
    """The card of a model.

    Raises:
        TranslationError: "invalid_model" if it cannot be read or has another schema.
    """
    return read_card((directory or models_directory()) / f"{name}.json", SCHEMA)


def save_model(
    name: str,
    directory: Path,
    *,
    inputs: Vocabulary,
    outputs: Vocabulary,
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
    content = {
        "schema": SCHEMA,
        "name": name,
        **card,
        "vocabulary": {"input": list(inputs.tokens), "output": list(outputs.tokens)},
    }
    write_model(name, directory, weights, content, indent=2)
