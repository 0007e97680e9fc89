"""Sentence models as files: weights in safetensors, and a card that says what they are and what made them."""

from __future__ import annotations

import dataclasses
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
from teo_sign_translator.model_card import read_card
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.decoding import ZooModel
from teo_sign_translator.pointer.vocabulary import Lexis
from teo_sign_translator.resources import models_directory

#: Of cards of sentence models; those of `model_store` have schema 1.
SCHEMA = 2


def sentence_models(directory: Path | None = None) -> tuple[str, ...]:
    """Names of the sentence models in a folder (by default the package's), sorted."""
    directory = directory or models_directory()
    return tuple(
        sorted(
            path.stem
            for path in directory.glob("*.safetensors")
            if path.with_suffix(".json").is_file() and _schema(path.with_suffix(".json")) == SCHEMA
        )
    )


def load_sentence_model(name: str, directory: Path | None = None) -> ZooModel:
    """Load a sentence model.

    Args:
        name: Of its two files.
        directory: Folder of the models; by default the package's.

    Raises:
        TranslationError: "unknown_model", or "invalid_model" if its files cannot be used.
    """
    directory = directory or models_directory()
    path = directory / f"{name}.safetensors"
    known = {each.stem for each in directory.glob("*.safetensors")}
    if name not in known:
        listed = ", ".join(sentence_models(directory)) or "none"
        raise TranslationError("unknown_model", f"expected a model of {directory} ({listed}), got '{name}'")
    card = load_sentence_card(name, directory)
    try:
        config = NetworkConfig(**card["network"])
        lexis = Lexis.from_dict(card["lexis"])
        weights = safetensors.numpy.load_file(path)
        return ZooModel(name, ArrayModel(config, lexis, weights))
    except (OSError, SafetensorError) as error:
        raise TranslationError("invalid_model", f"{path}: expected a safetensors file: {error}") from error
    except (KeyError, TypeError, AttributeError) as error:
        raise TranslationError("invalid_model", f"{path}: no usable card beside it: {error}") from error
    except TranslationError as error:
        raise TranslationError("invalid_model", f"{path}: {error}") from error


def load_sentence_card(name: str, directory: Path | None = None) -> dict[str, Any]:
    """The card of a model.

    Raises:
        TranslationError: "invalid_model" if it cannot be read or has another schema.
    """
    return read_card((directory or models_directory()) / f"{name}.json", SCHEMA)


def save_sentence_model(
    name: str,
    directory: Path,
    *,
    config: NetworkConfig,
    lexis: Lexis,
    weights: Mapping[str, NDArray[np.float32]],
    card: Mapping[str, Any],
) -> None:
    """Write weights, in half precision, and card.

    Args:
        name: Of the model and its two files.
        directory: Made if it is missing.
        config: Goes into the card.
        lexis: Likewise, in the order of the weights' rows.
        weights: As `ArrayModel` takes them.
        card: What else the card says.
    """
    halves = {key: value.astype(np.float16) for key, value in weights.items()}
    content = {
        "schema": SCHEMA,
        "name": name,
        **card,
        "network": dataclasses.asdict(config),
        "lexis": lexis.as_dict(),
    }
    directory.mkdir(parents=True, exist_ok=True)
    write_atomically(directory / f"{name}.safetensors", safetensors.numpy.save(halves))
    # One line: the lists hold thousands of words.
    write_atomically(directory / f"{name}.json", json.dumps(content, ensure_ascii=False).encode() + b"\n")


def _schema(path: Path) -> object:
    try:
        card = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return card.get("schema") if isinstance(card, dict) else None
