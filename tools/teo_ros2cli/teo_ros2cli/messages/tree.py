# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A message as a tree of plain values, as a line of comma-separated ones, and as YAML.

A scalar that is read keeps the text that was typed beside the value that YAML gives it. So a string field
takes `12:30` or `no` as written, where YAML 1.1 alone would make 750 and False of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import yaml
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


_EVERYTHING = Abridgement()


def message_tree(message: Any, abridgement: Abridgement = _EVERYTHING) -> dict[str, Any]:
    """Return a message as dicts, lists, strings and numbers, fields in the order of the definition."""
    tree: dict[str, Any] = {}
    fields = message.get_fields_and_field_types()
    for (name, type_text), kind in zip(fields.items(), message.SLOT_TYPES, strict=False):
        value = getattr(message, name)
        if abridgement.no_sequences and isinstance(kind, AbstractNestedType):
            tree[name] = _sequence_note(type_text, kind, len(value))
        else:
            tree[name] = _value_tree(value, abridgement)
    return tree


def _value_tree(value: Any, abridgement: Abridgement = _EVERYTHING) -> Any:
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
        return [*_value_tree(value[:limit], abridgement), "..."]
    if hasattr(value, "tolist"):  # array.array and numpy: numbers only
        return value.tolist()
    return [_value_tree(item, abridgement) for item in value]


def _cut(text: str, limit: int | None) -> str:
    return text if limit is None or len(text) <= limit else text[:limit] + "..."


def _sequence_note(type_text: str, kind: AbstractNestedType, length: int) -> str:
    if isinstance(kind, AbstractSequence):
        element = type_text.removeprefix("sequence<").removesuffix(">").split(", ")[0]
        return f"<sequence type: {element}, length: {length}>"
    return f"<array type: {type_text}>"


def message_csv(message: Any, abridgement: Abridgement = _EVERYTHING) -> str:
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


try:
    from yaml import CSafeDumper as _Dumper
except ImportError:  # PyYAML without its C part: the same text, slower
    from yaml import SafeDumper as _Dumper  # type: ignore[assignment]

_UNICODE_BREAKS = "\x85\u2028\u2029"

# The C emitter takes a C int.
_NO_WRAPPING = 2**31 - 1


@dataclass(frozen=True)
class Scalar:
    """A scalar of a YAML text: its value by YAML's own rules, and the characters it was written with."""

    value: Any
    text: str


class _Loader(yaml.SafeLoader):
    """A safe loader whose scalars that are not strings are `Scalar` objects."""


def _construct_scalar(loader: _Loader, node: yaml.ScalarNode) -> Any:
    constructor = yaml.SafeLoader.yaml_constructors[node.tag]
    return Scalar(constructor(loader, node), str(node.value))


def _construct_equals(_loader: _Loader, node: yaml.ScalarNode) -> str:
    return str(node.value)  # a lone `=` has a tag of its own in YAML 1.1, which PyYAML cannot construct


_Loader.add_constructor("tag:yaml.org,2002:value", _construct_equals)
for _tag in ("null", "bool", "int", "float", "timestamp", "binary"):
    _Loader.add_constructor(f"tag:yaml.org,2002:{_tag}", _construct_scalar)


def parse(text: str) -> Any:
    """Read a YAML text into dicts, lists, strings and `Scalar` objects.

    Raises:
        Ros2CliError: `invalid_yaml`, with the place of the fault.
    """
    try:
        return yaml.load(text, Loader=_Loader)  # a SafeLoader
    except yaml.YAMLError as error:
        raise Ros2CliError("invalid_yaml", f"The passed value is not valid YAML: {error}") from error
    except (ValueError, OverflowError, RecursionError, TypeError) as error:
        # PyYAML lets a few through: an impossible date, a key that is a list, nesting without an end.
        raise Ros2CliError("invalid_yaml", f"The passed value is not valid YAML: {error}") from error


def plain(tree: Any) -> Any:
    """Return a parsed tree with each `Scalar` replaced by its value."""
    if isinstance(tree, Scalar):
        return tree.value
    if isinstance(tree, dict):
        return {plain(key): plain(value) for key, value in tree.items()}
    if isinstance(tree, list):
        return [plain(value) for value in tree]
    return tree


def dump(tree: Any, *, flow_style: bool = False) -> str:
    """Write a tree of plain values as YAML: keys in their order, UTF-8 as it is, no line wrapped."""
    text = _dump(tree, flow_style, _Dumper)
    if "\\U" not in text:
        return text
    # The C emitter is four times as fast, but writes an emoji as its number; the other one writes the line
    # breaks of Unicode as they are, which come back as blanks.
    readable = _dump(tree, flow_style, yaml.SafeDumper)
    return text if any(character in readable for character in _UNICODE_BREAKS) else readable


def _dump(tree: Any, flow_style: bool, dumper: Any) -> str:
    text: str = yaml.dump(
        tree,
        Dumper=dumper,
        sort_keys=False,
        allow_unicode=True,
        width=_NO_WRAPPING,
        default_flow_style=flow_style,
    )
    return text
