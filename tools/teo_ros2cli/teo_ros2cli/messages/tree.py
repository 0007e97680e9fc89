# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A message as a tree of plain values, and as a line of comma-separated ones."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from rosidl_parser.definition import AbstractNestedType, AbstractSequence

from teo_ros2cli.errors import Ros2CliError


class Abridgement(NamedTuple):
    """What to leave out of a printed message.

    Args:
        length: Longest sequence, string or bytes shown in full [elements]; None for no limit.
        no_sequences: Show the type and length of a sequence instead of its values.
        no_strings: Show the length of a string instead of the string.
    """

    length: int | None = None
    no_sequences: bool = False
    no_strings: bool = False


EVERYTHING = Abridgement()


def message_tree(message: Any, abridgement: Abridgement = EVERYTHING) -> dict[str, Any]:
    """Return a message as dicts, lists, strings and numbers, fields in the order of the definition."""
    tree: dict[str, Any] = {}
    fields = message.get_fields_and_field_types()
    for (name, type_text), kind in zip(fields.items(), message.SLOT_TYPES, strict=False):
        value = getattr(message, name)
        if abridgement.no_sequences and isinstance(kind, AbstractNestedType):
            tree[name] = _sequence_note(type_text, kind, len(value))
        else:
            tree[name] = value_tree(value, abridgement)
    return tree


def value_tree(value: Any, abridgement: Abridgement = EVERYTHING) -> Any:
    """Return one value of a message (a message, a sequence or a single value) as plain values."""
    if isinstance(value, bytes):
        return _cut(value.decode("latin-1"), abridgement.length)
    if isinstance(value, str):
        if abridgement.no_strings:
            return f"<string length: <{len(value)}>>"
        return _cut(value, abridgement.length)
    if isinstance(value, bool | int | float):
        return value
    if hasattr(value, "get_fields_and_field_types"):
        return message_tree(value, abridgement)
    limit = abridgement.length
    if limit is not None and len(value) > limit:
        return [*value_tree(value[:limit], abridgement), "..."]
    if hasattr(value, "tolist"):  # array.array and numpy: numbers only
        return value.tolist()
    return [value_tree(item, abridgement) for item in value]


def _cut(text: str, limit: int | None) -> str:
    return text if limit is None or len(text) <= limit else text[:limit] + "..."


def _sequence_note(type_text: str, kind: AbstractNestedType, length: int) -> str:
    if isinstance(kind, AbstractSequence):
        element = type_text.removeprefix("sequence<").removesuffix(">").split(", ")[0]
        return f"<sequence type: {element}, length: {length}>"
    return f"<array type: {type_text}>"


def message_csv(message: Any, abridgement: Abridgement = EVERYTHING) -> str:
    """Return all values of a message, nested ones too, separated by commas in the order of the definition."""
    return ",".join(_leaves(message_tree(message, abridgement)))


def _leaves(tree: Any) -> Iterator[str]:
    if isinstance(tree, dict):
        for value in tree.values():
            yield from _leaves(value)
    elif isinstance(tree, list):
        for value in tree:
            yield from _leaves(value)
    else:
        yield str(tree)


_STEP = re.compile(r"(\w+)((?:\[-?\d+\])*)")


def select(message: Any, path: str) -> Any:
    """Return a part of a message: `pose.position.x`, `points[0].positions`.

    Raises:
        Ros2CliError: `invalid_field`, naming the step that does not exist.
    """
    value = message
    steps = [step for step in path.split(".") if step]
    if not steps:
        raise Ros2CliError("invalid_field", f"Invalid field value '{path}'")
    for step in steps:
        match = _STEP.fullmatch(step)
        if match is None:
            raise Ros2CliError("invalid_field", f"Invalid field '{path}': '{step}' is not a field name")
        if match[1] not in getattr(value, "_fields_and_field_types", {}):
            raise Ros2CliError(
                "invalid_field",
                f"Invalid field '{path}': '{type(value).__name__}' object has no attribute '{match[1]}'",
            )
        value = getattr(value, match[1])
        for index in re.findall(r"-?\d+", match[2]):
            try:
                value = value[int(index)]
            except (IndexError, TypeError) as error:
                raise Ros2CliError(
                    "invalid_field", f"Invalid field '{path}': no element {index} there"
                ) from error
    return value
