"""Receiving messages of topics until there is a reason to stop."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

Receiver = Callable[[str, Any, dict[str, Any]], None]
"""Takes a topic's name, a message (bytes if raw) and rclpy's information on it."""


def listen(
    node: Any,
    topics: Mapping[str, tuple[Any, Any]],
    receive: Receiver,
    *,
    raw: bool = False,
    until: Callable[[], bool] = lambda: False,
    deadline: float | None = None,
    report_lost: bool = False,
    every: tuple[float, Callable[[], None]] | None = None,
) -> None:
    """Subscribe to topics and pass their messages on; a context that is shut down ends it with an exception.

    Args:
        node: The node.
        topics: Class of the messages and QoS profile, by full topic name.
        receive: Called with each message.
        raw: Pass messages on as they came from the wire.
        until: Asked after each step; True ends.
        deadline: Moment of the steady clock at which to end [s], None for never.
        report_lost: Print a note when the middleware tells that a message was lost.
        every: A period [s] and what to do in it.
    """
    from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

    def subscribe(topic: str, message_class: Any, profile: Any, events: Any) -> None:
        node.create_subscription(
            message_class,
            topic,
            lambda message, info: receive(topic, message, info),
            profile,
            raw=raw,
            event_callbacks=events,
        )

    for topic, (cls, profile) in topics.items():
        try:
            events = SubscriptionEventCallbacks(message_lost=_tell_lost if report_lost else None)
            subscribe(topic, cls, profile, events)
        except UnsupportedEventTypeError:
            subscribe(topic, cls, profile, None)
    if every is not None:
        # Of this machine's time: a simulated clock may stand still.
        from rclpy.clock import Clock
        from rclpy.clock_type import ClockType

        node.create_timer(*every, clock=Clock(clock_type=ClockType.STEADY_TIME))
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    try:
        while not until():
            left = None if deadline is None else deadline - time.monotonic()
            if left is not None and left <= 0:
                return
            executor.spin_once(timeout_sec=left)
            if not node.context.ok():
                raise ExternalShutdownException  # SIGTERM
    finally:
        executor.remove_node(node)


def _tell_lost(status: Any) -> None:
    print(
        f"A message was lost!!!\n\ttotal count change:{status.total_count_change}\n\ttotal count: "
        f"{status.total_count}",
        end="---\n",
    )
