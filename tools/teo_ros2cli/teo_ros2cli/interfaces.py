# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Interfaces that are installed: their names, definitions, hashes and Python classes. Needs no ROS running.

A definition is given in two forms: as it is shown to people, nested types expanded, and as one text with all
that it depends on, the `ros2msg` schema encoding of MCAP: the text of the message first, then each dependency
once, after a line of 80 equals signs and a line `MSG: package/Type` (MCAP specification, registry of
well-known schema encodings).
"""

from __future__ import annotations

import importlib
import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import INDEX, package_prefix, resources

INTERFACE_KINDS = ("msg", "srv", "action")


class InterfaceName(NamedTuple):
    """Name of an interface: package, kind (`msg`, `srv`, `action`) and type, as in `std_msgs/msg/String`."""

    package: str
    kind: str
    type: str

    def __str__(self) -> str:
        return f"{self.package}/{self.kind}/{self.type}"

    @classmethod
    def parse(cls, text: str, default_kind: str = "msg") -> InterfaceName:
        """Read `pkg/kind/Type`, or `pkg/Type` with the kind that the caller expects.

        Raises:
            Ros2CliError: `invalid_type`, the text is not of either form.
        """
        parts = text.split("/")
        if len(parts) == 2:
            parts.insert(1, default_kind)
        if (
            len(parts) != 3
            or not all(part.isidentifier() for part in parts)
            or parts[1] not in INTERFACE_KINDS
        ):
            raise Ros2CliError(
                "invalid_type",
                f"The passed {_KIND_WORDS[default_kind]} type is invalid: expected a name such as "
                f"'{_EXAMPLES[default_kind]}', got {text!r}",
            )
        return cls(*parts)


_KIND_WORDS = {"msg": "message", "srv": "service", "action": "action"}
_EXAMPLES = {
    "msg": "std_msgs/msg/String",
    "srv": "std_srvs/srv/Trigger",
    "action": "example_interfaces/action/Fibonacci",
}


def interfaces(kind: str) -> Mapping[str, list[str]]:
    """Map each package that has interfaces of a kind (`msg`, `srv`, `action`) to its sorted type names."""
    found: dict[str, list[str]] = {}
    for package, prefix in sorted(resources("rosidl_interfaces").items()):
        listing = (prefix / INDEX / "rosidl_interfaces" / package).read_text(encoding="utf-8")
        names = {
            Path(line).stem
            for line in listing.splitlines()
            if line.startswith(f"{kind}/") and Path(line).suffix in (f".{kind}", ".idl")
        }
        # Services and actions generate messages of their own; these are not interfaces that someone wrote.
        names = {name for name in names if "_" not in name}
        if names:
            found[package] = sorted(names)
    return found


def interface_file(name: InterfaceName) -> Path:
    """Return the file that defines an interface, the `.msg`, `.srv` or `.action` text before the `.idl`.

    Raises:
        Ros2CliError: `package_not_found`, or `interface_not_found`.
    """
    folder = package_prefix(name.package) / "share" / name.package / name.kind
    for suffix in (name.kind, "idl"):
        path = folder / f"{name.type}.{suffix}"
        if path.is_file():
            return path
    raise Ros2CliError(
        "interface_not_found", f"Unknown interface '{name}': there is no {name.type} in {folder}"
    )


_SEPARATOR = "=" * 80
_FEEDBACK = "_FeedbackMessage"
# Parts the sections of a service or action definition.
_SECTION = re.compile(r"^---[ \t]*(?:\n|\Z)", re.MULTILINE)

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
    for line in _text(name).splitlines():
        bare = line.split("#", 1)[0].rstrip()
        if not comments and not bare:
            continue
        # A `#` inside a default value of a string is kept: only lines without comments are cut.
        yield line.rstrip() if comments or '"' in line or "'" in line else bare
        for nested in referenced_types(line, name.package):
            deeper = definition_lines(nested, comments=nested_comments, nested_comments=nested_comments)
            yield from (f"\t{nested_line}" for nested_line in deeper)


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
        return Schema(type_name, "ros2idl", f"{_SEPARATOR}\nIDL: {type_name}\n{_text(root)}")
    return Schema(type_name, "ros2msg", _with_dependencies(_text(root), package, {root}))


def _feedback_schema(package: str, action: str, type_name: str) -> Schema:
    # An action's feedback travels in a message that no file defines: the goal's identifier and the feedback.
    parts = _SECTION.split(_text(InterfaceName(package, "action", action)))
    if len(parts) != 3:
        raise Ros2CliError(
            "interface_not_found", f"'{package}/action/{action}' has {len(parts)} sections, expected 3"
        )
    # The three-part name: readers that compute the type's hash find the one that the build gave it.
    feedback = f"{package}/action/{action}_Feedback"
    first = f"unique_identifier_msgs/UUID goal_id\n{feedback} feedback\n"
    text = f"{first}\n{_SEPARATOR}\nMSG: {feedback}\n{parts[2]}"
    known = {InterfaceName(package, "msg", f"{action}_Feedback")}
    return Schema(type_name, "ros2msg", _with_dependencies(text, package, known))


def _with_dependencies(text: str, package: str, known: set[InterfaceName]) -> str:
    """Append the definitions that a text needs, depth first, each once."""
    sections = [text]
    for name in referenced_types(text, package):
        if name not in known:
            known.add(name)
            head = f"\n{_SEPARATOR}\nMSG: {name.package}/{name.type}\n"
            sections.append(head + _with_dependencies(_text(name), name.package, known))
    return "".join(sections)


def _text(name: InterfaceName) -> str:
    return interface_file(name).read_text(encoding="utf-8")


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


def interface_class(text: str, kind: str) -> Any:
    """Load the class of a message, service or action.

    Args:
        text: Name such as `std_msgs/msg/String` or, shorter, `std_msgs/String`.
        kind: What is expected: `msg`, `srv` or `action`.

    Raises:
        Ros2CliError: `invalid_type`, the name has a wrong form or the type is not installed.
    """
    name = InterfaceName.parse(text, kind)
    if name.kind != kind:
        raise Ros2CliError(
            "invalid_type", f"The passed type is invalid: expected a {kind} type, got '{name}'"
        )
    try:
        return getattr(importlib.import_module(f"{name.package}.{name.kind}"), name.type)
    except ModuleNotFoundError as error:
        raise Ros2CliError(
            "invalid_type", f"The passed type '{name}' is invalid: package '{name.package}' is not installed"
        ) from error
    except AttributeError as error:
        raise Ros2CliError(
            "invalid_type", f"The passed type '{name}' is invalid: package '{name.package}' has no such type"
        ) from error
    except ImportError as error:
        raise Ros2CliError("invalid_type", f"The passed type '{name}' cannot be loaded: {error}") from error


def message_class(text: str) -> Any:
    """Load the class of a message type, `pkg/action/Name_FeedbackMessage` of actions included.

    Raises:
        Ros2CliError: `invalid_type`.
    """
    parts = text.split("/")
    if len(parts) == 3 and parts[1] == "action" and parts[2].endswith("_FeedbackMessage"):
        action = interface_class(text.removesuffix("_FeedbackMessage"), "action")
        return action.Impl.FeedbackMessage
    return interface_class(text, "msg")


def interface_name_of(message: Any) -> str:
    """Return the name of a message's type, such as `std_msgs/msg/String`; takes a message or its class."""
    cls = message if isinstance(message, type) else type(message)
    package, kind = cls.__module__.split(".")[:2]
    return f"{package}/{kind}/{cls.__name__}"
