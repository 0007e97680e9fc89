# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node's life as a process."""

from __future__ import annotations

import gc
import signal
import threading
from collections.abc import Callable, Sequence

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers

# A signal is noticed within this time, where nothing else happens [s].
_LOOK = 0.1


def run_node(make_node: Callable[[], Node], arguments: Sequence[str] | None) -> None:
    """Make a node and run it until it is told to end (SIGINT, SIGTERM, a shutdown of its context).

    Args:
        make_node: Makes the node, once ROS is there. What it raises passes through, with ROS ended.
        arguments: Of the command line; None for the process's own.
    """
    rclpy.init(args=arguments)
    node: Node | None = None
    try:
        # Before the node: an executor that is told to end while it is being made leaves a half-made
        # object, whose destructor writes a traceback.
        executor = SingleThreadedExecutor()
        node = make_node()
        # Models and tables are there to stay: a collection that walked them all would hold up a callback
        # for a tenth of a second.
        gc.collect()
        gc.freeze()
        _spin(node, executor)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except rclpy_implementation.RCLError:
        if rclpy.ok():
            raise  # else it was told to end before it had begun to spin
    finally:
        gc.unfreeze()  # else what is loaded is never taken down, and bindings complain of leaks
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


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
