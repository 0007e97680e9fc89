# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node's life as a process; lifecycle nodes that need no manager."""

from __future__ import annotations

import gc
import os
import signal
import socket
import sys
import textwrap
import threading
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import uninstall_signal_handlers

from teo_common.dds_profiles import ProfileError, own_sockets, requested_profile
from teo_common.parameters import AUTOSTART, ParameterRow, declare_parameters

# A signal is noticed within this time, where nothing else happens [s].
_LOOK = 0.1


def tell_supervisor(state: str) -> None:
    """Tell whoever started us what we have come to, by systemd's protocol (sd_notify(3)), if it listens.

    Args:
        state: An assignment, as `READY=1`.
    """
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address:
        return
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as notes:
            notes.sendto(state.encode(), address.replace("@", "\0", 1) if address[0] == "@" else address)
    except OSError as error:  # a supervisor that is gone: the node serves without it
        print(f"expected a supervisor at NOTIFY_SOCKET={address}: {error.strerror}", file=sys.stderr)


def run_node(
    make_node: Callable[[], Node], arguments: Sequence[str] | None, rows: Sequence[ParameterRow] = ()
) -> None:
    """Make a node and run it until it is told to end (SIGINT, SIGTERM, a shutdown of its context).

    A supervisor that asks for it is told when the node is made: it can serve then.

    Args:
        make_node: Makes the node, once ROS is there. What it raises passes through, with ROS ended.
        arguments: Of the command line; None for the process's own. `--help` prints the parameters, and no
            node is made.
        rows: The node's parameters, for `--help`.

    Raises:
        SystemExit: The Fast DDS profile that the environment asks for is not in force.
    """
    if not {"-h", "--help"}.isdisjoint(sys.argv[1:] if arguments is None else arguments):
        print(_help(rows))
        return
    node: Node | None = None
    try:
        profile, sockets = requested_profile(rclpy.get_rmw_implementation_identifier()), own_sockets()
        rclpy.init(args=arguments)
        # Before the node: an executor that is told to end while it is being made leaves a half-made
        # object, whose destructor writes a traceback.
        executor = SingleThreadedExecutor()
        # What is loaded stays: a collection meanwhile, 50 ms where much is imported, finds next to nothing.
        gc.disable()
        node = make_node()
        if profile is not None:
            profile.check(sockets)
        # Models and tables are there to stay: a collection that walked them all would hold up a callback
        # for a tenth of a second.
        gc.collect()
        gc.freeze()
        gc.enable()
        tell_supervisor("READY=1")
        _spin(node, executor)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except ProfileError as error:
        raise SystemExit(f"[{error.code}] {error}") from error
    except rclpy_implementation.RCLError:
        if rclpy.ok():
            raise  # else it was told to end before it had begun to spin
    finally:
        gc.enable()
        gc.unfreeze()  # else what is loaded is never taken down, and bindings complain of leaks
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


def _help(rows: Sequence[ParameterRow]) -> str:
    """How a node is started, and its parameters."""
    lines = [
        f"usage: {Path(sys.argv[0]).name} [--ros-args -p PARAMETER:=VALUE ... -r NAME:=OTHER ...]",
        "",
        "Runs until Ctrl-C. While it runs, `ros2 node info` lists its topics, services and actions.",
        "",
        "parameters:",
    ]
    for row in rows:
        within = "" if row.low is None else f", {row.low:g} to {row.high:g}"
        allowed = f", one of {', '.join(row.choices)}" if row.choices else ""
        fixed = ", fixed at the start" if row.read_only else ""
        lines.append(f"  {row.name} ({row.default!r}{within}{allowed}{fixed})")
        lines.append(textwrap.indent(textwrap.fill(row.description, 100), " " * 6))
    return "\n".join(lines)


def _spin(node: Node, executor: SingleThreadedExecutor) -> None:
    """Run callbacks until told to end; the node can still publish then.

    The handlers of rclpy shut ROS down at once: what a node has to say at its end would reach nobody.
    """
    told = threading.Event()
    uninstall_signal_handlers()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: told.set())
    executor.add_node(node)
    while not told.is_set() and node.context.ok():
        executor.spin_once(timeout_sec=_LOOK)


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


def run_self_starting(
    make_node: Callable[[], SelfStartingNode], arguments: Sequence[str] | None, rows: Sequence[ParameterRow]
) -> None:
    """Make a node, start it if it is to start itself, and run it until it is told to end.

    Args:
        make_node: Makes the node, once ROS is there.
        arguments: Of the command line; None for the process's own.
        rows: The node's parameters.

    Raises:
        SystemExit: It could not be started; the log has said why.
    """

    def started() -> SelfStartingNode:
        node = make_node()
        if node.get_parameter(AUTOSTART.name).value and not node.start():
            node.destroy_node()
            raise SystemExit(1)
        return node

    run_node(started, arguments, rows)
