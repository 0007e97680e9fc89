# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One MCAP file of a bag: what it holds, by its summary or by reading it to its end, and writing one."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from mcap.reader import make_reader
from mcap.records import Schema as McapSchema
from mcap.writer import CompressionType, IndexType, Writer

from teo_common.mcap_salvage import DAMAGE, McapContent, NotMcapError, StoredMessage, salvage
from teo_ros2cli.bags.metadata import NO_START, FileRecord, TopicRecord, offered_qos_text
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import Schema


@dataclass
class Span:
    """First and last time [ns since the epoch] of some messages, and their number."""

    start: int = NO_START
    end: int = 0
    messages: int = 0

    def add(self, time: int) -> None:
        """Count a message of this time."""
        self.start = min(self.start, time)
        self.end = max(self.end, time)
        self.messages += 1

    @property
    def duration(self) -> int:
        """From the first message to the last [ns]; 0 without messages."""
        return max(self.end - self.start, 0)

    def record(self, file: Path) -> FileRecord:
        """Return what the metadata say of a file with these messages."""
        return FileRecord(file.name, self.start, self.duration, self.messages)


@dataclass
class FileReport(McapContent):
    """What was found in a file, with its messages counted.

    Args:
        counts: Messages by topic name.
        span: Of the messages of all topics.
    """

    counts: dict[str, int] = field(default_factory=dict)
    span: Span = field(default_factory=Span)


def stored_schema(schema: McapSchema) -> Schema:
    """Return a type's definition as a file holds it; bytes that are no UTF-8 are replaced."""
    return Schema(schema.name, schema.encoding, schema.data.decode(errors="replace"))


def summary_report(path: Path) -> FileReport | None:
    """Return the content of a file by its summary, messages unread; None if it has no good one.

    Raises:
        Ros2CliError: `bag_unreadable`.
    """
    with _faults_told(path), path.open("rb") as stream:
        try:
            reader = make_reader(stream)
            summary = reader.get_summary()
            if summary is None or summary.statistics is None:
                return None
            report = FileReport(complete=True, schemas=dict(summary.schemas))
            for identifier, channel in summary.channels.items():
                report.channels[channel.topic] = channel
                count = summary.statistics.channel_message_counts.get(identifier, 0)
                report.counts[channel.topic] = report.counts.get(channel.topic, 0) + count
            report.span.messages = sum(report.counts.values())
            if summary.statistics.message_count:
                report.span.start = summary.statistics.message_start_time
                report.span.end = summary.statistics.message_end_time
            for record in reader.iter_metadata():
                report.metadata[record.name] = dict(record.metadata)
            report.profile = reader.get_header().profile
            return report
        except DAMAGE:
            return None


def scan(path: Path) -> FileReport:
    """Read a whole file from its start and report what is in it.

    Raises:
        Ros2CliError: `bag_unreadable`, there is no such file or it cannot be read; `not_mcap`, it is none.
    """
    report = FileReport()
    for message in messages_of(path, report):
        report.counts[message.topic] = report.counts.get(message.topic, 0) + 1
        report.span.add(message.log_time)
    return report


def messages_of(
    path: Path, content: McapContent, *, topics: Collection[str] | None = None, start: int = 0
) -> Iterator[StoredMessage]:
    """Yield the messages of a file as `teo_common.mcap_salvage.salvage` does.

    Raises:
        Ros2CliError: `bag_unreadable`, or `not_mcap`.
    """
    with _faults_told(path):
        yield from salvage(path, content, topics=topics, start=start)


@contextmanager
def _faults_told(path: Path) -> Iterator[None]:
    try:
        yield
    except NotMcapError as error:
        raise Ros2CliError("not_mcap", str(error)) from error
    except OSError as error:
        raise Ros2CliError("bag_unreadable", f"'{path}' cannot be read: {error.strerror or error}") from error


_PROFILE = "ros2"
_LIBRARY = "teo_ros2cli"


