"""Sentence models as files."""

from __future__ import annotations

from pathlib import Path

from teo_sign_translator.errors import TranslationError
from teo_sign_translator.neural.model import SentenceModel


def load_sentence_model(name: str, directory: Path | None = None) -> SentenceModel:
    """Load a sentence model.

    Args:
        name: Of its two files.
        directory: Folder of the models; by default the package's.

    Raises:
        TranslationError: "unknown_model", or "invalid_model" if its files cannot be used.
    """
    raise TranslationError("unknown_model", f"expected a model of {directory}, got '{name}'")
