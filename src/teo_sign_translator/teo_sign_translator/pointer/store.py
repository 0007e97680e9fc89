"""Files of the models of the zoo, `pointer` among them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.model_files import (
    Weights,
    available_models,
    models_directory,
    read_card,
    read_weights,
    write_model,
)
from teo_sign_translator.pointer.array_model import ArrayModel
from teo_sign_translator.pointer.config import NetworkConfig
from teo_sign_translator.pointer.decoding import ZooModel
from teo_sign_translator.pointer.vocabulary import Vocabulary

#: Of the cards of sentence models.
SCHEMA = 2
# Of a card: the lists that number the words and glosses.
_LISTS = "lexis"


def sentence_models(directory: Path | None = None) -> tuple[str, ...]:
    """Names of the sentence models in a folder (by default the package's), sorted."""
    return available_models(directory, schema=SCHEMA)


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
    weights = read_weights(path)
    try:
        config = NetworkConfig(**card["network"])
        vocabulary = Vocabulary.from_dict(card[_LISTS])
        return ZooModel(name, ArrayModel(config, vocabulary, weights))
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
    content = {
        "schema": SCHEMA,
        "name": name,
        **card,
        "network": dataclasses.asdict(config),
        _LISTS: vocabulary.as_dict(),
    }
    write_model(name, directory, weights, content, indent=None)
