# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a node says about its health on `diagnostics`, with the meanings of ROS's `diagnostic_updater`.

A node judges itself in a pure function that returns a `Diagnosis`; a `DiagnosticsPublisher` sends it under
the name "<node>: <task>". A `RateMeter` tells how regularly something happens. Only the publisher needs ROS.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:  # who judges needs no ROS
    from rclpy.node import Node

# How often a node says how it is [s]: REP 107.
DIAGNOSTICS_PERIOD = 1.0


class Level(IntEnum):
    """Levels of diagnostic_msgs/DiagnosticStatus; the greater one is worse."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


class Diagnosis(NamedTuple):
    """How one task of a node is."""

    level: Level
    """How bad it is."""
    message: str
    """One line for people."""
    values: Mapping[str, str]
    """Figures by name, the unit in the name: "rate [Hz]"."""


class DiagnosticsPublisher:
    """Publishes the diagnoses of one task of a node."""

    def __init__(self, node: Node, task: str) -> None:
        """Advertise `diagnostics`.

        Args:
            node: Whose health it is.
            task: What of it, for example "joints".
        """
        from diagnostic_msgs.msg import DiagnosticArray

        self._node = node
        self._task = task
        self._publisher = node.create_publisher(DiagnosticArray, "diagnostics", 10)

    def publish(self, diagnosis: Diagnosis) -> None:
        """Send a diagnosis, stamped now."""
        from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

        status = DiagnosticStatus(
            level=bytes([diagnosis.level]),
            name=f"{self._node.get_name()}: {self._task}",
            message=diagnosis.message,
            hardware_id="none",
            values=[KeyValue(key=key, value=value) for key, value in diagnosis.values.items()],
        )
        message = DiagnosticArray(status=[status])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)


class RateReport(NamedTuple):
    """How regularly steps came since the last report."""

    rate: float
    """Steps per second [Hz]; 0 with fewer than two steps."""
    longest_gap: float
    """Longest time between two steps [s]."""
    longest_step: float
    """Longest time that one step took [s]."""


class RateMeter:
    """Counts steps between reports. Times are from a clock that nobody sets [s]."""

    def __init__(self) -> None:
        """Begin without a step."""
        self._first: float | None = None
        self._last = 0.0
        self._count = 0
        self._longest_gap = 0.0
        self._longest_step = 0.0

    def step(self, begin: float, end: float) -> None:
        """Enter a step that began and ended at these times [s]."""
        if self._first is None:
            self._first = begin
        else:
            self._longest_gap = max(self._longest_gap, begin - self._last)
            self._count += 1
        self._last = begin
        self._longest_step = max(self._longest_step, end - begin)

    def report(self) -> RateReport:
        """Report, and begin anew from the last step."""
        span = 0.0 if self._first is None else self._last - self._first
        report = RateReport(self._count / span if span > 0.0 else 0.0, self._longest_gap, self._longest_step)
        self._first = None if self._first is None else self._last
        self._count, self._longest_gap, self._longest_step = 0, 0.0, 0.0
        return report
