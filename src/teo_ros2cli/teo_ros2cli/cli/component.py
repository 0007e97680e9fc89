# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 component`: containers of nodes in C++, which other machines may run, and what they hold."""

from __future__ import annotations

import argparse

from teo_ros2cli.cli.dispatch import Entry
from teo_ros2cli.cli.graph_view import known_graph
from teo_ros2cli.cli.options import add_graph_arguments, full_name
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import resources

VERBS = {
    "list": Entry(__name__, "Output a list of running containers and components", "list"),
    "types": Entry(__name__, "Output a list of components registered in the ament index", "types"),
}
_LISTING = "/_container/list_nodes"
# Time that a container gets to answer [s], as a node for its parameters.
_TIMEOUT = 5.0


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
        services = (name for name, _ in node.get_service_names_and_types())
        containers = sorted(name.removesuffix(_LISTING) for name in services if name.endswith(_LISTING))
        if options.container_node_name:
            wanted = full_name(options.container_node_name)
            if wanted not in containers:
                raise Ros2CliError("container_unknown", f"Unable to find container node '{wanted}'")
            containers = [wanted]
        for container in containers:
            print(container)
            if not options.containers_only:
                _print_components(node, container)
    return 0


def _print_components(node: object, container: str) -> None:
    from teo_ros2cli.graph.calls import call
    from teo_ros2cli.messages.classes import interface_class

    try:
        cls = interface_class("composition_interfaces/srv/ListNodes", "srv")
    except Ros2CliError as error:
        raise Ros2CliError(
            "composition_missing",
            "What a container holds cannot be asked for: package 'composition_interfaces' is not installed. "
            "--containers-only lists the containers.",
        ) from error
    answer = call(node, cls, f"{container}{_LISTING}", cls.Request(), timeout=_TIMEOUT)
    for number, name in zip(answer.unique_ids, answer.full_node_names, strict=True):
        print(f"  {number}  {name}")


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
