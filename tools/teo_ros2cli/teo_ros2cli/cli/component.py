# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 component`: containers of nodes in C++, which other machines may run, and what they hold."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

from teo_ros2cli.cli.options import add_graph_arguments, assignment, full_name, known_graph, positive_int
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import call
from teo_ros2cli.interfaces import interface_class
from teo_ros2cli.packages import resources

_LISTING = "/_container/list_nodes"
# Time that a container gets to list or to end its nodes [s], as a node for its parameters.
_TIMEOUT = 5.0
# Time that it gets to load a library and to start a node of it [s]: a driver may open its device in that.
_LOADING_TIMEOUT = 60.0
# By the numbers of rcl_interfaces/msg/Log.
_LOG_LEVELS = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50}


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_graph_arguments(parser)
    parser.add_argument(
        "container_node_name", nargs="?", help="Name of the container to list components from (default: all)"
    )
    parser.add_argument("--containers-only", action="store_true", help="List found containers nodes only")


def run_list(options: argparse.Namespace) -> int:
    """Print the containers of the graph with their components; without containers, nothing.

    Raises:
        Ros2CliError: `container_unknown`, or `composition_missing`: what asks a container is not installed.
    """
    with known_graph(options) as node:
        containers = _containers(node)
        if options.container_node_name:
            containers = [_known(containers, options.container_node_name)]
        for container in containers:
            print(container)
            if not options.containers_only:
                answer = _call(node, container, "list_nodes")
                for number, name in zip(answer.unique_ids, answer.full_node_names, strict=True):
                    print(f"  {number}  {name}")
    return 0


def add_load_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `load`."""
    add_graph_arguments(parser)
    parser.add_argument("container_node_name", help="Container node name to load component into")
    parser.add_argument("package_name", help="Name of the package where the component is to be found")
    parser.add_argument("plugin_name", help="Type name of the component to be loaded")
    parser.add_argument("-q", "--quiet", action="store_true", help="Only print component unique ID and name")
    parser.add_argument("-n", "--node-name", default="", help="Component node name")
    parser.add_argument("--node-namespace", default="", help="Component node namespace")
    parser.add_argument("--log-level", choices=_LOG_LEVELS, help="Component node log level")
    for short, name, what in (
        ("-r", "remap-rule", "Component node remapping rules, in the 'from:=to' form"),
        ("-p", "parameter", "Component node parameters, in the 'name:=value' form"),
        ("-e", "extra-argument", "Extra arguments for the container, in the 'name:=value' form"),
    ):
        parser.add_argument(
            short, f"--{name}", type=assignment, action="append", default=[], metavar="NAME:=VALUE", help=what
        )


def run_load(options: argparse.Namespace) -> int:
    """Start a component in a container, and print the node that it became.

    Raises:
        Ros2CliError: `container_unknown`, `composition_missing`, `load_failed`, `no_answer`.
    """
    with known_graph(options) as node:
        container = _known(_containers(node), options.container_node_name)
        answer = _call(
            node,
            container,
            "load_node",
            timeout=_LOADING_TIMEOUT,
            package_name=options.package_name,
            plugin_name=options.plugin_name,
            node_name=options.node_name,
            node_namespace=options.node_namespace,
            log_level=_LOG_LEVELS.get(options.log_level, 0),
            remap_rules=[":=".join(rule) for rule in options.remap_rule],
            parameters=list(_parameters(options.parameter)),
            extra_arguments=list(_parameters(options.extra_argument)),
        )
    if not answer.success:
        raise Ros2CliError("load_failed", f"Failed to load component: {answer.error_message}")
    if options.quiet:
        print(f"{answer.unique_id} {answer.full_node_name}")
    else:
        print(
            f"Loaded component {answer.unique_id} into '{container}' container node as "
            f"'{answer.full_node_name}'"
        )
    return 0


def add_unload_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `unload`."""
    add_graph_arguments(parser)
    parser.add_argument("container_node_name", help="Container node name to unload component from")
    parser.add_argument(
        "component_uid", type=positive_int, nargs="+", help="Unique ID of the component to be unloaded"
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="Only print component unique IDs")


def run_unload(options: argparse.Namespace) -> int:
    """End nodes of a container, and print their numbers.

    Raises:
        Ros2CliError: `container_unknown`, `composition_missing`, `unload_failed`, `no_answer`.
    """
    with known_graph(options) as node:
        container = _known(_containers(node), options.container_node_name)
        for number in options.component_uid:
            answer = _call(node, container, "unload_node", unique_id=number)
            if not answer.success:
                raise Ros2CliError(
                    "unload_failed",
                    f"Failed to unload component {number} from '{container}' container node\n"
                    f"    {answer.error_message}",
                )
            print(
                number if options.quiet else f"Unloaded component {number} from '{container}' container node"
            )
    return 0


def _containers(node: Any) -> list[str]:
    services = (name for name, _ in node.get_service_names_and_types())
    return sorted(name.removesuffix(_LISTING) for name in services if name.endswith(_LISTING))


def _known(containers: list[str], name: str) -> str:
    wanted = full_name(name)
    if wanted not in containers:
        raise Ros2CliError("container_unknown", f"Unable to find container node '{wanted}'")
    return wanted


def _parameters(assignments: list[tuple[str, str]]) -> Iterator[Any]:
    from rcl_interfaces.msg import Parameter
    from rclpy.parameter import get_parameter_value

    for name, value in assignments:
        yield Parameter(name=name, value=get_parameter_value(value))


def _call(node: Any, container: str, service: str, *, timeout: float = _TIMEOUT, **request: Any) -> Any:
    """Call a container's `list_nodes`, of composition_interfaces/srv/ListNodes, and the like."""
    kind = service.title().replace("_", "")
    try:
        cls = interface_class(f"composition_interfaces/srv/{kind}", "srv")
    except Ros2CliError as error:
        raise Ros2CliError(
            "composition_missing",
            "Containers cannot be asked: package 'composition_interfaces' is not installed; `make setup` "
            "builds it. `component list --containers-only` lists the containers.",
        ) from error
    return call(node, cls, f"{container}/_container/{service}", timeout=timeout, **request)


def add_types_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `types`."""
    parser.add_argument("package_name", nargs="?", help="Package whose components to list (default: all)")


def run_types(options: argparse.Namespace) -> int:
    """Print the types of components that are installed, by package.

    Raises:
        Ros2CliError: `no_components`, the package that was named has none.
    """
    kind = "rclcpp_components"
    packages = resources(kind)
    if options.package_name and options.package_name not in packages:
        raise Ros2CliError("no_components", f"No component types found for package '{options.package_name}'")
    for package in [options.package_name] if options.package_name else sorted(packages):
        listing = packages[package] / "share/ament_index/resource_index" / kind / package
        print(package)
        for line in listing.read_text(encoding="utf-8").splitlines():
            print(f"  {line.partition(';')[0]}")
    return 0
