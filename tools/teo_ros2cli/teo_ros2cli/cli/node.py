# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 node`: which nodes there are, and what they offer."""

from __future__ import annotations

import argparse
from collections import Counter

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import (
    add_graph_arguments,
    add_node_listing_arguments,
    full_name,
    known_graph,
    print_nodes,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.discovery import look_again, node_names

add_list_arguments = add_node_listing_arguments


def run_list(options: argparse.Namespace) -> int:
    """Print the full names of the nodes of the graph, this command's own left out."""
    with known_graph(options, names=True) as node:
        names = sorted(node_names(node))
    if not options.all:
        names = [name for name in names if not is_hidden(name)]
    print_nodes(options, names)
    if not options.count_nodes and any(count > 1 for count in Counter(names).values()):
        print(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, which can have "
            "unintended side effects."
        )
    return 0


def add_info_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `info`."""
    add_graph_arguments(parser)
    parser.add_argument("node_name", help="Node name to request information")
    parser.add_argument(
        "--include-hidden", action="store_true", help="Display hidden topics, services, and actions as well"
    )


def run_info(options: argparse.Namespace) -> int:
    """Print what a node publishes, subscribes to, serves and calls.

    Raises:
        Ros2CliError: `node_unknown`.
    """
    from rclpy.action import (
        get_action_client_names_and_types_by_node,
        get_action_server_names_and_types_by_node,
    )

    full = full_name(options.node_name)
    namespace, _, name = full.rpartition("/")
    with known_graph(options, names=True) as node:
        count = look_again(lambda: node_names(node).count(full))
        if not count:
            raise Ros2CliError("node_unknown", f"Unable to find node '{options.node_name}'")
        if count > 1:
            print(
                f'There are {count} nodes in the graph with the exact name "{full}". You are seeing '
                "information about only one of them."
            )
        print(full)
        for title, find in (
            ("Subscribers", node.get_subscriber_names_and_types_by_node),
            ("Publishers", node.get_publisher_names_and_types_by_node),
            ("Service Servers", node.get_service_names_and_types_by_node),
            ("Service Clients", node.get_client_names_and_types_by_node),
            ("Action Servers", lambda *at: get_action_server_names_and_types_by_node(node, *at)),
            ("Action Clients", lambda *at: get_action_client_names_and_types_by_node(node, *at)),
        ):
            print(f"  {title}:")
            for entry, types in sorted(find(name, namespace or "/")):
                if options.include_hidden or not is_hidden(entry):
                    print(f"    {entry}: {', '.join(types)}")
            if title != "Action Clients":
                print()
    return 0
