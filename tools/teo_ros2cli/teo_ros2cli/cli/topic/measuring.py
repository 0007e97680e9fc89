# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic hz`, `bw` and `delay`: what arrives, looked back on in a window and reported each second."""

from __future__ import annotations

import argparse
import functools
import math
import time
from collections import deque
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from teo_ros2cli.cli.options import add_graph_arguments, known_graph, positive_int
from teo_ros2cli.cli.topic.echo import message_filter
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.discovery import full_topic_name, wait_for_type
from teo_ros2cli.graph.subscribing import ANYTHING, AdaptiveSubscription, listen
from teo_ros2cli.interfaces import message_class

# Interval of printing [s].
_REPORT = 1.0


def _add_window_arguments(parser: argparse.ArgumentParser, default: int, what: str = "Window size") -> None:
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
    with known_graph(options) as node:
        names = [full_topic_name(node, topic) for topic in topics]
        yield node, {name: message_class(wait_for_type(node, name, "measure")) for name in names}


def _measure(
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
    subscriptions = [
        AdaptiveSubscription(
            node, topic, cls, functools.partial(receive, topic), fixed=ANYTHING, raw=raw, warn=print
        )
        for topic, cls in classes.items()
    ]
    listen(node, subscriptions, every=(_REPORT, report))


def add_bw_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `bw`."""
    _add_window_arguments(parser, 100, "Maximum window size")
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
        if text := _bandwidth_text(list(arrivals), time.monotonic()):
            print(text)

    with _measured_topics(options, [options.topic_name]) as (node, classes):
        print(f"Subscribed to [{next(iter(classes))}]")
        _measure(node, classes, receive, report, raw=True)
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
    _add_window_arguments(parser, 10000)
    parser.add_argument("topic", help="Topic name to calculate the delay for")


def run_delay(options: argparse.Namespace) -> int:
    """Print the delay once a second, until interrupted.

    Raises:
        Ros2CliError: `no_header`, and as of `_measured_topics`.
    """
    delays: deque[float] = deque(maxlen=options.window_size)
    with _measured_topics(options, [options.topic]) as (node, classes):
        ((topic, cls),) = classes.items()
        if cls.get_fields_and_field_types().get("header") != "std_msgs/Header":
            raise Ros2CliError("no_header", f"Messages of topic '{topic}' have no header, and so no stamp")

        def receive(_topic: str, message: Any, _info: dict[str, Any]) -> None:
            stamp = message.header.stamp
            delays.append((node.get_clock().now().nanoseconds - stamp.sec * 10**9 - stamp.nanosec) * 1e-9)

        def report() -> None:
            if delays:
                found = _Statistics.of(delays)
                print(f"average delay: {found.mean:.3f}\n{found.spread}")

        _measure(node, classes, receive, report)
    return 0


def add_hz_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `hz`."""
    _add_window_arguments(parser, 10000)
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
        arrivals = {topic: _Arrivals(options.window_size) for topic in classes}
        printed: dict[str, int | None] = dict.fromkeys(classes)

        def receive(topic: str, message: Any, info: dict[str, Any]) -> None:
            if raw or passes(message):
                simulated = options.use_sim_time and not options.wall_time
                time = node.get_clock().now().nanoseconds if simulated else info["received_timestamp"]
                arrivals[topic].add(time)

        def report() -> None:
            found = {
                topic: _Statistics.of(come.intervals)
                for topic, come in arrivals.items()
                if come.intervals and come.last != printed[topic]
            }
            printed.update({topic: arrivals[topic].last for topic in found})
            if found and len(classes) > 1:
                print(_rate_table(found))
            elif found:
                (intervals,) = found.values()
                print(f"average rate: {intervals.rate:.3f}\n{intervals.spread}")

        _measure(node, classes, receive, report, raw=raw)
    return 0


class _Arrivals:
    """The intervals between the latest arrivals [s], `window` of them at most, and the last arrival [ns]."""

    def __init__(self, window: int) -> None:
        self.intervals: deque[float] = deque(maxlen=window)
        self.last: int | None = None

    def add(self, time: int) -> None:
        """Note an arrival [ns]; one before the last (a clock was set back) starts the measurement anew."""
        if self.last is not None:
            if time < self.last:
                self.intervals.clear()
            else:
                self.intervals.append((time - self.last) * 1e-9)
        self.last = time


class _Statistics(NamedTuple):
    """Of some times [s]."""

    mean: float
    least: float
    most: float
    deviation: float
    number: int

    @classmethod
    def of(cls, times: Collection[float]) -> _Statistics:
        mean = math.fsum(times) / len(times)
        variance = math.fsum((time - mean) ** 2 for time in times) / len(times)
        return cls(mean, min(times), max(times), math.sqrt(variance), len(times))

    @property
    def rate(self) -> float:
        """Of what comes at such intervals [1/s]."""
        return 1.0 / self.mean if self.mean > 0 else 0.0

    @property
    def spread(self) -> str:
        """A line for people on all but the mean."""
        return (
            f"\tmin: {self.least:.3f}s max: {self.most:.3f}s std dev: {self.deviation:.5f}s "
            f"window: {self.number}"
        )


def _rate_table(found: dict[str, _Statistics]) -> str:
    """Return the statistics of several topics, a line each."""
    header = ("topic", "rate", "min_delta", "max_delta", "stddev", "window")
    rows = [header]
    for name, (_, least, most, deviation, number) in found.items():
        numbers = (f"{found[name].rate:.3f}", f"{least:.4f}", f"{most:.4f}", f"{deviation:.5f}")
        rows.append((name, *numbers, str(number)))
    widths = [max(len(row[i]) for row in rows) for i in range(len(header))]
    lines = ["   ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    lines.insert(1, "=" * max(map(len, lines)))
    return "\n".join(lines) + "\n"
