# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Definitions of interfaces from the installed files, and their hashes. Needs no ROS running.

A definition is given in two forms: as it is shown to people, nested types expanded, and as one text with all
that it depends on, the `ros2msg` schema encoding of MCAP: the text of the message first, then each dependency
once, after a line of 80 equals signs and a line `MSG: package/Type` (MCAP specification, registry of
well-known schema encodings).
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import NamedTuple

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import InterfaceName, interface_file, package_prefix

SEPARATOR = "=" * 80
_FEEDBACK = "_FeedbackMessage"
# Parts the sections of a service or action definition.
_SECTION = "---"

_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_BASIC = {"bool", "byte", "char", "float32", "float64", "string", "wstring", *_INTEGERS}
# A field or constant: type, optional array part, name. The type of a bounded string holds `<=`.
_FIELD = re.compile(r"^\s*([A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?\s+[A-Za-z]\w*")


def referenced_types(text: str, package: str) -> Iterator[InterfaceName]:
    """Yield the message types of the fields of a definition, in order, repeats included.

    Args:
        text: The definition, comments and all.
        package: Package that it belongs to: types without a package are of this one.
    """
    for line in text.splitlines():
        match = _FIELD.match(line.split("#", 1)[0])
        if match is None or match[1] in _BASIC:
            continue
        parts = match[1].split("/")
        if len(parts) == 1:
            # `Header` alone is the one type that ROS 1 let people write without its package.
            yield InterfaceName("std_msgs" if parts[0] == "Header" else package, "msg", parts[0])
        else:
            yield InterfaceName(parts[0], "msg", parts[-1])


def definition_lines(name: InterfaceName, *, comments: bool, nested_comments: bool) -> Iterator[str]:
    """Yield the lines of an interface's definition, after each field of a message type the lines of that.

    Args:
        name: The interface.
        comments: Keep comments and empty lines of the interface itself.
        nested_comments: Keep those of nested types as well.
    """
    text = _text(name)
    yield from _expand(text, name.package, 0, comments, nested_comments)


def _expand(text: str, package: str, depth: int, comments: bool, nested_comments: bool) -> Iterator[str]:
    keep = comments if depth == 0 else nested_comments
    for line in text.splitlines():
        bare = line.split("#", 1)[0].rstrip()
        if not keep and not bare:
            continue
        # A `#` inside a default value of a string is kept: only lines without comments are cut.
        shown = line.rstrip() if keep or '"' in line or "'" in line else bare
        yield "\t" * depth + shown
        if bare == _SECTION:
            continue
        for nested in referenced_types(line, package):
            definition = _text(nested)
            yield from _expand(definition, nested.package, depth + 1, comments, nested_comments)


class Schema(NamedTuple):
    """Name of a type, encoding of its definition (`ros2msg` or `ros2idl`) and the definition itself."""

    name: str
    encoding: str
    text: str


def schema_of(type_name: str) -> Schema:
    """Collect the full definition of a message type.

    Args:
        type_name: Such as `sensor_msgs/msg/JointState`, or `pkg/action/Name_FeedbackMessage`.

    Raises:
        Ros2CliError: `interface_not_found` or `package_not_found`, a file of it is not installed.
    """
    package, kind, short = type_name.split("/")
    if kind == "action" and short.endswith(_FEEDBACK):
        return _feedback_schema(package, short.removesuffix(_FEEDBACK), type_name)
    root = InterfaceName(package, kind, short)
    if interface_file(root).suffix == ".idl":
        return Schema(type_name, "ros2idl", f"{SEPARATOR}\nIDL: {type_name}\n{_text(root)}")
    return Schema(type_name, "ros2msg", _with_dependencies(_text(root), package, {root}))


def _feedback_schema(package: str, action: str, type_name: str) -> Schema:
    # An action's feedback travels in a message that no file defines: the goal's identifier and the feedback.
    definition = _text(InterfaceName(package, "action", action))
    parts = split_sections(definition)
    if len(parts) != 3:
        raise Ros2CliError(
            "interface_not_found", f"'{package}/action/{action}' has {len(parts)} sections, expected 3"
        )
    # The three-part name: readers that compute the type's hash find the one that the build gave it.
    feedback = f"{package}/action/{action}_Feedback"
    first = f"unique_identifier_msgs/UUID goal_id\n{feedback} feedback\n"
    text = f"{first}\n{SEPARATOR}\nMSG: {feedback}\n{parts[2]}"
    known = {InterfaceName(package, "msg", f"{action}_Feedback")}
    return Schema(type_name, "ros2msg", _with_dependencies(text, package, known))


def _with_dependencies(text: str, package: str, known: set[InterfaceName]) -> str:
    """Append the definitions that a text needs, depth first, each once."""
    sections = [text]
    waiting = list(reversed(list(referenced_types(text, package))))
    while waiting:
        name = waiting.pop()
        if name in known:
            continue
        known.add(name)
        definition = _text(name)
        sections.append(f"\n{SEPARATOR}\nMSG: {name.package}/{name.type}\n{definition}")
        waiting.extend(reversed(list(referenced_types(definition, name.package))))
    return "".join(sections)


def _text(name: InterfaceName) -> str:
    return interface_file(name).read_text(encoding="utf-8")


def split_sections(definition: str) -> list[str]:
    """Split a service or action definition at its lines of three dashes."""
    sections: list[list[str]] = [[]]
    for line in definition.splitlines(keepends=True):
        if line.rstrip() == _SECTION:
            sections.append([])
        else:
            sections[-1].append(line)
    return ["".join(section) for section in sections]


def installed_type_hash(type_name: str) -> str:
    """Return the type description hash, such as `RIHS01_df66...`, or an empty string if none is installed."""
    try:
        package, kind, short = type_name.split("/")
        base = short.split("_")[0]
        name = InterfaceName(package, kind, base)
        path = package_prefix(name.package) / "share" / name.package / name.kind / f"{name.type}.json"
        hashes = json.loads(path.read_text(encoding="utf-8"))["type_hashes"]
        return next((str(entry["hash_string"]) for entry in hashes if entry["type_name"] == type_name), "")
    except (Ros2CliError, OSError, ValueError, KeyError, TypeError):
        return ""
