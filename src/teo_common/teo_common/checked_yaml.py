# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""YAML files whose content is a `msgspec.Struct`, checked while they are read."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import repeat
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import msgspec
import yaml

Content = TypeVar("Content", bound=msgspec.Struct)

# Most bytes of a file: 75 times those of the longest that comes with the packages; more is no description.
_MOST_BYTES = 1_000_000

# Characters of a wrong value that are shown.
_SHOWN = 80


class YamlError(ValueError):
    """A file that cannot be used; its text says which, where, what was expected and what came.

    Attributes:
        field: Path of the wrong field, such as "hand.palm"; empty where the whole file is to blame.
    """

    def __init__(self, message: str, field: str = "") -> None:
        """Keep the field beside the sentence."""
        super().__init__(message)
        self.field = field


def read_checked_yaml(path: Path, kind: type[Content]) -> Content:
    """Read a file as a type.

    Args:
        path: The file.
        kind: What it holds, of structs, mappings, lists, tuples and plain values, each optional at most.

    Raises:
        YamlError: The file cannot be read, is no YAML in UTF-8, or does not hold that.
    """
    try:
        size = path.stat().st_size
        if size > _MOST_BYTES:
            raise YamlError(f"{path}: expected at most {_MOST_BYTES} bytes, got {size}")
        content: Any = yaml.load(path.read_text(encoding="utf-8"), Loader=yaml.CSafeLoader)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise YamlError(f"{path}: expected YAML in UTF-8: {error}") from error
    try:
        return msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        way, fault = _first_fault(content, kind, error)
        field = ".".join(way)
        raise YamlError(": ".join(filter(None, (str(path), field, fault))), field) from error


def _first_fault(value: Any, kind: Any, error: msgspec.ValidationError) -> tuple[tuple[str, ...], str]:
    """The way to what is wrong in a value, and what was expected and came there.

    The path that msgspec gives lacks the keys of mappings, so the parts are tried one by one.
    """
    kind = _plain(kind)
    for name, part, part_kind in _parts(value, kind):
        try:
            msgspec.convert(part, part_kind)
        except msgspec.ValidationError as part_error:
            way, fault = _first_fault(part, part_kind, part_error)
            return (name, *way), fault
    expected = str(error).partition(" - at `")[0]
    named = re.match(r"Object (?:missing required|contains unknown) field `(.+)`", expected)
    if named is not None:
        return (named[1],), expected
    if isinstance(value, dict):
        return (), expected
    if get_origin(kind) is Literal:
        expected = f"expected {' or '.join(map(repr, get_args(kind)))}"
    elif isinstance(value, float) and not math.isfinite(value):
        expected = "expected a finite number"
    return (), f"{expected.partition(', got')[0]}; got {value!r:.{_SHOWN}}"


def _plain(kind: Any) -> Any:
    """A type without its bounds, and without the None that it may be."""
    while get_origin(kind) in (Annotated, Union, UnionType):
        kind = next(part for part in get_args(kind) if part is not NoneType)
    return kind


def _parts(value: Any, kind: Any) -> Iterator[tuple[str, Any, Any]]:
    """Name, value and type of each part of a value that has the form of its type; keys are parts too."""
    origin, of = get_origin(kind), get_args(kind)
    if isinstance(value, dict) and origin is dict:
        for key, part in value.items():
            yield str(key), key, of[0]
            yield str(key), part, of[1]
    elif isinstance(value, dict) and isinstance(kind, type) and issubclass(kind, msgspec.Struct):
        yield from ((str(key), key, str) for key in value)
        for name, part_kind in get_type_hints(kind, include_extras=True).items():
            if name in value:
                yield name, value[name], part_kind
    elif isinstance(value, list) and origin in (list, tuple):
        kinds = of if origin is tuple and of[-1] is not Ellipsis else repeat(of[0])
        yield from ((str(index), *part) for index, part in enumerate(zip(value, kinds, strict=False)))
