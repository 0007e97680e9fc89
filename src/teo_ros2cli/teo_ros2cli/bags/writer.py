# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writing a bag: MCAP files in a directory, and `metadata.yaml` at the end."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from mcap.writer import CompressionType, IndexType, Writer

from teo_ros2cli.bags.metadata import (
    NO_START,
    BagMetadata,
    FileRecord,
    TopicRecord,
    block_text,
    offered_qos_text,
    write_metadata,
)
from teo_ros2cli.definitions import Schema
from teo_ros2cli.errors import Ros2CliError

PROFILE = "ros2"
LIBRARY = "teo_ros2cli"


class Preset(NamedTuple):
    """How an MCAP file is laid out.

    Args:
        chunk_size: Size at which a chunk is closed [bytes, uncompressed]; 0 writes messages without chunks.
        compression: Compression of chunks.
        checksums: Store a CRC of each chunk.
    """

    chunk_size: int
    compression: CompressionType
    checksums: bool = True


PRESETS: Mapping[str, Preset] = {
    # 1 MiB is MCAP's own default; the player reads a chunk ahead, so that the timing is not disturbed.
    "none": Preset(1024 * 1024, CompressionType.NONE),
    "fastwrite": Preset(0, CompressionType.NONE, checksums=False),
    # The default. A crash loses the open chunk: a quarter of the usual size, and closed every second besides.
    "zstd_fast": Preset(256 * 1024, CompressionType.ZSTD),
    "zstd_small": Preset(4 * 1024 * 1024, CompressionType.ZSTD),
}
DEFAULT_PRESET = "zstd_fast"


@dataclass
class _Channel:
    topic: TopicRecord
    schema: Schema
    messages: int = 0
    channel_id: int = 0  # in the open file


@dataclass
class _Span:
    """First and last time [ns] of some messages, and their number."""

    start: int = NO_START
    end: int = 0
    messages: int = 0

    def add(self, time: int) -> None:
        self.start = min(self.start, time)
        self.end = max(self.end, time)
        self.messages += 1

    @property
    def duration(self) -> int:
        return self.end - self.start if self.messages else 0


@dataclass
class _File:
    path: Path
    stream: io.BufferedWriter
    writer: Writer
    span: _Span = field(default_factory=_Span)
    schema_ids: dict[str, int] = field(default_factory=dict)


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
        self._span = _Span()
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
        """Make a topic known, with or without messages to follow. A known one stays as it is."""
        if topic.name not in self._channels:
            channel = _Channel(topic, schema)
            self._channels[topic.name] = channel
            self._register(channel)

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
            for known in self._channels.values():
                self._register(known)
        self._file.writer.add_message(
            channel_id=channel.channel_id,
            log_time=log_time,
            publish_time=publish_time,
            sequence=sequence if 0 <= sequence < 2**32 else 0,
            data=data,
        )
        channel.messages += 1
        self._file.span.add(log_time)
        self._span.add(log_time)

    def flush(self) -> None:
        """Close the open chunk and hand all that was written to the operating system."""
        self._file.writer.flush()  # type: ignore[no-untyped-call]

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
        return bool(self._max_size) and self._file.stream.tell() >= self._max_size

    def _open_file(self) -> _File:
        path = self.directory / f"{self.directory.name}_{len(self._finished)}.mcap"
        stream = path.open("xb")
        writer = Writer(
            stream,
            chunk_size=self._preset.chunk_size,
            compression=self._preset.compression,
            use_chunking=self._preset.chunk_size > 0,
            index_types=IndexType.ALL,
            enable_crcs=self._preset.checksums,
        )
        writer.start(profile=PROFILE, library=LIBRARY)
        writer.add_metadata("rosbag2", {"ROS_DISTRO": self._ros_distro})
        writer.flush()  # type: ignore[no-untyped-call]
        return _File(path, stream, writer)

    def _register(self, channel: _Channel) -> None:
        ids = self._file.schema_ids
        schema = channel.schema
        if schema.name not in ids:
            ids[schema.name] = self._file.writer.register_schema(
                schema.name, schema.encoding, schema.text.encode()
            )
        channel.channel_id = self._file.writer.register_channel(
            topic=channel.topic.name,
            message_encoding=channel.topic.serialization_format,
            schema_id=ids[schema.name],
            metadata={
                "offered_qos_profiles": offered_qos_text(channel.topic.offered_qos),
                "topic_type_hash": channel.topic.type_hash,
            },
        )

    def _close_file(self) -> None:
        file = self._file
        self._finished.append(
            FileRecord(file.path.name, file.span.start, file.span.duration, file.span.messages)
        )
        # rosbag2 keeps its metadata in the file as well, so that a lone file tells all.
        file.writer.add_metadata("rosbag2", {"serialized_metadata": block_text(self._metadata().to_tree())})
        file.writer.finish()  # type: ignore[no-untyped-call]
        file.stream.close()

    def _metadata(self) -> BagMetadata:
        return BagMetadata(
            files=tuple(self._finished),
            topics=tuple((channel.topic, channel.messages) for channel in self._channels.values()),
            start=self._span.start,
            duration=self._span.duration,
            custom_data=self._custom_data,
            ros_distro=self._ros_distro,
        )
