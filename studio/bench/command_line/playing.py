# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How exactly `ros2 bag play` keeps the times of a bag, and whether every message arrives.

`python -m command_line.playing [COMMAND]` in `bench` plays a bag with the topics, sizes and rates of the
demo's at rates 1 and 2 with this `ros2`, or with another that is named, to a reliable subscriber of each
topic. Times are Fast DDS's own, of publishing and of reception, so that this process's pace has no part in
them. Beside it a process that does nothing but sleep tells how exact the machine lets anything be.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
import reservation
from numpy.typing import NDArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import String

from report import Figure
from teo_ros2cli.bags.metadata import TopicRecord
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.interfaces import schema_of
from teo_ros2cli.packages import package_prefix
from teo_ros2cli.qos import QosRecord

KIND = "std_msgs/msg/String"
SECOND = 1_000_000_000
_BEGIN = 1_760_000_000 * SECOND
_LENGTH = 30.0  # of the bag [s]
_WAIT = 60.0  # [s] for what is to come
# Prints how late it wakes [s], at moments a hundredth of a second apart until it is ended.
SLEEPER = """
import time
begin, i = time.monotonic(), 0
while True:
    i += 1
    time.sleep(max(begin + i / 100 - time.monotonic(), 0))
    print(time.monotonic() - begin - i / 100, flush=True)
"""
# Topic, messages a second, bytes of each, as in the demo's bag; a rate of 0 is one message at the start.
_TOPICS = (
    ("/robot_description", 0.0, 60_000),
    ("/joint_states", 100.0, 1_500),
    ("/executor_status", 4.0, 300),
    ("/diagnostics", 1.0, 2_000),
    ("/sign_tokens", 0.1, 500),
    ("/joint_trajectory", 0.1, 200_000),
)
_LATCHED = frozenset({"/robot_description", "/executor_status"})
_SHORT_TOPICS, _PLAYS = 6, 10  # of a bag without a duration
_LINGER = 0.3  # [s] for the last messages to come
_QUEUE = 10  # that the nodes offer; 1 for what is latched


def measure(command: str = "") -> list[Figure]:
    """Play at both rates with a command; by default with the workspace's own."""
    program = command or str(own_command())
    with tempfile.TemporaryDirectory() as folder:
        bag = Path(folder) / "demo"
        times = _make(bag)
        figures = [figure for rate in (1.0, 2.0) for figure in _played(program, bag, times, rate)]
        return [*figures, _short(program, Path(folder) / "short")]


def own_command() -> Path:
    """The `ros2` of the workspace, also where a genuine one is on the path."""
    return package_prefix("teo_ros2cli") / "lib" / "teo_ros2cli" / "ros2"


def _make(bag: Path) -> dict[str, NDArray[np.int64]]:
    """Write the bag; the times of its messages [ns from its start] by topic."""
    writer = BagWriter(bag)
    moments: list[tuple[int, str, bytes]] = []
    for topic, rate, size in _TOPICS:
        offered = QosRecord(
            depth=1 if topic in _LATCHED else _QUEUE,
            reliability="reliable",
            durability="transient_local" if topic in _LATCHED else "volatile",
        )
        writer.add_topic(TopicRecord(topic, KIND, offered_qos=(offered,)), schema_of(KIND))
        data = serialize_message(String(data="x" * size))
        count = max(round(_LENGTH * rate), 1)
        moments += [(round(i * SECOND / rate) if rate else 0, topic, data) for i in range(count)]
    for moment, topic, data in sorted(moments):
        writer.write(topic, _BEGIN + moment, _BEGIN + moment, data)
    writer.close()
    return {
        topic: np.array(sorted(moment for moment, name, _ in moments if name == topic))
        for topic, *_ in _TOPICS
    }


