# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node's parameters as rows of a table: default, meaning and range in one place."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # tools that only show parameters need no ROS
    from rcl_interfaces.msg import ParameterDescriptor
    from rclpy.node import Node

Value = bool | int | float | str | tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class ParameterRow:
    """One parameter as ROS shows it."""

    name: str
    default: Value
    """Its type is the parameter's."""
    description: str
    """Meaning, with the unit."""
    low: float | None = None
    high: float | None = None
    """Range, both ends included; None for switches and text."""
    choices: tuple[str, ...] = ()
    """Allowed words, for people to read: ROS does not check them. Empty unless it is a choice."""
    read_only: bool = False

    def descriptor(self) -> ParameterDescriptor:
        """What ROS checks a value against, and shows."""
        from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

        descriptor = ParameterDescriptor(description=self.description, read_only=self.read_only)
        if self.choices:
            descriptor.additional_constraints = f"one of {', '.join(map(repr, self.choices))}"
        if self.low is not None and self.high is not None:
            if isinstance(self.default, int):
                whole = IntegerRange(from_value=int(self.low), to_value=int(self.high), step=1)
                descriptor.integer_range = [whole]
            else:
                real = FloatingPointRange(from_value=float(self.low), to_value=float(self.high), step=0.0)
                descriptor.floating_point_range = [real]
        return descriptor


# `ros2 run` without a manager must give a node that works.
AUTOSTART = ParameterRow(
    name="autostart",
    default=True,
    description="Whether the node configures and activates itself when it starts; else a manager does.",
    read_only=True,
)


# Which robot: that of the description, of the signs and of the driver must be the same.
ROBOT = ParameterRow(
    name="robot",
    default="teo",
    description="Name of the robot, one of `ros2 run teo_description robots list`.",
    read_only=True,
)


def declare_parameters(node: Node, rows: Iterable[ParameterRow]) -> None:
    """Declare every row on the node."""
    for row in rows:
        node.declare_parameter(row.name, row.default, row.descriptor())
