# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A YAML file of a language as dataclasses, a section each; every field is read as its type says."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import yaml

from teo_sign_translator.data_files import words_of
from teo_sign_translator.errors import TranslationError


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
    "tuple[str, ...]": words_of,
    "tuple[str, str]": _two,
    "frozenset[str]": lambda value: frozenset(words_of(value)),
    "frozenset[tuple[str, str]]": _pairs,
    "dict[str, str]": lambda value: {_text(word): _text(said) for word, said in value.items()},
    "dict[str, int]": lambda value: {_text(word): int(number) for word, number in value.items()},
    "re.Pattern[str]": lambda value: re.compile(value, re.IGNORECASE),
}
