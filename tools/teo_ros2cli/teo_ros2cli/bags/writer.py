# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writing a bag: MCAP files in a directory, and `metadata.yaml` at the end."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from teo_ros2cli.bags.file_writer import DEFAULT_PRESET, PRESETS, BagFileWriter, Span
from teo_ros2cli.bags.metadata import BagMetadata, FileRecord, TopicRecord, block_text, write_metadata
from teo_ros2cli.definitions import Schema
from teo_ros2cli.errors import Ros2CliError


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
