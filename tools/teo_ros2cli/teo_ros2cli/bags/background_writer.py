# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writing a bag from a thread of its own, so that whoever receives messages never waits for the disk."""

from __future__ import annotations

import queue
import threading
import time
from typing import NamedTuple

from teo_ros2cli.bags.metadata import BagMetadata, TopicRecord
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.definitions import Schema
from teo_ros2cli.errors import Ros2CliError

# How often what was written goes to the operating system [s]: what a crash of this process loses.
FLUSH_INTERVAL = 1.0


class Arrival(NamedTuple):
    """A message to be written; see `BagWriter.write`."""

    topic: str
    log_time: int
    publish_time: int
    data: bytes
    sequence: int = 0


class _NewTopic(NamedTuple):
    topic: TopicRecord
    schema: Schema


class BackgroundWriter:
    """Passes topics and messages to a bag in the order in which they came.

    Args:
        writer: The bag; owned by the thread until `close` returns.
        cache_size: Bytes of messages that may wait; 0 for no limit.
    """

    def __init__(self, writer: BagWriter, cache_size: int) -> None:
        self._writer = writer
        self._cache_size = cache_size
        self._queue: queue.SimpleQueue[Arrival | _NewTopic | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._waiting = 0
        self._failure: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="bag writer")
        self._thread.start()

    def check(self) -> None:
        """Raise what stopped the writing, if anything did.

        Raises:
            Ros2CliError: `bag_unwritable`.
        """
        if self._failure is not None:
            raise Ros2CliError(
                "bag_unwritable",
                f"The bag cannot be written: {self._failure}. What came before can be read; "
                f"`ros2 bag reindex {self._writer.directory}` finishes it, where there is room.",
            ) from self._failure

    def add_topic(self, topic: TopicRecord, schema: Schema) -> None:
        """Make a topic known before its first message, or tell its profiles anew."""
        self._queue.put(_NewTopic(topic, schema))

    def write(self, arrival: Arrival) -> bool:
        """Take a message; False if too much waits already, and the message is not taken."""
        size = len(arrival.data)
        with self._lock:
            if self._cache_size and self._waiting and self._waiting + size > self._cache_size:
                return False
            self._waiting += size
        self._queue.put(arrival)
        return True

    def close(self) -> BagMetadata:
        """Write what waits, and finish the bag, as far as it can be written.

        Raises:
            Ros2CliError: `bag_unwritable`.
        """
        self._queue.put(None)
        self._thread.join()
        try:
            metadata = self._writer.close()
        except OSError as error:
            self._failure = self._failure or error
        self.check()
        return metadata

    def _run(self) -> None:
        flushed, dirty = time.monotonic(), False
        while True:
            try:
                item = self._queue.get(timeout=FLUSH_INTERVAL)
            except queue.Empty:
                item = _NOTHING
            if item is None:
                return
            try:
                if self._failure is None:
                    dirty = self._pass_on(item) or dirty
                    now = time.monotonic()
                    if dirty and now - flushed >= FLUSH_INTERVAL:
                        self._writer.flush()
                        flushed, dirty = now, False
            except Exception as error:  # told by check() to whoever uses the bag
                self._failure = error

    def _pass_on(self, item: Arrival | _NewTopic) -> bool:
        """Hand an item to the bag; True if it was a message."""
        if isinstance(item, _NewTopic):
            if item is not _NOTHING:
                self._writer.add_topic(item.topic, item.schema)
            return False
        self._writer.write(*item)
        with self._lock:
            self._waiting -= len(item.data)
        return True


# Stands for a moment in which nothing came.
_NOTHING = _NewTopic(TopicRecord("", ""), Schema("", "", ""))
