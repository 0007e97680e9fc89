# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node's life as a process."""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node


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
        rclpy.spin(node, executor)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except rclpy_implementation.RCLError:
        if rclpy.ok():
            raise  # else it was told to end before it had begun to spin
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()
