"""Model cards: the JSON beside a model's weights that says what they are and what made them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from teo_sign_translator.errors import TranslationError


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
