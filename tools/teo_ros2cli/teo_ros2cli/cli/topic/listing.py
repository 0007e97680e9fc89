# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic list`, `type`, `find` and `info`: which topics there are, and who publishes and subscribes."""

from __future__ import annotations

import argparse
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import (
    NamesAndTypes,
    add_graph_arguments,
    add_listing_arguments,
    known_graph,
    print_names,
    print_types,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.discovery import full_topic_name, look_again, topic_types
from teo_ros2cli.interfaces import InterfaceName

_COUNTED = "topics discovered"


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_listing_arguments(parser, "topic", counted=_COUNTED)
    parser.add_argument("-v", "--verbose", action="store_true", help="List full details about each topic")


def run_list(options: argparse.Namespace) -> int:
    """Print the topics of the graph."""
    with known_graph(options) as node:
        topics = _topics(node, options.include_hidden)
        publishers = [node.count_publishers(name) for name, _ in topics]
        subscribers = [node.count_subscribers(name) for name, _ in topics]
    if options.count or not options.verbose:
        return print_names(options, topics)
    _print_side("Published", "publisher", topics, publishers)
    _print_side("Subscribed", "subscriber", topics, subscribers)
    print()
    return 0


def _print_side(title: str, noun: str, topics: NamesAndTypes, counts: list[int]) -> None:
    print(f"\n{title} topics:")
    for (name, types), count in zip(topics, counts, strict=True):
        if count:
            plural = "s" if count > 1 else ""
            print(f" * {name} [{', '.join(types)}] {count} {noun}{plural}")


def add_type_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `type`."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def run_type(options: argparse.Namespace) -> int:
    """Print the types of a topic; exit status 1 if there is no such topic."""
    with known_graph(options) as node:
        return print_types(lambda: _topics(node, hidden=True), options.topic_name)


def add_find_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `find`."""
    add_listing_arguments(parser, "topic", types=False, counted=_COUNTED)
    parser.add_argument(
        "topic_type", help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')"
    )


def run_find(options: argparse.Namespace) -> int:
    """Print the topics of a type."""
    wanted = str(InterfaceName.parse(options.topic_type))
    with known_graph(options) as node:
        topics = _topics(node, options.include_hidden)
    return print_names(options, [entry for entry in topics if wanted in entry[1]])


def _topics(node: Any, hidden: bool) -> NamesAndTypes:
    found = node.get_topic_names_and_types()
    return [(name, types) for name, types in found if hidden or not is_hidden(name)]


def add_info_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Prints detailed information like the node name, node namespace, topic type, topic type hash, "
        "GUID, and QoS Profile of the publishers and subscribers to this topic",
    )


def run_info(options: argparse.Namespace) -> int:
    """Print a topic's type and its endpoints, this command's own ones left out.

    Raises:
        Ros2CliError: `topic_unknown` or `invalid_topic`.
    """
    with known_graph(options, names=True, rosout=False) as node:
        topic = full_topic_name(node, options.topic_name)
        types = look_again(lambda: topic_types(node, topic))
        own = node.get_name()
        publishers = [info for info in node.get_publishers_info_by_topic(topic) if info.node_name != own]
        subscriptions = [
            info for info in node.get_subscriptions_info_by_topic(topic) if info.node_name != own
        ]
    if not types:
        raise Ros2CliError("topic_unknown", f"Unknown topic '{options.topic_name}'")
    end = "\n\n" if options.verbose else "\n"
    print(f"Type: {types[0] if len(types) == 1 else types}", end=end)
    for noun, endpoints in (("Publisher", publishers), ("Subscription", subscriptions)):
        print(f"{noun} count: {len(endpoints)}", end=end)
        if options.verbose:
            for info in endpoints:
                print(info, end=end)
    return 0
