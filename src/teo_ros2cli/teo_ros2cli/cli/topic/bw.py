"""`ros2 topic bw`: the bandwidth that a topic takes."""

from __future__ import annotations

import argparse
import time
from collections import deque
from typing import Any

from teo_ros2cli.cli.options import add_graph_arguments, positive_int

DEFAULT_WINDOW = 100
# Interval of printing [s].
_REPORT = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Topic name to monitor for bandwidth utilization")
    parser.add_argument(
        "--window",
        "-w",
        dest="window_size",
        type=positive_int,
        default=DEFAULT_WINDOW,
        metavar="WINDOW",
        help=f"Maximum window size, in # of messages, for calculating rate (default: {DEFAULT_WINDOW})",
    )


def run(options: argparse.Namespace) -> int:
    """Print the bandwidth once a second, until interrupted.

    Raises:
        Ros2CliError: `invalid_topic`, `invalid_type`, `ambiguous_type`.
    """
    from teo_ros2cli.graph.adaptive import AdaptiveSubscription
    from teo_ros2cli.graph.cli_node import cli_node, settle
    from teo_ros2cli.graph.listening import ANYTHING, listen
    from teo_ros2cli.graph.topics import full_topic_name, wait_for_type
    from teo_ros2cli.messages.classes import message_class

    arrivals: deque[tuple[float, int]] = deque(maxlen=options.window_size)

    def receive(message: Any, _info: dict[str, Any]) -> None:
        arrivals.append((time.monotonic(), len(message)))

    def report() -> None:
        text = bandwidth_text(list(arrivals), time.monotonic())
        if text:
            print(text)

    with cli_node(use_sim_time=options.use_sim_time) as node:
        topic = full_topic_name(node, options.topic_name)
        settle(node, options.spin_time)
        cls = message_class(wait_for_type(node, topic, "measure"))
        print(f"Subscribed to [{topic}]")
        subscription = AdaptiveSubscription(node, topic, cls, receive, fixed=ANYTHING, raw=True, warn=print)
        listen(node, [subscription], every=(_REPORT, report))
    return 0


def bandwidth_text(arrivals: list[tuple[float, int]], now: float) -> str:
    """Return the bandwidth of some arrivals (moment [s], size [bytes]) until now; empty with one or none."""
    if len(arrivals) < 2 or now <= arrivals[0][0]:
        return ""
    sizes = [size for _, size in arrivals]
    per_second = sum(sizes) / (now - arrivals[0][0])
    return (
        f"{_bytes(per_second)}/s from {len(sizes)} messages\n\tMessage size mean: "
        f"{_bytes(sum(sizes) / len(sizes))} min: {_bytes(min(sizes))} max: {_bytes(max(sizes))}"
    )


def _bytes(count: float) -> str:
    if count < 1000:
        return f"{count:.0f} B"
    if count < 1_000_000:
        return f"{count / 1000:.2f} KB"
    return f"{count / 1_000_000:.2f} MB"
