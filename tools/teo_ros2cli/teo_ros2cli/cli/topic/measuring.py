# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic hz`, `bw` and `delay`: what arrives, looked back on in a window and reported each second."""

from __future__ import annotations

import argparse
import functools
import math
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from teo_ros2cli.cli.options import add_graph_arguments, positive_int
from teo_ros2cli.cli.topic.echo import message_filter
from teo_ros2cli.errors import Ros2CliError

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
def _measured_topics(
    options: argparse.Namespace, topics: Sequence[str]
) -> Iterator[tuple[Any, dict[str, Any]]]:
    """Yield a node that knows the graph, and the message classes of the topics by their full names.

    Raises:
        Ros2CliError: `invalid_topic`, `invalid_type`, `ambiguous_type`.
    """
    from teo_ros2cli.graph.cli_node import cli_node
    from teo_ros2cli.graph.discovery import full_topic_name, settle, wait_for_type
    from teo_ros2cli.interfaces import message_class

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
        node: The node that `_measured_topics` yields.
        classes: Message classes by topic name.
        receive: Takes the topic, the message (bytes if raw) and rclpy's information on it.
        report: Prints what was measured.
        raw: Pass messages on as they came from the wire.
    """
    from teo_ros2cli.graph.subscribing import ANYTHING, AdaptiveSubscription, listen

    subscriptions = [
        AdaptiveSubscription(
            node, topic, cls, functools.partial(receive, topic), fixed=ANYTHING, raw=raw, warn=print
        )
        for topic, cls in classes.items()
    ]
    listen(node, subscriptions, every=(_REPORT, report))


def add_bw_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `bw`."""
    add_window_arguments(parser, 100, "Maximum window size")
    parser.add_argument("topic_name", help="Topic name to monitor for bandwidth utilization")


def run_bw(options: argparse.Namespace) -> int:
    """Print the bandwidth once a second, until interrupted.

    Raises:
        Ros2CliError: As of `_measured_topics`.
    """
    arrivals: deque[tuple[float, int]] = deque(maxlen=options.window_size)

    def receive(_topic: str, message: Any, _info: dict[str, Any]) -> None:
        arrivals.append((time.monotonic(), len(message)))

    def report() -> None:
        text = _bandwidth_text(list(arrivals), time.monotonic())
        if text:
            print(text)

    with _measured_topics(options, [options.topic_name]) as (node, classes):
        print(f"Subscribed to [{next(iter(classes))}]")
        measure(node, classes, receive, report, raw=True)
    return 0


def _bandwidth_text(arrivals: list[tuple[float, int]], now: float) -> str:
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


def add_delay_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `delay`."""
    add_window_arguments(parser, 10000)
    parser.add_argument("topic", help="Topic name to calculate the delay for")


def run_delay(options: argparse.Namespace) -> int:
    """Print the delay once a second, until interrupted.

    Raises:
        Ros2CliError: `no_header`, and as of `_measured_topics`.
    """
    delays: deque[float] = deque(maxlen=options.window_size)
    with _measured_topics(options, [options.topic]) as (node, classes):
        for topic, cls in classes.items():
            if cls.get_fields_and_field_types().get("header") != "std_msgs/Header":
                raise Ros2CliError(
                    "no_header", f"Messages of topic '{topic}' have no header, and so no stamp"
                )

        def receive(_topic: str, message: Any, _info: dict[str, Any]) -> None:
            stamp = message.header.stamp
            delays.append((node.get_clock().now().nanoseconds - stamp.sec * 10**9 - stamp.nanosec) * 1e-9)

        def report() -> None:
            if delays:
                print(_delay_text(list(delays)))

        measure(node, classes, receive, report)
    return 0


def _delay_text(delays: list[float]) -> str:
    """Return the statistics of some delays [s]."""
    mean = sum(delays) / len(delays)
    deviation = math.sqrt(sum((delay - mean) ** 2 for delay in delays) / len(delays))
    return (
        f"average delay: {mean:.3f}\n\tmin: {min(delays):.3f}s max: {max(delays):.3f}s "
        f"std dev: {deviation:.5f}s window: {len(delays)}"
    )


def add_hz_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_window_arguments(parser, 10000)
    parser.add_argument(
        "topic_name", nargs="+", help="Names of the ROS topics to listen to (e.g. '/chatter')"
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


def run_hz(options: argparse.Namespace) -> int:
    """Print the rate once a second, until interrupted.

    Raises:
        Ros2CliError: `invalid_filter`, and as of `_measured_topics`.
    """
    passes = message_filter(options.filter_expression)
    raw = options.filter_expression is None  # a message that nobody looks into need not be taken apart
    with _measured_topics(options, options.topic_name) as (node, classes):
        meters = {topic: RateMeter(options.window_size) for topic in classes}
        printed: dict[str, int | None] = dict.fromkeys(classes)

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
                print(_rate_text(next(iter(rates.values()))) if len(classes) == 1 else _rate_table(rates))

        measure(node, classes, receive, report, raw=raw)
    return 0


class Rate(NamedTuple):
    """Statistics of the intervals in a window.

    Args:
        hertz: Inverse of the mean interval [1/s].
        shortest: Shortest interval [s].
        longest: Longest interval [s].
        deviation: Standard deviation of the intervals [s].
        intervals: Number of intervals looked back on.
    """

    hertz: float
    shortest: float
    longest: float
    deviation: float
    intervals: int


class RateMeter:
    """Measures the rate of arrivals over the latest ones.

    Args:
        window: Number of intervals to look back on.
    """

    def __init__(self, window: int) -> None:
        self._intervals: deque[int] = deque(maxlen=window)
        self._last: int | None = None

    def arrive(self, time: int) -> None:
        """Note an arrival [ns]; one before the last (a clock was set back) starts the measurement anew."""
        if self._last is not None:
            if time < self._last:
                self._intervals.clear()
            else:
                self._intervals.append(time - self._last)
        self._last = time

    @property
    def last(self) -> int | None:
        """Time of the latest arrival [ns], None before the first."""
        return self._last

    def rate(self) -> Rate | None:
        """Return the rate, or None before there is an interval."""
        count = len(self._intervals)
        if not count:
            return None
        mean = sum(self._intervals) / count
        variance = sum((interval - mean) ** 2 for interval in self._intervals) / count
        return Rate(
            hertz=1e9 / mean if mean > 0 else 0.0,
            shortest=min(self._intervals) * 1e-9,
            longest=max(self._intervals) * 1e-9,
            deviation=math.sqrt(variance) * 1e-9,
            intervals=count,
        )


def _rate_text(rate: Rate) -> str:
    """Return the statistics of one topic as the command prints them."""
    return (
        f"average rate: {rate.hertz:.3f}\n\tmin: {rate.shortest:.3f}s max: {rate.longest:.3f}s "
        f"std dev: {rate.deviation:.5f}s window: {rate.intervals}"
    )


def _rate_table(rates: dict[str, Rate]) -> str:
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
