# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic list`, `type` and `find`: which topics there are."""

from __future__ import annotations

import argparse
from typing import Any

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.graph_view import (
    NamesAndTypes,
    add_listing_arguments,
    known_graph,
    print_names,
    print_types,
)
from teo_ros2cli.cli.options import add_graph_arguments
from teo_ros2cli.packages import InterfaceName

_COUNTED = "topics discovered"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_listing_arguments(parser, "topic", counted=_COUNTED)
    parser.add_argument("-v", "--verbose", action="store_true", help="List full details about each topic")


def run(options: argparse.Namespace) -> int:
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
