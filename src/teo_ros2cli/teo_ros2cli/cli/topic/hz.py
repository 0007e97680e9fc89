"""`ros2 topic hz`: the rate at which messages arrive."""

from __future__ import annotations

import argparse
import functools
from typing import Any

from teo_ros2cli.cli.options import add_graph_arguments, positive_int
from teo_ros2cli.cli.topic.echo import message_filter
from teo_ros2cli.cli.topic.rates import Rate, RateMeter

DEFAULT_WINDOW = 10000
# Interval of printing [s].
_REPORT = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_graph_arguments(parser)
    parser.add_argument(
        "topic_name", nargs="+", help="Names of the ROS topics to listen to (e.g. '/chatter')"
    )
    parser.add_argument(
        "--window",
        "-w",
        dest="window_size",
        type=positive_int,
        default=DEFAULT_WINDOW,
        metavar="WINDOW",
        help=f"Window size, in # of messages, for calculating rate (default: {DEFAULT_WINDOW})",
    )
    parser.add_argument(
        "--filter",
        dest="filter_expression",
        metavar="EXPR",
        help="Only measure messages matching the specified Python expression",
    )
    parser.add_argument(
        "--wall-time",
        action="store_true",
        help="Calculates rate using wall time which can be helpful when clock is not published during "
        "simulation",
    )


def run(options: argparse.Namespace) -> int:
    """Print the rate once a second, until interrupted.

    Raises:
        Ros2CliError: `invalid_topic`, `invalid_type`, `ambiguous_type`, `invalid_filter`.
    """
    from teo_ros2cli.graph.adaptive import AdaptiveSubscription
    from teo_ros2cli.graph.cli_node import cli_node, settle
    from teo_ros2cli.graph.listening import ANYTHING, listen
    from teo_ros2cli.graph.topics import full_topic_name, wait_for_type
    from teo_ros2cli.messages.classes import message_class

    passes = message_filter(options.filter_expression)
    raw = options.filter_expression is None  # a message that nobody looks into need not be taken apart
    with cli_node(use_sim_time=options.use_sim_time) as node:
        topics = [full_topic_name(node, topic) for topic in options.topic_name]
        settle(node, options.spin_time)
        classes = {topic: message_class(wait_for_type(node, topic, "measure")) for topic in topics}
        meters = {topic: RateMeter(options.window_size) for topic in topics}
        printed: dict[str, int | None] = dict.fromkeys(topics)

        def receive(topic: str, message: Any, info: dict[str, Any]) -> None:
            if raw or passes(message):
                simulated = options.use_sim_time and not options.wall_time
                time = node.get_clock().now().nanoseconds if simulated else info["received_timestamp"]
                meters[topic].arrive(time)

        def report() -> None:
            fresh = {topic: meter.rate() for topic, meter in meters.items() if meter.last != printed[topic]}
            rates = {topic: rate for topic, rate in fresh.items() if rate is not None}
            printed.update({topic: meters[topic].last for topic in rates})
            if rates:
                print(rate_text(next(iter(rates.values()))) if len(topics) == 1 else rate_table(rates))

        subscriptions = [
            AdaptiveSubscription(
                node, topic, cls, functools.partial(receive, topic), fixed=ANYTHING, raw=raw, warn=print
            )
            for topic, cls in classes.items()
        ]
        listen(node, subscriptions, every=(_REPORT, report))
    return 0


def rate_text(rate: Rate) -> str:
    """Return the statistics of one topic as the command prints them."""
    return (
        f"average rate: {rate.hertz:.3f}\n\tmin: {rate.shortest:.3f}s max: {rate.longest:.3f}s "
        f"std dev: {rate.deviation:.5f}s window: {rate.intervals}"
    )


def rate_table(rates: dict[str, Rate]) -> str:
    """Return the statistics of several topics, a line each."""
    header = ("topic", "rate", "min_delta", "max_delta", "stddev", "window")
    rows = [header]
    for name, rate in rates.items():
        numbers = (
            f"{rate.hertz:.3f}",
            f"{rate.shortest:.4f}",
            f"{rate.longest:.4f}",
            f"{rate.deviation:.5f}",
        )
        rows.append((name, *numbers, str(rate.intervals)))
    widths = [max(len(row[i]) for row in rows) for i in range(len(header))]
    lines = ["   ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    lines.insert(1, "=" * max(map(len, lines)))
    return "\n".join(lines) + "\n"
