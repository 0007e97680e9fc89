# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What commands share: types of arguments, options, joining the graph and listing what it has."""

from __future__ import annotations

import argparse
import math
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.cli_node import cli_node
from teo_ros2cli.graph.discovery import look_again, settle
from teo_ros2cli.qos import POLICIES

# As rclpy.qos names them; not taken from there, because loading rclpy takes longer than most commands.
QOS_PRESETS = (
    "unknown",
    "default",
    "system_default",
    "sensor_data",
    "services_default",
    "parameters",
    "parameter_events",
    "action_status_default",
    "best_available",
)
# Without the value that rclpy has no word for, as it is deprecated.
QOS_POLICIES = {
    name: tuple(value for value in values if value != "manual_by_node") for name, values in POLICIES.items()
}


def positive_float(text: str) -> float:
    """Read a finite number above 0."""
    value = _number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"value must be above 0, got {text}")
    return value


def non_negative_float(text: str) -> float:
    """Read a finite number of at least 0."""
    value = _number(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"value must not be below 0, got {text}")
    return value


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"value must be a number, got {text!r}") from error
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"value must be finite, got {text}")
    return value


def non_negative_int(text: str) -> int:
    """Read an integer of at least 0."""
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError(f"value must be non-negative integer, got {text!r}")
    return value


def positive_int(text: str) -> int:
    """Read an integer above 0."""
    value = non_negative_int(text)
    if value == 0:
        raise argparse.ArgumentTypeError("value must be above 0, got 0")
    return value


def add_values_argument(parser: argparse.ArgumentParser, name: str, help_text: str) -> None:
    """Add an argument for values in YAML, and `--stdin`; `given_values` reads them."""
    parser.add_argument(name, nargs="?", default="", help=help_text)
    parser.add_argument("--stdin", action="store_true", help="Read values from standard input")


def given_values(options: argparse.Namespace, name: str) -> str:
    """Return the values in YAML that were typed or come on the standard input; none are `{}`.

    Raises:
        Ros2CliError: `values_twice`.
    """
    typed = str(getattr(options, name))
    if options.stdin and typed:
        raise Ros2CliError("values_twice", f"Values come by --stdin or as `{name}`, not both: got {typed!r}")
    return (sys.stdin.read() if options.stdin else typed) or "{}"


def key_value(text: str) -> tuple[str, str]:
    """Read `key=value`."""
    key, separator, value = text.partition("=")
    if not separator or not key:
        raise argparse.ArgumentTypeError(f"expected KEY=VALUE, got {text!r}")
    return key, value


def assignment(text: str) -> tuple[str, str]:
    """Read `name:=value`."""
    name, separator, value = text.partition(":=")
    if not separator or not name:
        raise argparse.ArgumentTypeError(f"expected NAME:=VALUE, got {text!r}")
    return name, value


def full_name(topic: str) -> str:
    """Return a topic name with the slash that full names begin with."""
    return topic if topic.startswith("/") else f"/{topic}"


def pattern(text: str) -> re.Pattern[str] | None:
    """Return a regular expression, None for an empty text.

    Raises:
        Ros2CliError: `invalid_regex`.
    """
    if not text:
        return None
    try:
        return re.compile(text)
    except re.error as error:
        raise Ros2CliError("invalid_regex", f"{text!r} is not a regular expression: {error}") from error


def add_graph_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options on how the graph is looked at."""
    parser.add_argument(
        "--spin-time",
        type=non_negative_float,
        help="Spin time in seconds to wait for discovery (default: until all participants of this machine "
        "are known, and 0.5 s where other machines may take part)",
    )
    parser.add_argument("-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time")
    parser.add_argument("--no-daemon", action="store_true", help="Accepted; there is no daemon")


def add_qos_arguments(parser: argparse.ArgumentParser, doing: str, preset: str) -> None:
    """Add the `--qos-*` options, which `teo_ros2cli.qos.from_options` reads.

    Args:
        parser: The parser of a command.
        doing: `publish` or `subscribe`.
        preset: The preset that holds unless another is chosen.
    """
    parser.set_defaults(default_preset=preset)
    where = f"setting to {doing} with (overrides the value of --qos-profile)"
    parser.add_argument(
        "--qos-profile",
        choices=QOS_PRESETS,
        help=f"Quality of service preset profile to {doing} with (default: {preset})",
    )
    parser.add_argument("--qos-depth", metavar="N", type=non_negative_int, help=f"Queue size {where}")
    for name, choices in QOS_POLICIES.items():
        parser.add_argument(f"--qos-{name}", choices=choices, help=f"Quality of service {name} {where}")
    parser.add_argument(
        "--qos-liveliness-lease-duration-seconds",
        type=non_negative_float,
        help=f"Quality of service liveliness lease duration {where}",
    )


NamesAndTypes = Sequence[tuple[str, Sequence[str]]]


@contextmanager
def known_graph(options: argparse.Namespace, *, names: bool = False, rosout: bool = True) -> Iterator[Any]:
    """Yield a node that knows the graph, made as the options of `add_graph_arguments` say.

    Args:
        options: Of the command.
        names: Wait for the names of the nodes as well.
        rosout: Let the node publish its log.
    """
    with cli_node(use_sim_time=options.use_sim_time, rosout=rosout) as node:
        settle(node, options.spin_time, names=names)
        yield node


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
    types = look_again(lambda: dict(look()).get(full_name(name), ()))
    for kind in types:
        print(kind)
    return 0 if types else 1
