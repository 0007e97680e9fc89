# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""YAML as people type it on the command line, and as messages are printed.

A scalar keeps the text that was typed beside the value that YAML gives it, so that a string field takes
`12:30` or `no` as written, where YAML 1.1 alone would make 750 and False of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import yaml

from teo_ros2cli.errors import Ros2CliError

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
