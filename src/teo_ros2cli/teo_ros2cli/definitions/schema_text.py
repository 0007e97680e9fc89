"""A message definition with all that it depends on, in one text: the `ros2msg` schema encoding of MCAP.

The text of the message comes first; each dependency follows once, after a line of 80 equals signs and a line
`MSG: package/Type`. Source: MCAP specification, registry of well-known schema encodings.
"""

from __future__ import annotations

from typing import NamedTuple

from teo_ros2cli.definitions.references import referenced_types
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import InterfaceName, interface_file

SEPARATOR = "=" * 80
_FEEDBACK = "_FeedbackMessage"


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
    # An action's feedback travels in a message that no file defines: the goal's identifier and the feedback
    # part.
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
        if line.rstrip() == "---":
            sections.append([])
        else:
            sections[-1].append(line)
    return ["".join(section) for section in sections]
