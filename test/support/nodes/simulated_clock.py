# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The clock of a simulator, for nodes that go by `use_sim_time`."""

from __future__ import annotations

import threading

import rclpy
from rclpy.context import Context
from rosgraph_msgs.msg import Clock

SECOND = 10**9  # [ns]
_STEP = SECOND // 100  # [ns]


class SimulatedClock:
    """Publishes /clock from a thread, 10 ms of simulated time a message, unless it is paused."""

    def __init__(self, context: Context, *, rate: float) -> None:
        """Begin. `rate` is how much faster than real time it runs [1]."""
        self.node = rclpy.create_node("simulator", context=context)
        self._period = _STEP / SECOND / rate  # [s], real
        self._publisher = self.node.create_publisher(Clock, "/clock", 10)
        self._end, self._running = threading.Event(), threading.Event()
        self._running.set()
        self.now = 1000 * SECOND  # [ns]
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def pause(self) -> None:
        """Let time stand."""
        self._running.clear()

    def go_on(self) -> None:
        """Let it run on."""
        self._running.set()

    def close(self) -> None:
        """End."""
        self._end.set()
        self._thread.join()
        self.node.destroy_node()

    def _run(self) -> None:
        while not self._end.wait(self._period):
            if self._running.is_set():
                self.now += _STEP
                message = Clock()
                message.clock.sec, message.clock.nanosec = divmod(self.now, SECOND)
                self._publisher.publish(message)
