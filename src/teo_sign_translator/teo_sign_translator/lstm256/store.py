"""Models as files: weights in safetensors, and a card that says what they are and what made them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import safetensors.numpy
from numpy.typing import NDArray
from safetensors import SafetensorError

from teo_common.atomic_files import write_atomically
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.lstm256.seq2seq import LstmModel
from teo_sign_translator.lstm256.vocabulary import Vocabulary
from teo_sign_translator.model_card import read_card
from teo_sign_translator.pointer.zoo import POINTER
from teo_sign_translator.resources import models_directory

#: Of the models that ship: translates sentences that it has not seen.
DEFAULT_MODEL = POINTER

_SCHEMA = 1


def available_models(directory: Path | None = None) -> tuple[str, ...]:
    """Names of the models in a folder (by default the package's), sorted."""
    directory = directory or models_directory()
    return tuple(
        sorted(path.stem for path in directory.glob("*.safetensors") if path.with_suffix(".json").is_file())
    )


def load_model(name: str, directory: Path | None = None) -> LstmModel:
    """Load a model.

    Args:
        name: One of `available_models`.
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
    try:
        weights = safetensors.numpy.load_file(path)
        return LstmModel(
            Vocabulary(card["vocabulary"]["input"]), Vocabulary(card["vocabulary"]["output"]), weights
        )
    except (OSError, SafetensorError) as error:
        raise TranslationError("invalid_model", f"{path}: expected a safetensors file: {error}") from error
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
    return read_card((directory or models_directory()) / f"{name}.json", _SCHEMA)


def save_model(
    name: str,
    directory: Path,
    *,
    inputs: Vocabulary,
    outputs: Vocabulary,
    weights: Mapping[str, NDArray[np.float32]],
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
    halves = {key: value.astype(np.float16) for key, value in weights.items()}
    content = {
        "schema": _SCHEMA,
        "name": name,
        **card,
        "vocabulary": {"input": list(inputs.tokens), "output": list(outputs.tokens)},
    }
    directory.mkdir(parents=True, exist_ok=True)
    write_atomically(directory / f"{name}.safetensors", safetensors.numpy.save(halves))
    text = json.dumps(content, ensure_ascii=False, indent=2)
    write_atomically(directory / f"{name}.json", text.encode() + b"\n")
