# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Models as files: weights in safetensors, and a card in JSON that says what they are and what made them."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import safetensors.numpy
from numpy.typing import NDArray
from safetensors import SafetensorError

from teo_common.atomic_files import write_atomically
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_translator.errors import TranslationError

Weights = Mapping[str, NDArray[np.float32]]
Model = TypeVar("Model")


def models_directory() -> Path:
    """Folder of the models of the default language."""
    return load_language(DEFAULT_LANGUAGE).models


def available_models(directory: Path | None = None) -> tuple[str, ...]:
    """Names of the models in a folder (by default the default language's), sorted."""
    weights = (directory or models_directory()).glob("*.safetensors")
    return tuple(sorted(path.stem for path in weights if path.with_suffix(".json").is_file()))


def read_card(name: str, directory: Path | None = None) -> dict[str, Any]:
    """The card of a model in a folder (by default the default language's).

    Raises:
        TranslationError: "unknown_model", with those that there are; "invalid_model" if it cannot be read.
    """
    directory = directory or models_directory()
    if directory / f"{name}.safetensors" not in directory.glob("*.safetensors"):
        known = ", ".join(available_models(directory)) or "none"
        raise TranslationError("unknown_model", f"expected a model of {directory} ({known}), got '{name}'")
    path = directory / f"{name}.json"
    try:
        card = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise TranslationError("invalid_model", f"{path}: expected a model card in JSON: {error}") from error
    if not isinstance(card, dict):
        raise TranslationError("invalid_model", f"{path}: expected a model card, got {type(card).__name__}")
    return card


def read_model(
    name: str, schema: int, directory: Path | None, build: Callable[[dict[str, Any], Weights], Model]
) -> Model:
    """Load a model.

    Args:
        name: Of its two files.
        schema: Of its card.
        directory: Folder of the models; by default the default language's.
        build: Makes the model of card and weights.

    Raises:
        TranslationError: "unknown_model", or "invalid_model" if its files cannot be used.
    """
    path = (directory or models_directory()) / f"{name}.safetensors"
    card = read_card(name, directory)
    try:
        if card.get("schema") != schema:
            raise TranslationError("invalid_model", f"expected a model card of schema {schema}")
        return build(card, safetensors.numpy.load_file(path))
    except (OSError, SafetensorError) as error:
        raise TranslationError("invalid_model", f"{path}: expected a safetensors file: {error}") from error
    except (KeyError, TypeError, AttributeError) as error:
        raise TranslationError("invalid_model", f"{path}: no usable card beside it: {error}") from error
    except TranslationError as error:
        raise TranslationError("invalid_model", f"{path}: {error}") from error


def write_model(
    name: str, directory: Path, schema: int, weights: Weights, card: Mapping[str, Any], indent: int | None
) -> None:
    """Write weights, in half precision, and card.

    Args:
        name: Of the model and its two files.
        directory: Made if it is missing.
        schema: Of the card.
        weights: By name.
        card: What else the card says.
        indent: Of the JSON; None for one line, where lists hold thousands of words.
    """
    directory.mkdir(parents=True, exist_ok=True)
    halves = {key: value.astype(np.float16) for key, value in weights.items()}
    write_atomically(directory / f"{name}.safetensors", safetensors.numpy.save(halves))
    text = json.dumps({"schema": schema, "name": name, **card}, ensure_ascii=False, indent=indent)
    write_atomically(directory / f"{name}.json", text.encode() + b"\n")
