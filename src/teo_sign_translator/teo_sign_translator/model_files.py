"""Models as files: weights in safetensors, and a card in JSON that says what they are and what made them."""

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
from teo_common.package_files import package_path
from teo_sign_translator.data_files import PACKAGE
from teo_sign_translator.errors import TranslationError

Weights = Mapping[str, NDArray[np.float32]]


def models_directory() -> Path:
    """Folder of the models that ship with the package."""
    return package_path(PACKAGE, "models")


def available_models(directory: Path | None = None, *, schema: int | None = None) -> tuple[str, ...]:
    """Names of the models in a folder, sorted.

    Args:
        directory: By default the package's.
        schema: Only models whose card has this schema; None for all.
    """
    directory = directory or models_directory()
    return tuple(
        sorted(
            path.stem
            for path in directory.glob("*.safetensors")
            if path.with_suffix(".json").is_file() and schema in (None, _schema(path.with_suffix(".json")))
        )
    )


def read_card(path: Path, schema: int) -> dict[str, Any]:
    """The card in a file.

    Raises:
        TranslationError: "invalid_model" if it cannot be read or has another schema.
    """
    try:
        card = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise TranslationError("invalid_model", f"{path}: expected a model card in JSON: {error}") from error
    if not isinstance(card, dict) or card.get("schema") != schema:
        raise TranslationError("invalid_model", f"{path}: expected a model card of schema {schema}")
    return card


def read_weights(path: Path) -> dict[str, NDArray[Any]]:
    """The weights in a file, by name.

    Raises:
        TranslationError: "invalid_model" if it cannot be read.
    """
    try:
        weights: dict[str, NDArray[Any]] = safetensors.numpy.load_file(path)
    except (OSError, SafetensorError) as error:
        raise TranslationError("invalid_model", f"{path}: expected a safetensors file: {error}") from error
    return weights


def write_model(
    name: str, directory: Path, weights: Weights, card: Mapping[str, Any], indent: int | None
) -> None:
    """Write weights, in half precision, and card.

    Args:
        name: Of the model and its two files.
        directory: Made if it is missing.
        weights: By name.
        card: Its schema is the first entry.
        indent: Of the JSON; None for one line, where lists hold thousands of words.
    """
    directory.mkdir(parents=True, exist_ok=True)
    halves = {key: value.astype(np.float16) for key, value in weights.items()}
    write_atomically(directory / f"{name}.safetensors", safetensors.numpy.save(halves))
    text = json.dumps(card, ensure_ascii=False, indent=indent)
    write_atomically(directory / f"{name}.json", text.encode() + b"\n")


def _schema(path: Path) -> object:
    try:
        card = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return card.get("schema") if isinstance(card, dict) else None
