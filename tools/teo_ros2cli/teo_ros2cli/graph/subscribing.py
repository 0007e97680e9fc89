# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Receiving messages by subscriptions that fit themselves to their publishers, later ones included."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Collection
from dataclasses import replace
from typing import Any

from teo_ros2cli.graph.cli_node import executor_of
from teo_ros2cli.qos import QosRecord, from_record, request_for, serves, to_record

# Messages that may wait in the middleware while Python is busy elsewhere: 10 s of a topic at 100 Hz. The
# queue drops its oldest when full, so that a slow receiver never holds a publisher back.
_QUEUE_DEPTH = 1000
# Messages whose identity is kept to know one that comes a second time: more than any latched topic keeps.
_REMEMBERED = 2000

# Time that a replaced subscription goes on receiving [s]: what was on its way to it, a latched message above
# all, comes again with the next heartbeat, which Fast DDS sends every 3 s.
_OVERLAP = 5.0

# Takes a message (bytes if raw) and rclpy's information on it.
_Receiver = Callable[[Any, dict[str, Any]], None]


class AdaptiveSubscription:
    """Asks for what all publishers serve: reliable and latched messages if all of them offer these.

    When a publisher comes that offers less, or when the first ones turn out to be latched, the subscription
    is replaced; no message is lost or passed on twice by that.

    Args:
        node: The node to subscribe with.
        topic: Full topic name.
        message_class: Class of the messages.
        receive: Called with each message.
        fixed: Profile to ask for in any case, instead of fitting.
        raw: Pass messages on as they came from the wire.
        warn: Called with a sentence for each thing that cannot be had.
        lost: Called with the number of messages that the middleware says were lost; None if nobody cares.

    Attributes:
        offers: What the publishers offer that were there when they were most. A publisher that has left
            since, as they do one by one when a graph ends, is still among them.
        request: The profile that is asked for now.
    """

    def __init__(
        self,
        node: Any,
        topic: str,
        message_class: Any,
        receive: _Receiver,
        *,
        fixed: QosRecord | None = None,
        raw: bool = False,
        warn: Callable[[str], object],
        lost: Callable[[int], None] | None = None,
    ) -> None:
        self._node = node
        self._topic = topic
        self._class = message_class
        self._pass_on = receive
        self._fixed = fixed
        self._raw = raw
        self._warn = warn
        self._lost = lost
        self._told = False
        self.offers = self._offers()
        # Without publishers there is nothing to fit yet; a latched subscription may bring a message again.
        self._blind = not self.offers
        self._repetitions = _Repetitions() if self._blind else None
        self.request = fixed or request_for(topic, self.offers, warn)
        self._subscription = self._subscribe()
        # Replaced ones, each with the moment of the steady clock at which it ends [s].
        self._retiring: list[tuple[Any, float]] = []

    def adapt(self) -> None:
        """Look at the publishers, and replace the subscription if it does not fit them."""
        if self._retiring and time.monotonic() >= self._retiring[0][1]:
            self._end(self._retiring.pop(0)[0])
        offers = self._offers()
        if not offers:
            return
        if len(offers) >= len(self.offers) and offers != self.offers:
            self.offers = offers
        unserved = not all(serves(offer, self.request) for offer in offers)
        if self._fixed is not None:
            if unserved and not self._told:
                self._told = True
                self._warn(
                    f"A publisher of topic '{self._topic}' offers less than the profile asks for: its "
                    "messages are not received."
                )
            return
        latched = self._blind and all(offer.durability == "transient_local" for offer in offers)
        self._blind = False
        if unserved or latched:
            self._replace(request_for(self._topic, offers, self._warn))

    def close(self) -> None:
        """Pass on what still waits in the middleware, and end the subscription."""
        for subscription in (*(old for old, _ in self._retiring), self._subscription):
            self._end(subscription)

    def _offers(self) -> tuple[QosRecord, ...]:
        publishers = self._node.get_publishers_info_by_topic(self._topic)
        return tuple(to_record(info.qos_profile) for info in publishers)

    def _replace(self, request: QosRecord) -> None:
        # For a while both subscriptions receive: what comes twice is known from here on.
        self._repetitions = self._repetitions or _Repetitions()
        old, self.request = self._subscription, request
        self._subscription = self._subscribe()
        self._drain(old)
        self._retiring.append((old, time.monotonic() + _OVERLAP))

    def _end(self, subscription: Any) -> None:
        self._drain(subscription)
        self._node.destroy_subscription(subscription)

    def _subscribe(self) -> Any:
        from rclpy.event_handler import SubscriptionEventCallbacks, UnsupportedEventTypeError

        profile = from_record(replace(self.request, depth=max(self.request.depth, _QUEUE_DEPTH)))
        lost = self._lost
        told = None if lost is None else lambda status: lost(status.total_count_change)

        def subscribe(callback: Callable[[Any], object] | None) -> Any:
            events = SubscriptionEventCallbacks(message_lost=callback, use_default_callbacks=False)
            return self._node.create_subscription(
                self._class, self._topic, self._receive, profile, raw=self._raw, event_callbacks=events
            )

        try:
            return subscribe(told)
        except UnsupportedEventTypeError:
            return subscribe(None)

    def _receive(self, message: Any, info: dict[str, Any]) -> None:
        if not self.offers:
            self.offers = self._offers()  # whoever sent this is known by now
        if self._repetitions is None or self._repetitions.is_new(info):
            self._pass_on(message, info)

    def _drain(self, subscription: Any) -> None:
        while True:
            with subscription.handle:
                taken = subscription.handle.take_message(subscription.msg_type, self._raw)
            if taken is None:
                return
            self._receive(*taken)


class _Repetitions:
    """Knows a message that comes a second time, by its time of publishing and its number."""

    def __init__(self) -> None:
        self._seen: OrderedDict[tuple[int, int], None] = OrderedDict()

    def is_new(self, info: dict[str, Any]) -> bool:
        key = (info["source_timestamp"], info.get("publication_sequence_number") or 0)
        if key in self._seen:
            return False
        self._seen[key] = None
        if len(self._seen) > _REMEMBERED:
            self._seen.popitem(last=False)
        return True


# Interval of fitting the subscriptions to their publishers [s].
_FITTING = 0.1

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
    from rclpy.executors import ExternalShutdownException

    if every is not None:
        # Of this machine's time: a simulated clock may stand still.
        from rclpy.clock import Clock
        from rclpy.clock_type import ClockType

        node.create_timer(*every, clock=Clock(clock_type=ClockType.STEADY_TIME))
    fitted = 0.0
    with executor_of(node) as executor:
        while not until():
            now = time.monotonic()
            if deadline is not None and now >= deadline:
                return
            if now - fitted >= _FITTING:
                fitted = now
                for subscription in subscriptions:
                    subscription.adapt()
            executor.spin_once(timeout_sec=_FITTING if deadline is None else min(_FITTING, deadline - now))
            if not node.context.ok():
                raise ExternalShutdownException  # SIGTERM
