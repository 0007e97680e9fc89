# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param`: the parameters of nodes."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.dispatch import Entry
from teo_ros2cli.cli.graph_view import known_graph, node_names
from teo_ros2cli.cli.options import add_graph_arguments, full_name
from teo_ros2cli.errors import Ros2CliError

VERBS = {
    "describe": Entry(__name__, "Show descriptive information about declared parameters", "describe"),
    "dump": Entry(__name__, "Show all of the parameters of a node in a YAML file format", "dump"),
    "get": Entry(__name__, "Get parameter", "get"),
    "list": Entry(__name__, "Output a list of available parameters", "list"),
    "set": Entry(__name__, "Set parameter", "set"),
}
# Time that a node gets to answer [s].
_TIMEOUT = 5.0

# By the number in rcl_interfaces/msg/ParameterType: how the value is announced, its field, its type's name.
_TYPES = {
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


def _add_common(parser: argparse.ArgumentParser) -> None:
    add_graph_arguments(parser)
    parser.add_argument("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    _add_common(parser)
    parser.add_argument("node_name", nargs="?", help="Name of the ROS node (default: all)")
    parser.add_argument(
        "--param-type", action="store_true", help="Print parameter types with parameter names"
    )


def run_list(options: argparse.Namespace) -> int:
    """Print the parameters of one node or of all."""
    with _parameters(options) as parameters:
        nodes = (
            [full_name(options.node_name)]
            if options.node_name
            else parameters.nodes(hidden=options.include_hidden_nodes)
        )
        for node in nodes:
            try:
                names = parameters.names(node)
                types = parameters.types(node, names) if options.param_type else []
            except Ros2CliError as error:
                if options.node_name:
                    raise
                print(f"{node}: {error}", file=sys.stderr)
                continue
            if not options.node_name:
                print(f"{node}:")
            for i, name in enumerate(names):
                print(f"  {name} (type: {types[i]})" if types else f"  {name}")
    return 0


def add_get_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `get`."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("--hide-type", action="store_true", help="Hide the type information")


def run_get(options: argparse.Namespace) -> int:
    """Print a parameter's value.

    Raises:
        Ros2CliError: `node_unknown`, `parameter_unset`.
    """
    with _parameters(options) as parameters:
        value = parameters.get(full_name(options.node_name), [options.parameter_name])[0]
    if value.type not in _TYPES:
        raise Ros2CliError("parameter_unset", "Parameter not set.")
    label = _TYPES[value.type][0]
    print(plain_value(value) if options.hide_type else f"{label} {plain_value(value)}")
    return 0


def add_set_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `set`."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("value", help="Value of the parameter")


def run_set(options: argparse.Namespace) -> int:
    """Set a parameter.

    Raises:
        Ros2CliError: `node_unknown`, `set_refused`.
    """
    from rclpy.parameter import get_parameter_value

    try:
        value = get_parameter_value(options.value)
    except Exception as error:  # of YAML, or a value that no parameter can have
        raise Ros2CliError(
            "invalid_value", f"'{options.value}' is no value for a parameter: {error}"
        ) from error
    with _parameters(options) as parameters:
        result = parameters.set(full_name(options.node_name), options.parameter_name, value)
    reason = f": {result.reason}" if result.reason else ""
    if not result.successful:
        raise Ros2CliError("set_refused", f"Setting parameter failed{reason}")
    print(f"Set parameter successful{reason}")
    return 0


def add_describe_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `describe`."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("parameter_names", nargs="+", help="Names of the parameters")


def run_describe(options: argparse.Namespace) -> int:
    """Print the descriptors of parameters."""
    with _parameters(options) as parameters:
        descriptors = parameters.describe(full_name(options.node_name), options.parameter_names)
    for descriptor in descriptors:
        print(descriptor_text(descriptor))
    return 0


def add_dump_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `dump`."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")


def run_dump(options: argparse.Namespace) -> int:
    """Print a node's parameters as a parameter file."""
    from teo_ros2cli.messages.yaml_text import dump

    node = full_name(options.node_name)
    with _parameters(options) as parameters:
        names = parameters.names(node)
        values = parameters.get(node, names)
    tree: dict[str, Any] = {}
    for name, value in zip(names, values, strict=True):
        *groups, last = name.split(".")
        branch = tree
        for group in groups:
            branch = branch.setdefault(group, {})
        if value.type in _TYPES:
            branch[last] = plain_value(value)
    print(dump({node: {"ros__parameters": tree}}), end="")
    return 0


def plain_value(value: Any) -> Any:
    """Return the value of an rcl_interfaces/msg/ParameterValue as plain Python."""
    plain = getattr(value, _TYPES[value.type][1])
    if value.type == 5:
        return [byte[0] for byte in plain]
    return list(plain) if value.type > 4 else plain


def descriptor_text(descriptor: Any) -> str:
    """Return an rcl_interfaces/msg/ParameterDescriptor as text for people."""
    kind = _TYPES[descriptor.type][2] if descriptor.type in _TYPES else "not set"
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


@contextmanager
def _parameters(options: argparse.Namespace) -> Iterator[_Parameters]:
    with known_graph(options, names=True) as node:
        yield _Parameters(node)


class _Parameters:
    """Asks the parameter services of nodes."""

    def __init__(self, node: Any) -> None:
        self._node = node

    def nodes(self, *, hidden: bool) -> list[str]:
        return sorted(name for name in set(node_names(self._node)) if hidden or not is_hidden(name))

    def names(self, node: str) -> list[str]:
        return sorted(self._call(node, "list_parameters").result.names)

    def types(self, node: str, names: list[str]) -> list[str]:
        numbers = self._call(node, "get_parameter_types", names=names).types
        return [_TYPES[number][2] if number in _TYPES else "not set" for number in numbers]

    def get(self, node: str, names: list[str]) -> list[Any]:
        values = list(self._call(node, "get_parameters", names=names).values)
        if len(values) != len(names):
            raise Ros2CliError("parameter_unset", "Parameter not set.")
        return values

    def describe(self, node: str, names: list[str]) -> list[Any]:
        descriptors = list(self._call(node, "describe_parameters", names=names).descriptors)
        if len(descriptors) != len(names):
            raise Ros2CliError("parameter_unset", f"One of the parameters {', '.join(names)} is not declared")
        return descriptors

    def set(self, node: str, name: str, value: Any) -> Any:
        from rcl_interfaces.msg import Parameter

        parameter = Parameter(name=name, value=value)
        return self._call(node, "set_parameters", parameters=[parameter]).results[0]

    def _call(self, node: str, service: str, **request: Any) -> Any:
        """Call `<node>/list_parameters`, of rcl_interfaces/srv/ListParameters, and the like."""
        from rcl_interfaces import srv

        from teo_ros2cli.graph.calls import call

        if node not in node_names(self._node):
            raise Ros2CliError("node_unknown", "Node not found")
        cls = getattr(srv, service.title().replace("_", ""))
        return call(self._node, cls, f"{node}/{service}", cls.Request(**request), timeout=_TIMEOUT)
