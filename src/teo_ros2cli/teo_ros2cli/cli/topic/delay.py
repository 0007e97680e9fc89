"""`ros2 topic delay`: how old messages are by the stamp in their headers when they arrive."""

from __future__ import annotations

import argparse
import math
from collections import deque
from typing import Any

from teo_ros2cli.cli.topic.measuring import add_window_arguments, measure, measured_topics
from teo_ros2cli.errors import Ros2CliError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_window_arguments(parser, 10000)
    parser.add_argument("topic", help="Topic name to calculate the delay for")


def run(options: argparse.Namespace) -> int:
    """Print the delay once a second, until interrupted.

    Raises:
        Ros2CliError: `no_header`, and as of `measured_topics`.
    """
    delays: deque[float] = deque(maxlen=options.window_size)
    with measured_topics(options, [options.topic]) as (node, classes):
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
                print(delay_text(list(delays)))

        measure(node, classes, receive, report)
    return 0


def delay_text(delays: list[float]) -> str:
    """Return the statistics of some delays [s]."""
    mean = sum(delays) / len(delays)
    deviation = math.sqrt(sum((delay - mean) ** 2 for delay in delays) / len(delays))
    return (
        f"average delay: {mean:.3f}\n\tmin: {min(delays):.3f}s max: {max(delays):.3f}s "
        f"std dev: {deviation:.5f}s window: {len(delays)}"
    )
