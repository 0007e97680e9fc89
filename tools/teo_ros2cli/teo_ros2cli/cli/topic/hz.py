# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic hz`: the rate at which messages arrive."""

from __future__ import annotations

import argparse
import math
from collections import deque
from typing import Any, NamedTuple

from teo_ros2cli.cli.topic.echo import message_filter
from teo_ros2cli.cli.topic.measuring import add_window_arguments, measure, measured_topics


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def run(options: argparse.Namespace) -> int:
    """Print the rate once a second, until interrupted.

    Raises:
        Ros2CliError: `invalid_filter`, and as of `measured_topics`.
    """
    passes = message_filter(options.filter_expression)
    raw = options.filter_expression is None  # a message that nobody looks into need not be taken apart
    with measured_topics(options, options.topic_name) as (node, classes):
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
                print(rate_text(next(iter(rates.values()))) if len(classes) == 1 else rate_table(rates))

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
