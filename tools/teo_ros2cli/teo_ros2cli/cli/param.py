# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param`: the parameters of nodes."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import add_graph_arguments, full_name, known_graph, pattern, positive_float
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import call
from teo_ros2cli.graph.discovery import look_again, node_names
from teo_ros2cli.messages.parameters import TYPES, WILDCARD, descriptor_text, plain_value, read_parameter_file
from teo_ros2cli.messages.tree import dump

# Time that a node gets to answer unless another is given [s].
_TIMEOUT = 5.0
# Time that it gets to set one [s]: with a parameter a node may load a model or a table of signs.
_SETTING_TIMEOUT = 60.0


def _add_node_arguments(parser: argparse.ArgumentParser, *, or_all: bool = False) -> None:
    add_graph_arguments(parser)
    parser.add_argument("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")
    parser.add_argument(
        "--timeout",
        type=positive_float,
        default=_TIMEOUT,
        metavar="N",
        help=f"Wait for N seconds until service becomes available (default: {_TIMEOUT:g})",
    )
    if or_all:
        parser.add_argument("node_name", nargs="?", help="Name of the ROS node (default: all)")
    else:
        parser.add_argument("node_name", help="Name of the ROS node")


def _add_parameter_arguments(parser: argparse.ArgumentParser) -> None:
    _add_node_arguments(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    _add_node_arguments(parser, or_all=True)
    parser.add_argument(
        "--param-type", action="store_true", help="Print parameter types with parameter names"
    )
    parser.add_argument(
        "--param-prefixes", nargs="+", default=[], help="Only list parameters with the provided prefixes"
    )
    parser.add_argument(
        "--filter", default="", help="Only list parameters whose name contains the regular expression"
    )


def run_list(options: argparse.Namespace) -> int:
    """Print the parameters of one node or of all.

    Raises:
        Ros2CliError: `invalid_regex`, `node_unknown`.
    """
    wanted = pattern(options.filter)
    with _parameters(options) as parameters:
        nodes = (
            [full_name(options.node_name)]
            if options.node_name
            else parameters.nodes(hidden=options.include_hidden_nodes)
        )
        for node in nodes:
            try:
                names = parameters.names(node, options.param_prefixes)
                if wanted is not None:
                    names = [name for name in names if wanted.search(name)]
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
    _add_parameter_arguments(parser)
    parser.add_argument("--hide-type", action="store_true", help="Hide the type information")


def run_get(options: argparse.Namespace) -> int:
    """Print a parameter's value.

    Raises:
        Ros2CliError: `node_unknown`, `parameter_unset`.
    """
    with _parameters(options) as parameters:
        value = parameters.get(full_name(options.node_name), [options.parameter_name])[0]
    if value.type not in TYPES:
        raise Ros2CliError("parameter_unset", "Parameter not set.")
    label = TYPES[value.type][0]
    print(plain_value(value) if options.hide_type else f"{label} {plain_value(value)}")
    return 0


def add_set_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `set`."""
    _add_parameter_arguments(parser)
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
    if not result.successful:
        raise Ros2CliError("set_refused", f"Setting parameter failed{_because(result)}")
    print(f"Set parameter successful{_because(result)}")
    return 0


add_delete_arguments = _add_parameter_arguments


def run_delete(options: argparse.Namespace) -> int:
    """Take a parameter's value away, where the node lets it go.

    Raises:
        Ros2CliError: `node_unknown`, `delete_refused`.
    """
    from rcl_interfaces.msg import ParameterValue

    with _parameters(options) as parameters:
        result = parameters.set(full_name(options.node_name), options.parameter_name, ParameterValue())
    if not result.successful:
        raise Ros2CliError("delete_refused", f"Deleting parameter failed{_because(result)}")
    print(f"Deleted parameter successfully{_because(result)}")
    return 0


def add_load_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `load`."""
    _add_node_arguments(parser)
    parser.add_argument("parameter_file", type=Path, help="Parameter file")
    parser.add_argument(
        "--no-use-wildcard",
        action="store_true",
        help=f"Do not load parameters in the '{WILDCARD}' namespace into the node",
    )


def run_load(options: argparse.Namespace) -> int:
    """Set the parameters that a file has for a node, and say of each whether it was taken.

    Exit status 1 if one of them was refused.

    Raises:
        Ros2CliError: `parameter_file_invalid`, `node_unknown`.
    """
    from rclpy.parameter import get_parameter_value

    node = full_name(options.node_name)
    names = (node,) if options.no_use_wildcard else (WILDCARD, node)
    values = read_parameter_file(options.parameter_file, names)
    refused = False
    with _parameters(options) as parameters:
        for name, value in values.items():
            result = parameters.set(node, name, get_parameter_value(value))
            refused = refused or not result.successful
            outcome = "successful" if result.successful else "failed"
            stream = sys.stdout if result.successful else sys.stderr
            print(f"Set parameter {name} {outcome}{_because(result)}", file=stream)
    return int(refused)


def add_describe_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `describe`."""
    _add_node_arguments(parser)
    parser.add_argument("parameter_names", nargs="+", help="Names of the parameters")


def run_describe(options: argparse.Namespace) -> int:
    """Print the descriptors of parameters."""
    with _parameters(options) as parameters:
        descriptors = parameters.describe(full_name(options.node_name), options.parameter_names)
    for descriptor in descriptors:
        print(descriptor_text(descriptor))
    return 0


add_dump_arguments = _add_node_arguments


def run_dump(options: argparse.Namespace) -> int:
    """Print a node's parameters as a parameter file."""
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
        if value.type in TYPES:
            branch[last] = plain_value(value)
    print(dump({node: {"ros__parameters": tree}}), end="")
    return 0


def _because(result: Any) -> str:
    """The reason that a node gives in an rcl_interfaces/msg/SetParametersResult, if it gives one."""
    return f": {result.reason}" if result.reason else ""


@contextmanager
def _parameters(options: argparse.Namespace) -> Iterator[_Parameters]:
    with known_graph(options, names=True) as node:
        yield _Parameters(node, options.timeout)


class _Parameters:
    """Asks the parameter services of nodes."""

    def __init__(self, node: Any, timeout: float) -> None:
        self._node = node
        self._timeout = timeout

    def nodes(self, *, hidden: bool) -> list[str]:
        return sorted(name for name in set(node_names(self._node)) if hidden or not is_hidden(name))

    def names(self, node: str, prefixes: Sequence[str] = ()) -> list[str]:
        return sorted(self._call(node, "list_parameters", prefixes=list(prefixes)).result.names)

    def types(self, node: str, names: list[str]) -> list[str]:
        numbers = self._call(node, "get_parameter_types", names=names).types
        return [TYPES[number][2] if number in TYPES else "not set" for number in numbers]

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
        patience = max(self._timeout, _SETTING_TIMEOUT)
        return self._call(node, "set_parameters", patience, parameters=[parameter]).results[0]

    def _call(self, node: str, service: str, answer_timeout: float | None = None, **request: Any) -> Any:
        """Call `<node>/list_parameters`, of rcl_interfaces/srv/ListParameters, and the like."""
        from rcl_interfaces import srv

        if not look_again(lambda: node in node_names(self._node)):
            raise Ros2CliError("node_unknown", "Node not found")
        cls = getattr(srv, service.title().replace("_", ""))
        name, timeout = f"{node}/{service}", self._timeout
        return call(self._node, cls, name, timeout=timeout, answer_timeout=answer_timeout, **request)
