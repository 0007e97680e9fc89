# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The text side of a language: where its files are, and reading their tables (TSV) and sections (YAML)."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

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


def read_sections(path: Path, kinds: Mapping[str, type[Any]]) -> dict[str, Any]:
    """The sections of a file.

    Args:
        path: The file.
        kinds: By section, the dataclass that it becomes. A text is a list of words where the dataclass has a
            tuple or a set.

    Raises:
        TranslationError: "invalid_data" naming file, section and field.
    """
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.CSafeLoader)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise TranslationError("invalid_data", f"{path}: expected readable YAML: {error}") from error
    if not isinstance(content, dict) or set(content) != set(kinds):
        raise TranslationError("invalid_data", f"{path}: expected the sections {', '.join(kinds)}")
    return {name: _section(kind, path, name, content[name]) for name, kind in kinds.items()}


def _section(kind: type[Any], path: Path, name: str, body: Any) -> Any:
    fields = {field.name: str(field.type) for field in dataclasses.fields(kind)}
    if not isinstance(body, dict) or set(body) != set(fields):
        got = sorted(body) if isinstance(body, dict) else type(body).__name__
        raise TranslationError("invalid_data", f"{path}: {name}: expected {sorted(fields)}, got {got}")
    values: dict[str, Any] = {}
    for field, written in fields.items():
        try:
            values[field] = _READERS[written](body[field])
        except (TypeError, ValueError, AttributeError, re.error) as error:
            raise TranslationError(
                "invalid_data", f"{path}: {name}: {field}: expected {written}, got {body[field]!r}: {error}"
            ) from error
    return kind(**values)


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError("no text")
    return value


def words_of(text: str) -> tuple[str, ...]:
    """The words of a list that is written as one string."""
    return tuple(text.split())


def _pairs(value: Any) -> frozenset[tuple[str, str]]:
    """Pairs written as a first word with the second ones behind it: `{que: tal hora}`."""
    return frozenset((first, second) for first, seconds in value.items() for second in words_of(seconds))


def _two(value: Any) -> tuple[str, str]:
    first, second = value
    return _text(first), _text(second)


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise TypeError("neither true nor false")
    return value


_READERS: dict[str, Callable[[Any], Any]] = {
    "str": _text,
    "bool": _flag,
    "float": float,
    "tuple[str, ...]": words_of,
    "tuple[str, str]": _two,
    "frozenset[str]": lambda value: frozenset(words_of(value)),
    "frozenset[tuple[str, str]]": _pairs,
    "dict[str, str]": lambda value: {_text(word): _text(said) for word, said in value.items()},
    "dict[str, int]": lambda value: {_text(word): int(number) for word, number in value.items()},
    "re.Pattern[str]": lambda value: re.compile(value, re.IGNORECASE),
}