def _played(program: str, bag: Path, times: dict[str, NDArray[np.int64]], rate: float) -> list[Figure]:
    came: dict[str, list[tuple[int, int]]] = {topic: [] for topic in times}
    total = sum(map(len, times.values()))
    with in_domain() as (node, executor):
        for topic in times:

            def note(_data: bytes, info: dict[str, Any], topic: str = topic) -> None:
                came[topic].append((info["source_timestamp"], info["received_timestamp"]))

            durability = DurabilityPolicy.TRANSIENT_LOCAL if topic in _LATCHED else DurabilityPolicy.VOLATILE
            node.create_subscription(
                String, topic, note, QoSProfile(depth=5000, durability=durability), raw=True
            )
        player = subprocess.Popen(
            [program, "bag", "play", str(bag), "--rate", str(rate)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        sleeper = subprocess.Popen([sys.executable, "-c", SLEEPER], stdout=subprocess.PIPE, text=True)
        deadline = time.monotonic() + _LENGTH / rate + _WAIT
        while player.poll() is None and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=0.1)
        player.kill()
        player.wait()
        sleeper.kill()
        late_wakes = np.array(sleeper.communicate()[0].split()[:-1], dtype=float)
        while any(len(found) < len(times[topic]) for topic, found in came.items()):
            before = sum(map(len, came.values()))
            executor.spin_once(timeout_sec=1.0)
            if sum(map(len, came.values())) == before:
                break
    arrived = sum(map(len, came.values()))
    figures = [Figure(f"rate {rate:g}: messages that arrived", f"{arrived} of {total}")]
    whole = [topic for topic, found in came.items() if len(found) == len(times[topic])]
    lost = [
        f"{topic} {len(times[topic]) - len(found)}" for topic, found in came.items() if topic not in whole
    ]
    if lost:
        figures.append(Figure(f"rate {rate:g}: lost", ", ".join(lost)))
    for which, what in enumerate(("published", "received")):
        # Of topics that came whole alone is it known which message is which.
        real = [np.array([stamps[which] for stamps in came[topic]]) for topic in whole]
        late = np.concatenate(
            [stamps - times[topic] / rate for topic, stamps in zip(whole, real, strict=True)]
        )
        figures.append(_errors(f"rate {rate:g}: error of the time at which a message is {what}", late * 1e-9))
    return [*figures, _errors(f"rate {rate:g}: error of a process beside it that only sleeps", late_wakes)]


def _short(program: str, bag: Path) -> Figure:
    """Whether a bag that is over at once arrives: who listens already has to be found first."""
    writer = BagWriter(bag)
    schema, topics = schema_of(KIND), [f"/short_{i}" for i in range(_SHORT_TOPICS)]
    for i, topic in enumerate(topics):
        writer.add_topic(TopicRecord(topic, KIND), schema)
        writer.write(topic, _BEGIN + i, _BEGIN + i, serialize_message(String(data="once")))
    writer.close()
    came: list[bytes] = []
    with in_domain() as (node, executor):
        for topic in topics:
            node.create_subscription(String, topic, came.append, QoSProfile(depth=100), raw=True)
        for _ in range(_PLAYS):
            subprocess.run(
                [program, "bag", "play", str(bag)], stdin=subprocess.DEVNULL, capture_output=True, check=True
            )
            end = time.monotonic() + _LINGER
            while time.monotonic() < end:
                executor.spin_once(timeout_sec=_LINGER)
    return Figure(
        f"a bag of {_SHORT_TOPICS} messages played {_PLAYS} times: messages that arrived",
        f"{len(came)} of {_PLAYS * _SHORT_TOPICS}",
    )


def _errors(what: str, late: NDArray[np.float64]) -> Figure:
    """Figure of how far delays [s] are from their median."""
    errors = np.abs(late - np.median(late)) * 1e3
    middle, most = np.percentile(errors, [50, 99])
    value = f"median {middle:.2f} ms, p99 {most:.2f} ms, greatest {errors.max():.1f} ms"
    return Figure(f"{what} ({len(errors)})", value)


@contextmanager
def in_domain() -> Iterator[tuple[Node, SingleThreadedExecutor]]:
    """A node of this process, and what spins it, in a DDS domain of its own that child processes share."""
    with reservation.domain():
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        with _node() as found:
            yield found


@contextmanager
def _node() -> Iterator[tuple[Node, SingleThreadedExecutor]]:
    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    node = rclpy.create_node("bench", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    try:
        yield node, executor
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown(context=context)


if __name__ == "__main__":
    for figure in measure(*sys.argv[1:2]):
        print(f"{figure.what}: {figure.value}")
