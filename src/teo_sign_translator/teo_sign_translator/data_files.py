# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The text side of a language: where its files are, and reading those with columns."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_sign_translator.errors import TranslationError


def data_file(name: str) -> Path:
    """Path of a file or folder of the text side of the default language; it need not be there."""
    return load_language(DEFAULT_LANGUAGE).text / name


def read_rows(path: Path, columns: int) -> Iterator[tuple[int, list[str]]]:
    """Yield line number (from 1) and columns of a tab-separated UTF-8 file; blank and `#` lines are skipped.

    Args:
        path: The file.
        columns: How many each line must have, none of them empty.

    Raises:
        TranslationError: "invalid_data" if the file cannot be read or a line has another number of columns.
    """
    for number, line in read_lines(path):
        fields = line.split("\t")
        if len(fields) != columns or not all(field.strip() for field in fields):
            raise invalid_line(
                path, number, f"{columns} columns separated by tabs, none empty", f"{len(fields)}"
            )
        yield number, [field.strip() for field in fields]


def read_lines(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line number (from 1) and text of a UTF-8 file; blank and `#` lines are skipped.

    Raises:
        TranslationError: "invalid_data" if the file cannot be read.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise TranslationError("invalid_data", f"{path}: expected a readable UTF-8 file: {error}") from error
    for number, line in enumerate(lines, start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield number, line


def read_listed(path: Path, valid: Callable[[str], bool], expected: str) -> dict[str, frozenset[str]]:
    """The words, separated by commas, of each key of a file with two columns.

    Args:
        path: The file.
        valid: Whether a word may be a key; no key stands twice.
        expected: What a key is, for messages.

    Raises:
        TranslationError: "invalid_data", with file and line.
    """
    found: dict[str, frozenset[str]] = {}
    for number, (key, listed) in read_rows(path, columns=2):
        if key in found or not valid(key):
            raise invalid_line(path, number, f"{expected}, once", f"'{key}'")
        words = [word.strip() for word in listed.split(",")]
        if not all(words):
            raise invalid_line(path, number, "words between the commas", f"'{listed}'")
        found[key] = frozenset(words)
    return found


def invalid_line(path: Path, number: int, expected: str, got: str) -> TranslationError:
    """The refusal of a line of a file."""
    return TranslationError("invalid_data", f"{path}, line {number}: expected {expected}, got {got}")


def words_of(text: str) -> tuple[str, ...]:
    """The words of a list that is written as one string."""
    return tuple(text.split())
