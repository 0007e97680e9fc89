"""What `ros2 topic bw`, `delay` and `hz` share: a window of messages, and a report once a second."""

from __future__ import annotations

import argparse
import functools
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from teo_ros2cli.cli.options import add_graph_arguments, positive_int

# Interval of printing [s].
_REPORT = 1.0


def add_window_arguments(parser: argparse.ArgumentParser, default: int, what: str = "Window size") -> None:
    """Add the options on how the graph is looked at and on how many messages are looked back on."""
    add_graph_arguments(parser)
    parser.add_argument(
        "--window",
        "-w",
        dest="window_size",
        type=positive_int,
        default=default,
        metavar="WINDOW",
        help=f"{what}, in # of messages, for calculating rate (default: {default})",
    )


@contextmanager
def measured_topics(
    options: argparse.Namespace, topics: Sequence[str]
) -> Iterator[tuple[Any, dict[str, Any]]]:
    """Yield a node that knows the graph, and the message classes of the topics by their full names.

    Raises:
        Ros2CliError: `invalid_topic`, `invalid_type`, `ambiguous_type`.
    """
    from teo_ros2cli.graph.cli_node import cli_node, settle
    from teo_ros2cli.graph.topics import full_topic_name, wait_for_type
    from teo_ros2cli.messages.classes import message_class

    with cli_node(use_sim_time=options.use_sim_time) as node:
        names = [full_topic_name(node, topic) for topic in topics]
        settle(node, options.spin_time)
        yield node, {name: message_class(wait_for_type(node, name, "measure")) for name in names}


def measure(
    node: Any,
    classes: dict[str, Any],
    receive: Callable[[str, Any, dict[str, Any]], None],
    report: Callable[[], None],
    *,
    raw: bool = False,
) -> None:
    """Receive messages until interrupted, and report once a second.

    Args:
        node: The node that `measured_topics` yields.
        classes: Message classes by topic name.
        receive: Takes the topic, the message (bytes if raw) and rclpy's information on it.
        report: Prints what was measured.
        raw: Pass messages on as they came from the wire.
    """
    from teo_ros2cli.graph.adaptive import AdaptiveSubscription
    from teo_ros2cli.graph.listening import ANYTHING, listen

    subscriptions = [
        AdaptiveSubscription(
            node, topic, cls, functools.partial(receive, topic), fixed=ANYTHING, raw=raw, warn=print
        )
        for topic, cls in classes.items()
    ]
    listen(node, subscriptions, every=(_REPORT, report))
