# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A lifecycle node that needs no manager: it configures and activates itself, unless told not to."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from rclpy.context import Context
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.parameter import Parameter

from teo_common.node_process import run_node
from teo_common.parameters import AUTOSTART, ParameterRow, declare_parameters


class SelfStartingNode(LifecycleNode):
    """A lifecycle node whose parameters are rows of a table, `AUTOSTART` among them."""

    def __init__(
        self,
        name: str,
        rows: Sequence[ParameterRow],
        *,
        context: Context | None = None,
        parameter_overrides: Iterable[Parameter] = (),
    ) -> None:
        """Declare the parameters.

        Args:
            name: The node's.
            rows: Its parameters.
            context: The ROS context; the default one if None.
            parameter_overrides: Values in place of the defaults of the rows.
        """
        super().__init__(name, context=context, parameter_overrides=list(parameter_overrides))
        self._rows = rows
        declare_parameters(self, rows)

    def start(self) -> bool:
        """Configure and activate without a manager; tell whether both succeeded."""
        success = TransitionCallbackReturn.SUCCESS
        return bool(self.trigger_configure() == success and self.trigger_activate() == success)

    def _value(self, name: str) -> Any:
        """A parameter's value."""
        return self.get_parameter(name).value

    def _values(self) -> dict[str, Any]:
        """The values of all rows."""
        return {row.name: self._value(row.name) for row in self._rows}


def run_self_starting(make_node: Callable[[], SelfStartingNode], arguments: Sequence[str] | None) -> None:
    """Make a node, start it if it is to start itself, and run it until it is told to end.

    Args:
        make_node: Makes the node, once ROS is there.
        arguments: Of the command line; None for the process's own.

    Raises:
        SystemExit: It could not be started; the log has said why.
    """

    def started() -> SelfStartingNode:
        node = make_node()
        if node.get_parameter(AUTOSTART.name).value and not node.start():
            node.destroy_node()
            raise SystemExit(1)
        return node

    run_node(started, arguments)
