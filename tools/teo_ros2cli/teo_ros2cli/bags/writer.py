# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writing a bag: MCAP files in a directory, `metadata.yaml` at the end; also from a thread of its own."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from teo_ros2cli.bags.mcap_file import DEFAULT_PRESET, PRESETS, BagFileWriter, Span
from teo_ros2cli.bags.metadata import BagMetadata, FileRecord, TopicRecord, block_text, write_metadata
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import Schema


@dataclass
class _Channel:
    topic: TopicRecord
    schema: Schema
    messages: int = 0


class BagWriter:
    """Writes one bag. Not thread-safe: one thread owns it.

    Args:
        directory: Directory to create; its name is the stem of the files.
        preset: Name in `PRESETS`.
        max_duration: Longest time in one file [ns]; 0 for no limit.
        max_size: Size at which a file is closed and the next one opened [bytes]; 0 for no limit.
        custom_data: Free text by name, kept in the metadata.
        ros_distro: Name of the ROS distribution that records.

    Raises:
        Ros2CliError: `output_exists`, `output_unwritable`, or `invalid_preset`.
    """

    def __init__(
        self,
        directory: Path,
        *,
        preset: str = DEFAULT_PRESET,
        max_duration: int = 0,
        max_size: int = 0,
        custom_data: Mapping[str, str] | None = None,
        ros_distro: str = "jazzy",
    ) -> None:
        if preset not in PRESETS:
            raise Ros2CliError(
                "invalid_preset", f"Unknown preset '{preset}': expected one of {', '.join(PRESETS)}"
            )
        self._preset = PRESETS[preset]
        self._max_duration = max_duration
        self._max_size = max_size
        self._custom_data = dict(custom_data or {})
        self._ros_distro = ros_distro
        self._channels: dict[str, _Channel] = {}
        self._span = Span()
        self._finished: list[FileRecord] = []
        self.directory = directory
        try:
            directory.mkdir(parents=True)
        except FileExistsError as error:
            raise Ros2CliError("output_exists", f"Output folder '{directory}' already exists.") from error
        except OSError as error:
            raise Ros2CliError(
                "output_unwritable", f"Output folder '{directory}' cannot be made: {error}"
            ) from error
        self._file = self._open_file()

    def add_topic(self, topic: TopicRecord, schema: Schema) -> None:
        """Make a topic known, with or without messages to follow; of a known one only the profiles change.

        A file's channel tells what is known when the topic's first message comes to that file, and the
        metadata what is known at the end.
        """
        known = self._channels.setdefault(topic.name, _Channel(topic, schema))
        known.topic = replace(known.topic, offered_qos=topic.offered_qos)

    def write(self, topic: str, log_time: int, publish_time: int, data: bytes, sequence: int = 0) -> None:
        """Append one message.

        Args:
            topic: Name of a topic that was added.
            log_time: Time of reception [ns since the epoch].
            publish_time: Time of publishing, as the publisher stamped it [ns since the epoch].
            data: The message as it was on the wire: CDR with its encapsulation header.
            sequence: The publisher's number of the message, 0 if it has none.
        """
        channel = self._channels[topic]
        if self._must_split(log_time):
            self._close_file()
            self._file = self._open_file()
        identifier = self._file.add_topic(channel.topic, channel.schema)
        self._file.write(identifier, log_time, publish_time, data, sequence)
        channel.messages += 1
        self._span.add(log_time)

    def flush(self) -> None:
        """Close the open chunk and hand all that was written to the operating system."""
        self._file.flush()

    def close(self) -> BagMetadata:
        """Finish the file and write the metadata."""
        self._close_file()
        metadata = self._metadata()
        write_metadata(self.directory, metadata)
        return metadata

    def _must_split(self, time: int) -> bool:
        span = self._file.span
        if not span.messages:
            return False
        if self._max_duration and time - span.start >= self._max_duration:
            return True
        return bool(self._max_size) and self._file.size >= self._max_size

    def _open_file(self) -> BagFileWriter:
        path = self.directory / f"{self.directory.name}_{len(self._finished)}.mcap"
        return BagFileWriter(path, self._preset, self._ros_distro)

    def _close_file(self) -> None:
        for channel in self._channels.values():  # topics without messages as well
            self._file.add_topic(channel.topic, channel.schema)
        self._finished.append(self._file.record)
        self._file.close(block_text(self._metadata().to_tree()))

    def _metadata(self) -> BagMetadata:
        return BagMetadata(
            files=tuple(self._finished),
            topics=tuple((channel.topic, channel.messages) for channel in self._channels.values()),
            start=self._span.start,
            duration=self._span.duration,
            custom_data=self._custom_data,
            ros_distro=self._ros_distro,
        )


# How often what was written goes to the operating system [s]: what a crash of this process loses.
_FLUSH_INTERVAL = 1.0


class BackgroundWriter:
    """Passes topics and messages to a bag in the order in which they came.

    Args:
        writer: The bag; owned by the thread until `close` returns.
        cache_size: Bytes of messages that may wait; 0 for no limit.
    """

    def __init__(self, writer: BagWriter, cache_size: int) -> None:
        self._writer = writer
        self._cache_size = cache_size
        # What is to be done with the bag; None for nothing more.
        self._queue: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._waiting = 0
        self._unflushed = False
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
        self._queue.put(partial(self._writer.add_topic, topic, schema))

    def write(self, topic: str, log_time: int, publish_time: int, data: bytes, sequence: int = 0) -> bool:
        """Take a message as `BagWriter.write`; False if too much waits already, and it is not taken."""
        size = len(data)
        with self._lock:
            if self._cache_size and self._waiting and self._waiting + size > self._cache_size:
                return False
            self._waiting += size
        self._queue.put(partial(self._write, topic, log_time, publish_time, data, sequence))
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
        flushed = time.monotonic()
        while True:
            try:
                act = self._queue.get(timeout=_FLUSH_INTERVAL)
            except queue.Empty:
                act = _do_nothing
            if act is None:
                return
            if self._failure is not None:
                continue
            try:
                act()
                now = time.monotonic()
                if self._unflushed and now - flushed >= _FLUSH_INTERVAL:
                    self._writer.flush()
                    flushed, self._unflushed = now, False
            except Exception as error:  # told by check() to whoever uses the bag
                self._failure = error

    def _write(self, topic: str, log_time: int, publish_time: int, data: bytes, sequence: int) -> None:
        self._writer.write(topic, log_time, publish_time, data, sequence)
        self._unflushed = True
        with self._lock:
            self._waiting -= len(data)


def _do_nothing() -> None:
    pass
