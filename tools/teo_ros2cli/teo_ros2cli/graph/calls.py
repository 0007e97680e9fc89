# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Calling services and waiting for what comes back."""

from __future__ import annotations

import time
from typing import Any

from teo_ros2cli.errors import Ros2CliError

# Longest time in which a signal is not looked at [s].
_STEP = 0.05


def wait_for(node: Any, future: Any, timeout: float | None = None) -> Any:
    """Spin a node until a future is done, and return its result.

    Args:
        node: The node that the future belongs to.
        future: An rclpy future.
        timeout: Longest time [s], None for no limit.

    Raises:
        Ros2CliError: `no_answer`, the time is over.
    """
    from rclpy.executors import SingleThreadedExecutor

    deadline = None if timeout is None else time.monotonic() + timeout
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    try:
        while not future.done():
            if deadline is not None and time.monotonic() >= deadline:
                raise Ros2CliError("no_answer", f"No answer within {timeout} s")
            # In steps: while the middleware waits, Python does not see a signal.
            executor.spin_once(timeout_sec=_STEP)
    finally:
        executor.remove_node(node)
    return future.result()


def call(node: Any, service_class: Any, name: str, request: Any, *, timeout: float) -> Any:
    """Call a service that is expected to be there, and return its response.

    Raises:
        Ros2CliError: `service_unavailable`, it did not appear in time; `no_answer`.
    """
    client = node.create_client(service_class, name)
    try:
        if not client.wait_for_service(timeout_sec=timeout):
            raise Ros2CliError("service_unavailable", f"Service '{name}' is not available")
        return wait_for(node, client.call_async(request), timeout)
    finally:
        node.destroy_client(client)
