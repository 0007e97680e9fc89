# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which glosses have signs: from a list, or from the entries of a look-up table."""

from __future__ import annotations

import json
from pathlib import Path

from teo_sign_translator.data_files import invalid_line, read_lines
from teo_sign_translator.errors import TranslationError
from teo_sign_translator.output.substitutes import SIGN_NAME

#: How well founded a sign may be, the best first, as the entries of a table name it.
STANDINGS = ("reviewed", "recorded", "measured", "described", "sketched")
#: The executor's default: what is only sketched is spelled.
LEAST_STANDING = "described"


def read_signs(path: Path, least_standing: str = LEAST_STANDING) -> frozenset[str]:
    """The glosses that have signs.

    Args:
        path: A file with one gloss on each line, or a folder of a table's entries (`HOLA.json`).
        least_standing: Of a folder's entries, which count: those at least as well founded.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    if path.is_dir():
        return _entries(path, least_standing)
    signs: set[str] = set()
    for line_number, line in read_lines(path):
        gloss = line.strip().upper()
        if not SIGN_NAME.fullmatch(gloss):
            raise invalid_line(path, line_number, "one gloss", f"'{line.strip()}'")
        signs.add(gloss)
    return frozenset(signs)


def listed_signs(file: str, least_standing: str = LEAST_STANDING) -> frozenset[str] | None:
    """The glosses of a file or folder that a parameter names; None if it names none.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    return read_signs(Path(file), least_standing) if file else None


def _entries(folder: Path, least_standing: str) -> frozenset[str]:
    """The glosses of a table's lexical entries; letters and numbers are no glosses."""
    if least_standing not in STANDINGS:
        raise TranslationError(
            "invalid_data", f"expected a standing of {', '.join(STANDINGS)}, got {least_standing!r}"
        )
    founded = STANDINGS[: STANDINGS.index(least_standing) + 1]
    signs: set[str] = set()
    files = sorted(folder.glob("*.json"))
    if not files:
        raise TranslationError("invalid_data", f"{folder}: expected entries of a table (*.json), got none")
    for file in files:
        try:
            entry = json.loads(file.read_text(encoding="utf-8"))
            gloss, kind, standing = entry["gloss"], entry["kind"], entry["provenance"]["standing"]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise TranslationError(
                "invalid_data",
                f"{file}: expected an entry of a table with gloss, kind and provenance.standing: {error!r}",
            ) from error
        if kind == "lexical" and standing in founded:
            signs.add(gloss)
    return frozenset(signs)
