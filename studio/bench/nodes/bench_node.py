# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node of the bench's own process among the processes that are measured, and what these use."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import rclpy
import reservation
from builtin_interfaces.msg import Duration, Time
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from teo_bringup.graph import Graph


class BenchNode(Node):
    """Is spun while it waits."""

    def __init__(self) -> None:
        """Join the domain."""
        super().__init__("bench")
        self._spinner = SingleThreadedExecutor()
        self._spinner.add_node(self)

    def spin_too(self, other: Node) -> None:
        """Spin another node with this one from now on."""
        self._spinner.add_node(other)

    def spin_once(self, most: float) -> None:
        """Answer what has come, or comes within `most` [s]."""
        self._spinner.spin_once(timeout_sec=max(most, 0.0))

    def until(self, condition: Callable[[], object], most: float) -> bool:
        """Spin until a condition holds, for `most` [s] at the longest; whether it does."""
        deadline = time.monotonic() + most
        while not condition() and (left := deadline - time.monotonic()) > 0.0:
            self.spin_once(min(left, 0.05))
        return bool(condition())

    def wait_for(self, what: str, condition: Callable[[], object], most: float = 180.0) -> None:
        """Spin until a condition holds.

        Raises:
            TimeoutError: It does not, after `most` [s].
        """
        if not self.until(condition, most):
            raise TimeoutError(f"expected {what} within {most:g} s")

    def spin(self, seconds: float) -> None:
        """Spin for so long [s]."""
        self.until(lambda: False, seconds)


@contextmanager
def bench_graph() -> Iterator[tuple[BenchNode, Graph]]:
    """A node here and processes beside it, in a domain that nobody else on this machine has."""
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    with reservation.domain(), tempfile.TemporaryDirectory() as logs, Graph(Path(logs)) as graph:
        rclpy.init()
        node = BenchNode()
        try:
            yield node, graph
        finally:
            node.destroy_node()
            rclpy.try_shutdown()


def cpu_seconds(pid: int) -> float:
    """Processor time that a process has used [s], user and system."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def seconds(stamp: Time | Duration) -> float:
    """A message's time [s]."""
    return float(stamp.sec + stamp.nanosec * 1e-9)