class _Preset(NamedTuple):
    """How an MCAP file is laid out.

    Args:
        chunk_size: Size at which a chunk is closed [bytes, uncompressed]; 0 writes messages without chunks.
        compression: Compression of chunks.
        checksums: Store a CRC of each chunk.
    """

    chunk_size: int
    compression: CompressionType
    checksums: bool = True


PRESETS: Mapping[str, _Preset] = {
    # 1 MiB is MCAP's own default; the player reads a chunk ahead, so that the timing is not disturbed.
    "none": _Preset(1024 * 1024, CompressionType.NONE),
    "fastwrite": _Preset(0, CompressionType.NONE, checksums=False),
    # The default. A crash loses the open chunk: a quarter of the usual size, and closed every second besides.
    "zstd_fast": _Preset(256 * 1024, CompressionType.ZSTD),
    "zstd_small": _Preset(4 * 1024 * 1024, CompressionType.ZSTD),
}
DEFAULT_PRESET = "zstd_fast"


class BagFileWriter:
    """Writes one new file.

    Args:
        path: The file; it must not exist.
        preset: How it is laid out.
        ros_distro: Name of the ROS distribution that records.

    Raises:
        OSError: It exists, or cannot be written.

    Attributes:
        span: Of the messages that were written.
    """

    def __init__(self, path: Path, preset: _Preset, ros_distro: str) -> None:
        self.span = Span()
        self._path = path
        self._stream = path.open("xb")
        self._schema_ids: dict[str, int] = {}
        self._channel_ids: dict[str, int] = {}
        self._writer = Writer(
            self._stream,
            chunk_size=preset.chunk_size,
            compression=preset.compression,
            use_chunking=preset.chunk_size > 0,
            index_types=IndexType.ALL,
            enable_crcs=preset.checksums,
        )
        self._writer.start(profile=_PROFILE, library=_LIBRARY)
        self._writer.add_metadata("rosbag2", {"ROS_DISTRO": ros_distro})
        self.flush()

    @property
    def size(self) -> int:
        """What has been handed to the file, without the open chunk [bytes]."""
        return self._stream.tell()

    def add_topic(self, topic: TopicRecord, schema: Schema) -> int:
        """Write a topic's channel unless it is there, and return its identifier in the file."""
        if topic.name in self._channel_ids:
            return self._channel_ids[topic.name]
        if schema.name not in self._schema_ids:
            self._schema_ids[schema.name] = self._writer.register_schema(
                schema.name, schema.encoding, schema.text.encode()
            )
        identifier = self._writer.register_channel(
            topic=topic.name,
            message_encoding=topic.serialization_format,
            schema_id=self._schema_ids[schema.name],
            metadata={
                "offered_qos_profiles": offered_qos_text(topic.offered_qos),
                "topic_type_hash": topic.type_hash,
            },
        )
        self._channel_ids[topic.name] = identifier
        return identifier

    def write(self, channel: int, log_time: int, publish_time: int, data: bytes, sequence: int) -> None:
        """Append one message to a channel of `add_topic`; the rest is as for `BagWriter.write`."""
        self._writer.add_message(
            channel_id=channel,
            log_time=log_time,
            publish_time=publish_time,
            sequence=sequence if 0 <= sequence < 2**32 else 0,
            data=data,
        )
        self.span.add(log_time)

    def flush(self) -> None:
        """Close the open chunk and hand all that was written to the operating system."""
        self._writer.flush()  # type: ignore[no-untyped-call]

    @property
    def record(self) -> FileRecord:
        """What the metadata say of the file."""
        return self.span.record(self._path)

    def close(self, metadata: str = "") -> None:
        """Write the index and close the file.

        Args:
            metadata: The bag's own, as YAML. rosbag2 keeps them in the file as well, so that a lone file
                tells all.
        """
        if metadata:
            self._writer.add_metadata("rosbag2", {"serialized_metadata": metadata})
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._stream.close()
