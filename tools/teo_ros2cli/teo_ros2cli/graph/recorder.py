# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recording topics of a running graph into a bag."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from teo_ros2cli.bags.metadata import BagMetadata, TopicRecord
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.bags.writer import BackgroundWriter, BagWriter
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.subscribing import AdaptiveSubscription
from teo_ros2cli.interfaces import Schema, installed_type_hash, message_class, schema_of
from teo_ros2cli.qos import QosRecord


class RecorderSettings(NamedTuple):
    """What the recorder is told.

    Args:
        selection: Which topics to record.
        polling_interval: Time between two looks at the graph [s].
        discovery: Go on looking for topics after the first look.
        include_unpublished: Subscribe to topics that nobody publishes yet.
        ignore_leaf: Leave out topics that nobody else subscribes to.
        overrides: Profile to subscribe with, by topic name.
        cache_size: Bytes of messages that may wait for being written.
        start_paused: Begin without recording.
        use_sim_time: Take times of reception from the node's clock, and record nothing before it runs.
    """

    selection: TopicSelection
    polling_interval: float
    discovery: bool
    include_unpublished: bool
    ignore_leaf: bool
    overrides: Mapping[str, QosRecord]
    cache_size: int
    start_paused: bool
    use_sim_time: bool


class Recorder:
    """Subscribes to the topics of a node's graph and writes their messages from a thread of its own.

    Args:
        node: The node to subscribe with; its executor is the caller's.
        writer: The bag; owned by the recorder from now on.
        settings: What to record and how.
    """

    def __init__(self, node: Any, writer: BagWriter, settings: RecorderSettings) -> None:
        self._node = node
        self._bag = BackgroundWriter(writer, settings.cache_size)
        self._settings = settings
        self._log = node.get_logger()
        self._subscriptions: dict[str, AdaptiveSubscription] = {}
        self._topics: dict[str, TopicRecord] = {}
        self._schemas: dict[str, Schema] = {}
        self._refused: set[tuple[str, str]] = set()
        self._lost: dict[str, int] = {}
        self._paused = settings.start_paused
        self._discovering = True
        self._next_look = 0.0

    def toggle_paused(self) -> None:
        """Pause, or go on recording."""
        self._paused = not self._paused
        self._log.info("Pausing recording." if self._paused else "Resuming recording.")

    def look(self, now: float) -> None:
        """Look for topics to record, if it is time to.

        Args:
            now: Moment of the steady clock [s].

        Raises:
            Ros2CliError: `bag_unwritable`, writing has failed.
        """
        self._bag.check()
        if now < self._next_look:
            return
        self._next_look = now + self._settings.polling_interval
        for name, subscription in self._subscriptions.items():
            subscription.adapt()
            self._note_offers(name)
        if not self._discovering:
            return
        for name, types in self._node.get_topic_names_and_types():
            if name not in self._subscriptions:
                self._consider(name, list(types))
        wanted = self._settings.selection
        if not self._settings.discovery:
            self._discovering = False
        elif wanted.only_names and wanted.names - wanted.excluded_names <= self._subscriptions.keys():
            self._discovering = False
            self._log.info("All requested topics are subscribed. Stopping discovery...")

    def finish(self) -> BagMetadata:
        """Take what still waits in the subscriptions, write all, and close the bag.

        Raises:
            Ros2CliError: `bag_unwritable`.
        """
        for subscription in self._subscriptions.values():
            subscription.close()
        if self._lost:
            counts = "".join(f"\n\t{name}: {count}" for name, count in sorted(self._lost.items()))
            self._log.warning(f"Messages lost per topic: {counts}\nTotal lost: {sum(self._lost.values())}")
        return self._bag.close()

    def _consider(self, name: str, types: list[str]) -> None:
        if len(types) > 1:
            self._refuse(name, ", ".join(types), "it has more than one type")
            return
        type_name = types[0]
        if not self._settings.selection.accepts(name, type_name) or (name, type_name) in self._refused:
            return
        if not self._settings.include_unpublished and not self._node.count_publishers(name):
            return
        if self._settings.ignore_leaf and not self._node.count_subscribers(name):
            return
        try:
            cls = message_class(type_name)
            schema = schema_of(type_name)
        except Ros2CliError as error:
            self._refuse(name, type_name, str(error))
            return
        self._subscribe(name, type_name, cls, schema)

    def _refuse(self, name: str, type_name: str, reason: str) -> None:
        if (name, type_name) not in self._refused:
            self._refused.add((name, type_name))
            self._log.warning(
                f"Topic '{name}' has unknown type '{type_name}' associated. Only topics with known type are "
                f"supported. Reason: '{reason}'."
            )

    def _subscribe(self, name: str, type_name: str, cls: Any, schema: Schema) -> None:
        override = self._settings.overrides.get(name)
        if override is not None:
            self._log.info(f"Overriding subscription profile for {name}")
        subscription = AdaptiveSubscription(
            self._node,
            name,
            cls,
            lambda data, info: self._receive(name, data, info),
            fixed=override,
            raw=True,
            warn=self._log.warning,
            lost=lambda count: self._note_lost(name, count),
        )
        self._subscriptions[name] = subscription
        self._topics[name] = TopicRecord(name, type_name, self._type_hash(name, type_name))
        self._schemas[name] = schema
        self._bag.add_topic(self._topics[name], schema)
        self._note_offers(name)
        self._log.info(f"Subscribed to topic '{name}'")

    def _note_offers(self, name: str) -> None:
        """Tell the bag what a topic's publishers offer, if that is news."""
        offered = self._subscriptions[name].offers
        if offered is not self._topics[name].offered_qos:  # of the same object for each of its messages
            self._topics[name] = replace(self._topics[name], offered_qos=offered)
            self._bag.add_topic(self._topics[name], self._schemas[name])

    def _type_hash(self, name: str, type_name: str) -> str:
        for info in self._node.get_publishers_info_by_topic(name):
            text = str(info.topic_type_hash)
            if text.startswith("RIHS"):
                return text
        return installed_type_hash(type_name)

    def _receive(self, name: str, data: bytes, info: dict[str, Any]) -> None:
        if self._paused:
            return
        received = info["received_timestamp"]
        if self._settings.use_sim_time:
            received = self._node.get_clock().now().nanoseconds
            if received == 0:
                return  # the simulated clock does not run yet
        sequence = info.get("publication_sequence_number") or 0
        self._note_offers(name)
        if not self._bag.write(name, received, info["source_timestamp"], data, sequence):
            self._note_lost(name, 1)

    def _note_lost(self, name: str, count: int) -> None:
        if name not in self._lost:
            self._log.warning(f"Messages of topic '{name}' are being lost")
        self._lost[name] = self._lost.get(name, 0) + count
