# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Plain content, of JSON or YAML, taken as a type of `msgspec`; what does not fit is named by its place."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import repeat
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin

import msgspec
import yaml

Content = TypeVar("Content", bound=msgspec.Struct)

# Characters of a wrong value that are shown.
_SHOWN = 80
# Most bytes of a YAML file: 75 times those of the longest that comes with the packages.
_MOST_BYTES = 1_000_000

#: A key of a mapping, or an index of a list.
Step = str | int


class ContentError(ValueError):
    """Content that is not of its type; its text says what was expected there and what came.

    Attributes:
        code: "missing_field", "unknown_field", "bad_type", or "bad_value" for one of the right type.
        way: Keys and indices that lead there; a missing or unknown field is the last.
        expected: What was expected.
        got: What came.
    """

    def __init__(self, code: str, way: tuple[Step, ...], expected: str, got: str, message: str) -> None:
        """Keep the parts beside the sentence."""
        super().__init__(message)
        self.code = code
        self.way = way
        self.expected = expected
        self.got = got


class YamlError(ValueError):
    """A file that cannot be used; its text says which, where, what was expected and what came.

    Attributes:
        field: Path of the wrong field, such as "hand.palm"; empty where the whole file is to blame.
    """

    def __init__(self, message: str, field: str = "") -> None:
        """Keep the field beside the sentence."""
        super().__init__(message)
        self.field = field


def converted(content: Any, kind: type[Content]) -> Content:
    """Take content as a type.

    Args:
        content: Of mappings, lists and plain values.
        kind: Of structs, mappings, lists, tuples and plain values, each optional at most.

    Raises:
        ContentError: The content does not hold that.
    """
    try:
        return msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        raise _first_fault(content, kind, error, ()) from error


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
        return converted(content, kind)
    except ContentError as error:
        field = ".".join(map(str, error.way))
        raise YamlError(": ".join(filter(None, (str(path), field, str(error)))), field) from error


def _first_fault(
    value: Any, kind: Any, error: msgspec.ValidationError, way: tuple[Step, ...]
) -> ContentError:
    """The first part that does not fit; the path that msgspec gives lacks the keys of mappings."""
    kind = _plain(kind)
    for step, part, part_kind in _parts(value, kind):
        try:
            msgspec.convert(part, part_kind)
        except msgspec.ValidationError as part_error:
            return _first_fault(part, part_kind, part_error, (*way, step))
    said = str(error).partition(" - at `")[0]
    missing = re.match(r"Object missing required field `(.+)`", said)
    if missing is not None:
        return ContentError("missing_field", (*way, missing[1]), "the field", "no such field", said)
    unknown = re.match(r"Object contains unknown field `(.+)`", said)
    if unknown is not None:
        names = ", ".join(field.encode_name for field in msgspec.structs.fields(kind))
        return ContentError("unknown_field", (*way, unknown[1]), f"one of {names}", repr(unknown[1]), said)
    got = f"{value!r:.{_SHOWN}}"
    if isinstance(value, dict) and ", got" not in said:  # a rule of the struct
        return ContentError("bad_value", way, said, got, said)
    sentence, _, other_type = said.partition(", got")
    if get_origin(kind) is Literal:
        sentence = f"expected {' or '.join(map(repr, get_args(kind)))}"
    elif isinstance(value, float) and not math.isfinite(value):
        sentence = "expected a finite number"
    code = "bad_type" if other_type else "bad_value"
    expected = re.sub("^[Ee]xpected ", "", sentence)
    return ContentError(code, way, expected, got, f"{sentence}; got {got}")


def _plain(kind: Any) -> Any:
    """A type without its bounds, and without the None that it may be."""
    while get_origin(kind) in (Annotated, Union, UnionType):
        kind = next(part for part in get_args(kind) if part is not NoneType)
    return kind


def _parts(value: Any, kind: Any) -> Iterator[tuple[Step, Any, Any]]:
    """Step, value and type of each part of a value that has the form of its type; keys are parts too."""
    origin, of = get_origin(kind), get_args(kind)
    if isinstance(value, dict) and origin is dict:
        for key, part in value.items():
            yield str(key), key, of[0]
            yield str(key), part, of[1]
    elif isinstance(value, dict) and isinstance(kind, type) and issubclass(kind, msgspec.Struct):
        yield from ((str(key), key, str) for key in value)
        for field in msgspec.structs.fields(kind):
            if field.encode_name in value:
                yield field.encode_name, value[field.encode_name], field.type
    elif isinstance(value, list) and origin in (list, tuple):
        kinds = of if origin is tuple and of[-1] is not Ellipsis else repeat(of[0])
        yield from ((index, *part) for index, part in enumerate(zip(value, kinds, strict=False)))
