# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes as plain values, as text for people, and in files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.messages.tree import dump

# Name of the node in a parameter file whose parameters are for every node.
WILDCARD = "/**"

# By the number in rcl_interfaces/msg/ParameterType: how the value is announced, its field, its type's name.
TYPES = {
    1: ("Boolean value is:", "bool_value", "boolean"),
    2: ("Integer value is:", "integer_value", "integer"),
    3: ("Double value is:", "double_value", "double"),
    4: ("String value is:", "string_value", "string"),
    5: ("Byte values are:", "byte_array_value", "byte array"),
    6: ("Boolean values are:", "bool_array_value", "boolean array"),
    7: ("Integer values are:", "integer_array_value", "integer array"),
    8: ("Double values are:", "double_array_value", "double array"),
    9: ("String values are:", "string_array_value", "string array"),
}


def plain_value(value: Any) -> Any:
    """Return the value of an rcl_interfaces/msg/ParameterValue as plain Python."""
    plain = getattr(value, TYPES[value.type][1])
    if value.type == 5:
        return [byte[0] for byte in plain]
    return list(plain) if value.type > 4 else plain


def descriptor_text(descriptor: Any) -> str:
    """Return an rcl_interfaces/msg/ParameterDescriptor as text for people."""
    kind = TYPES[descriptor.type][2] if descriptor.type in TYPES else "not set"
    lines = [f"Parameter name: {descriptor.name}", f"  Type: {kind}"]
    if descriptor.description:
        lines.append(f"  Description: {descriptor.description}")
    constraints = []
    if descriptor.read_only:
        constraints.append("Read only: true")
    for limits in (*descriptor.integer_range, *descriptor.floating_point_range):
        constraints += [f"Min value: {limits.from_value}", f"Max value: {limits.to_value}"]
        if limits.step:
            constraints.append(f"Step: {limits.step}")
    if descriptor.additional_constraints:
        constraints.append(f"Additional constraints: {descriptor.additional_constraints}")
    lines.append("  Constraints:")
    lines += [f"    {constraint}" for constraint in constraints]
    return "\n".join(lines)


def read_parameter_file(path: Path, nodes: Sequence[str]) -> dict[str, str]:
    """Read the parameters that a file has for some nodes; those of the last node hold.

    Args:
        path: A parameter file: node names, `ros__parameters` below each, groups of parameters below that.
        nodes: Full names.

    Returns:
        The values as YAML, by parameter name with its groups.

    Raises:
        Ros2CliError: `parameter_file_invalid`: it is no such file, or has nothing for these nodes.
    """
    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise Ros2CliError("parameter_file_invalid", f"'{path}' cannot be read: {error}") from error
    found: dict[str, str] = {}
    known = (
        {f"/{str(name).lstrip('/')}": entry for name, entry in tree.items()} if isinstance(tree, dict) else {}
    )
    for node in nodes:
        if node in known:
            entry = known[node]
            values = entry.get("ros__parameters") if isinstance(entry, dict) else None
            if not isinstance(values, dict):
                raise Ros2CliError(
                    "parameter_file_invalid", f"'{path}': '{node}' needs a mapping `ros__parameters`"
                )
            found.update((name, dump(value, flow_style=True)) for name, value in _flat(values))
    if not found:
        raise Ros2CliError("parameter_file_invalid", f"'{path}' has no parameters for '{nodes[-1]}'")
    return found


def _flat(tree: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the parameters of nested groups, with the groups' names before theirs."""
    for name, value in tree.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value
