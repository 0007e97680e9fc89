# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the verbs share that look at the graph: joining it, and printing what has a name and types."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from teo_ros2cli.cli.options import add_graph_arguments, full_name

NamesAndTypes = Sequence[tuple[str, Sequence[str]]]


@contextmanager
def known_graph(options: argparse.Namespace, *, names: bool = False) -> Iterator[Any]:
    """Yield a node that knows the graph, made as the options of `add_graph_arguments` say.

    Args:
        options: Of the command.
        names: Wait for the names of the nodes as well.
    """
    from teo_ros2cli.graph.cli_node import cli_node, settle

    with cli_node(use_sim_time=options.use_sim_time) as node:
        settle(node, options.spin_time, names=names)
        yield node


def node_names(node: Any) -> list[str]:
    """Return the full names of the nodes of the graph, the given one left out."""
    own = (node.get_name(), node.get_namespace())
    return [
        f"{namespace.rstrip('/')}/{name}"
        for name, namespace in node.get_node_names_and_namespaces()
        if (name, namespace) != own
    ]


def add_node_listing_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of a verb that lists nodes and ends in `print_nodes`."""
    add_graph_arguments(parser)
    parser.add_argument("-a", "--all", action="store_true", help="Display all nodes even hidden ones")
    parser.add_argument(
        "-c", "--count-nodes", action="store_true", help="Only display the number of nodes discovered"
    )


def print_nodes(options: argparse.Namespace, names: Sequence[str]) -> None:
    """Print names of nodes a line each, or only their number if the options say so."""
    if options.count_nodes:
        print(len(names))
        return
    for name in names:
        print(name)


def add_listing_arguments(
    parser: argparse.ArgumentParser, noun: str, *, types: bool = True, hidden: bool = True, counted: str = ""
) -> None:
    """Add the options of a verb that ends in `print_names`.

    Args:
        parser: The parser of the verb.
        noun: What is listed, such as `topic`.
        types: Let types be shown.
        hidden: Let hidden names be shown.
        counted: What `--count` counts, if more is to be said than the plural of the noun.
    """
    add_graph_arguments(parser)
    parser.set_defaults(show_types=False)
    if types:
        parser.add_argument(
            "-t", "--show-types", action="store_true", help=f"Additionally show the {noun} type"
        )
    parser.add_argument(
        "-c",
        f"--count-{noun}s",
        dest="count",
        action="store_true",
        help=f"Only display the number of {counted or f'{noun}s'}",
    )
    if hidden:
        parser.add_argument(
            "-a",
            f"--include-hidden-{noun}s",
            dest="include_hidden",
            action="store_true",
            help=f"Consider hidden {noun}s as well",
        )


def print_names(options: argparse.Namespace, found: NamesAndTypes) -> int:
    """Print names, each with its types or only their number if the options say so; return exit status 0."""
    if options.count:
        print(len(found))
        return 0
    for name, types in found:
        print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return 0


def print_types(look: Callable[[], NamesAndTypes], name: str) -> int:
    """Print the types of a name, a line each; return the exit status: 1 if there is no such name."""
    from teo_ros2cli.graph.cli_node import look_again

    types = look_again(lambda: dict(look()).get(full_name(name), ()))
    for kind in types:
        print(kind)
    return 0 if types else 1
