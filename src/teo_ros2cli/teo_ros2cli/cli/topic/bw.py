"""`ros2 topic bw`: the bandwidth that a topic takes."""

from __future__ import annotations

import argparse
import time
from collections import deque
from typing import Any

from teo_ros2cli.cli.topic.measuring import add_window_arguments, measure, measured_topics


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the verb's arguments."""
    add_window_arguments(parser, 100, "Maximum window size")
    parser.add_argument("topic_name", help="Topic name to monitor for bandwidth utilization")


def run(options: argparse.Namespace) -> int:
    """Print the bandwidth once a second, until interrupted.

    Raises:
        Ros2CliError: As of `measured_topics`.
    """
    arrivals: deque[tuple[float, int]] = deque(maxlen=options.window_size)

    def receive(_topic: str, message: Any, _info: dict[str, Any]) -> None:
        arrivals.append((time.monotonic(), len(message)))

    def report() -> None:
        text = bandwidth_text(list(arrivals), time.monotonic())
        if text:
            print(text)

    with measured_topics(options, [options.topic_name]) as (node, classes):
        print(f"Subscribed to [{next(iter(classes))}]")
        measure(node, classes, receive, report, raw=True)
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
