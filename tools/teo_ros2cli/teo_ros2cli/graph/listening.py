# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Receiving messages until there is a reason to stop."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from typing import Any

from teo_ros2cli.bags.qos_record import QosRecord
from teo_ros2cli.graph.adaptive import AdaptiveSubscription

# Interval of fitting the subscriptions to their publishers [s].
_STEP = 0.1

# What every publisher serves: for measuring, where a message that was lost is part of the result.
ANYTHING = QosRecord(reliability="best_effort")


def listen(
    node: Any,
    subscriptions: Collection[AdaptiveSubscription],
    *,
    until: Callable[[], bool] = lambda: False,
    deadline: float | None = None,
    every: tuple[float, Callable[[], None]] | None = None,
) -> None:
    """Let subscriptions receive; a context that is shut down ends it with rclpy's exception for that.

    Args:
        node: The node that they belong to.
        subscriptions: The subscriptions.
        until: Asked after each step; True ends.
        deadline: Moment of the steady clock at which to end [s], None for never.
        every: A period [s] and what to do in it.
    """
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

    if every is not None:
        # Of this machine's time: a simulated clock may stand still.
        from rclpy.clock import Clock
        from rclpy.clock_type import ClockType

        node.create_timer(*every, clock=Clock(clock_type=ClockType.STEADY_TIME))
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    fitted = 0.0
    try:
        while not until():
            now = time.monotonic()
            if deadline is not None and now >= deadline:
                return
            if now - fitted >= _STEP:
                fitted = now
                for subscription in subscriptions:
                    subscription.adapt()
            executor.spin_once(timeout_sec=_STEP if deadline is None else min(_STEP, deadline - now))
            if not node.context.ok():
                raise ExternalShutdownException  # SIGTERM
    finally:
        executor.remove_node(node)
