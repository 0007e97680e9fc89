# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Reading an MCAP file from its front: whole, cut off or damaged.

A recorder that is killed leaves a file without its last records: no summary, maybe half a chunk. All that is
before the cut is good, and is read; a chunk whose checksum is wrong is left out and counted.

Needs the Python package `mcap`, which brings `zstandard`; nothing else in this package does.
"""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from mcap.exceptions import McapError
from mcap.records import Channel, Chunk, Header, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import MCAP0_MAGIC
from zstandard import ZstdError

# All that the library raises on bytes that are no MCAP.
DAMAGE = (
    McapError,
    ZstdError,
    struct.error,
    ValueError,
    KeyError,
    IndexError,
    EOFError,
    OverflowError,
    MemoryError,
    RuntimeError,  # lz4
)


class NotMcapError(ValueError):
    """The file does not begin as MCAP files do."""


class StoredMessage(NamedTuple):
    """One message as stored.

    Args:
        topic: Name of its topic.
        type: Name of its type, such as `std_msgs/msg/String`; empty if the file does not tell.
        log_time: Time of reception [ns since the epoch].
        publish_time: Time of publishing [ns since the epoch].
        data: Its bytes (CDR).
        sequence: The publisher's number of it, 0 if there was none.
    """

    topic: str
    type: str
    log_time: int
    publish_time: int
    data: bytes
    sequence: int = 0


@dataclass
class McapContent:
    """What was found in a file besides its messages.

    Args:
        channels: By topic name.
        schemas: By identifier.
        complete: The file ends as it should.
        damaged_chunks: Number of chunks left out because they could not be read.
        fault: Why reading stopped early; empty in a complete file.
        metadata: Metadata records by name, the last of each.
        profile: The file's profile: `ros2` for messages of ROS 2.
    """

    channels: dict[str, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    complete: bool = False
    damaged_chunks: int = 0
    fault: str = ""
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    profile: str = ""


def salvage(
    path: Path, content: McapContent, *, topics: Collection[str] | None = None, start: int = 0
) -> Iterator[StoredMessage]:
    """Yield the messages of a file, in file order, as far as it can be read.

    Args:
        path: The file.
        content: Filled as reading goes on.
        topics: Names to yield, None for all.
        start: Messages of chunks that end before this time [ns] are left out.

    Raises:
        NotMcapError: It does not begin as an MCAP file.
        OSError: It cannot be read.
    """
    with path.open("rb") as stream:
        size = path.stat().st_size
        if stream.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            what = "it is empty" if size == 0 else "it does not begin as one"
            raise NotMcapError(f"'{path}' is not an MCAP file: {what}")
        stream.seek(0)
        # A damaged record may claim any length: none that is longer than the file is believed.
        records = StreamReader(stream, emit_chunks=True, validate_crcs=True, record_size_limit=size).records
        channels: dict[int, Channel] = {}
        while True:
            try:
                record = next(records)
            except StopIteration:
                content.complete = True
                return
            except DAMAGE as error:
                content.fault = str(error).strip() or "it ends in the middle of a record"
                return
            yield from _messages_of(record, content, channels, topics, start)


def _messages_of(
    record: McapRecord,
    content: McapContent,
    channels: dict[int, Channel],
    topics: Collection[str] | None,
    start: int,
) -> Iterator[StoredMessage]:
    match record:
        case Chunk():
            # An early chunk is read all the same: the channels of later messages may be in it.
            try:
                inner = breakup_chunk(record, validate_crc=True)
            except DAMAGE:
                content.damaged_chunks += 1
                return
            early = record.message_end_time < start
            for part in inner:
                if not early or not isinstance(part, Message):
                    yield from _messages_of(part, content, channels, topics, start)
        case Schema():
            content.schemas.setdefault(record.id, record)
        case Channel():
            channels[record.id] = record
            content.channels.setdefault(record.topic, record)
        case Metadata():
            content.metadata[record.name] = dict(record.metadata)
        case Message() if record.channel_id in channels:
            # A message whose channel was in a damaged chunk cannot be told to any topic.
            channel = channels[record.channel_id]
            if topics is None or channel.topic in topics:
                schema = content.schemas.get(channel.schema_id)
                yield StoredMessage(
                    channel.topic,
                    schema.name if schema else "",
                    record.log_time,
                    record.publish_time,
                    record.data,
                    record.sequence,
                )
        case Header():
            content.profile = record.profile
