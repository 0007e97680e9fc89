"""`ros2 topic delay`: how old messages are by the stamp in their headers when they arrive."""

from __future__ import annotations

import argparse
import math
from collections import deque
from typing import Any

from teo_ros2cli.cli.options import add_graph_arguments, positive_int
from teo_ros2cli.errors import Ros2CliError

DEFAULT_WINDOW = 10000
# Interval of printing [s].
_REPORT = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument("topic", help="Topic name to calculate the delay for")
    parser.add_argument(
        "--window",
        "-w",
        dest="window_size",
        type=positive_int,
        default=DEFAULT_WINDOW,
        metavar="WINDOW",
        help=f"Window size, in # of messages, for calculating rate (default: {DEFAULT_WINDOW})",
    )


def run(options: argparse.Namespace) -> int:
    """Print the delay once a second, until interrupted.

    Raises:
        Ros2CliError: `no_header`, `invalid_topic`, `invalid_type`, `ambiguous_type`.
    """
    from teo_ros2cli.graph.adaptive import AdaptiveSubscription
    from teo_ros2cli.graph.cli_node import cli_node, settle
    from teo_ros2cli.graph.listening import ANYTHING, listen
    from teo_ros2cli.graph.topics import full_topic_name, wait_for_type
    from teo_ros2cli.messages.classes import message_class

    delays: deque[float] = deque(maxlen=options.window_size)
    with cli_node(use_sim_time=options.use_sim_time) as node:
        topic = full_topic_name(node, options.topic)
        settle(node, options.spin_time)
        cls = message_class(wait_for_type(node, topic, "measure"))
        if cls.get_fields_and_field_types().get("header") != "std_msgs/Header":
            raise Ros2CliError("no_header", f"Messages of topic '{topic}' have no header, and so no stamp")

        def receive(message: Any, _info: dict[str, Any]) -> None:
            stamp = message.header.stamp
            delays.append((node.get_clock().now().nanoseconds - stamp.sec * 10**9 - stamp.nanosec) * 1e-9)

        def report() -> None:
            if delays:
                print(delay_text(list(delays)))

        subscription = AdaptiveSubscription(node, topic, cls, receive, fixed=ANYTHING, warn=print)
        listen(node, [subscription], every=(_REPORT, report))
    return 0


def delay_text(delays: list[float]) -> str:
    """Return the statistics of some delays [s]."""
    mean = sum(delays) / len(delays)
    deviation = math.sqrt(sum((delay - mean) ** 2 for delay in delays) / len(delays))
    return (
        f"average delay: {mean:.3f}\n\tmin: {min(delays):.3f}s max: {max(delays):.3f}s "
        f"std dev: {deviation:.5f}s window: {len(delays)}"
    )
