"""Reading one MCAP file, whole, cut off or damaged.

A recorder that is killed leaves a file without its last records: no summary, maybe half a chunk. All that is
before the cut is good, and is read; a chunk whose checksum is wrong is left out and counted.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Channel, Chunk, Header, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import MCAP0_MAGIC

from teo_ros2cli.errors import Ros2CliError

try:
    from zstandard import ZstdError
except ImportError:  # only without zstandard, and then there is nothing that raises it

    class ZstdError(Exception):  # type: ignore[no-redef]
        """Stands in for the missing class."""


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


class StoredMessage(NamedTuple):
    """One message: topic, times [ns since the epoch] of reception and publishing, and the bytes (CDR)."""

    topic: str
    log_time: int
    publish_time: int
    data: bytes


@dataclass
class FileReport:
    """What was found in a file that was read to its end.

    Args:
        channels: By topic name.
        schemas: By identifier.
        counts: Messages by topic name.
        start: Time of the first message [ns]; meaningless without messages.
        end: Time of the last message [ns].
        complete: The file ends as it should.
        damaged_chunks: Chunks left out because they could not be read.
        fault: Why reading stopped early; empty in a complete file.
        metadata: Metadata records by name, the last of each.
        profile: The file's profile: `ros2` for messages of ROS 2.
    """

    channels: dict[str, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    start: int = 2**63 - 1
    end: int = 0
    complete: bool = False
    damaged_chunks: int = 0
    fault: str = ""
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    profile: str = ""

    @property
    def messages(self) -> int:
        """Number of messages of all topics."""
        return sum(self.counts.values())

    def note(self, topic: str, time: int) -> None:
        """Count a message."""
        self.counts[topic] = self.counts.get(topic, 0) + 1
        self.start = min(self.start, time)
        self.end = max(self.end, time)


def summary_report(path: Path) -> FileReport | None:
    """Return the content of a file by its summary, messages unread; None if it has no good one."""
    try:
        with path.open("rb") as stream:
            reader = make_reader(stream)
            summary = reader.get_summary()
            if summary is None or summary.statistics is None:
                return None
            report = FileReport(complete=True, schemas=dict(summary.schemas))
            for identifier, channel in summary.channels.items():
                report.channels[channel.topic] = channel
                count = summary.statistics.channel_message_counts.get(identifier, 0)
                report.counts[channel.topic] = report.counts.get(channel.topic, 0) + count
            if summary.statistics.message_count:
                report.start = summary.statistics.message_start_time
                report.end = summary.statistics.message_end_time
            for record in reader.iter_metadata():
                report.metadata[record.name] = dict(record.metadata)
            report.profile = reader.get_header().profile
            return report
    except OSError as error:
        raise _unreadable(path, error) from error
    except DAMAGE:
        return None


def scan(path: Path, on_message: Callable[[StoredMessage], None] | None = None) -> FileReport:
    """Read a whole file from its start and report what is in it.

    Args:
        path: The file.
        on_message: Called with each message, in file order.

    Raises:
        Ros2CliError: `bag_unreadable`, there is no such file or it cannot be read; `not_mcap`, it is none.
    """
    report = FileReport()
    for message in iterate(path, report=report):
        report.note(message.topic, message.log_time)
        if on_message is not None:
            on_message(message)
    return report


def iterate(
    path: Path,
    *,
    report: FileReport | None = None,
    topics: Collection[str] | None = None,
    start: int = 0,
) -> Iterator[StoredMessage]:
    """Yield the messages of a file, in file order, as far as it can be read.

    Args:
        path: The file.
        report: Filled as reading goes on, all but the counts.
        topics: Names to yield, None for all.
        start: Messages of chunks that end before this time [ns] are left out.

    Raises:
        Ros2CliError: `bag_unreadable`, or `not_mcap`.
    """
    report = report if report is not None else FileReport()
    try:
        stream = path.open("rb")
        size = path.stat().st_size
    except OSError as error:
        raise _unreadable(path, error) from error
    with stream:
        if stream.read(len(MCAP0_MAGIC)) != MCAP0_MAGIC:
            what = "it is empty" if size == 0 else "it does not begin as one"
            raise Ros2CliError("not_mcap", f"'{path}' is not an MCAP file: {what}")
        stream.seek(0)
        # A damaged record may claim any length: none that is longer than the file is believed.
        records = StreamReader(stream, emit_chunks=True, validate_crcs=True, record_size_limit=size).records
        names: dict[int, str] = {}
        while True:
            try:
                record = next(records)
            except StopIteration:
                report.complete = True
                return
            except DAMAGE as error:
                report.fault = str(error).strip() or "it ends in the middle of a record"
                return
            except OSError as error:
                raise _unreadable(path, error) from error
            yield from _messages_of(record, report, names, topics, start)


def _messages_of(
    record: McapRecord,
    report: FileReport,
    names: dict[int, str],
    topics: Collection[str] | None,
    start: int,
) -> Iterator[StoredMessage]:
    if isinstance(record, Chunk):
        # An early chunk is read all the same: the channels of later messages may be in it.
        try:
            inner = breakup_chunk(record, validate_crc=True)
        except DAMAGE:
            report.damaged_chunks += 1
            return
        early = record.message_end_time < start
        for part in inner:
            if not early or not isinstance(part, Message):
                yield from _messages_of(part, report, names, topics, start)
    elif isinstance(record, Schema):
        report.schemas.setdefault(record.id, record)
    elif isinstance(record, Channel):
        names[record.id] = record.topic
        report.channels.setdefault(record.topic, record)
    elif isinstance(record, Metadata):
        report.metadata[record.name] = dict(record.metadata)
    elif isinstance(record, Message):
        name = names.get(record.channel_id)
        # A message whose channel was in a damaged chunk cannot be told to any topic.
        if name is not None and (topics is None or name in topics):
            yield StoredMessage(name, record.log_time, record.publish_time, record.data)
    elif isinstance(record, Header):
        report.profile = record.profile


def _unreadable(path: Path, error: OSError) -> Ros2CliError:
    return Ros2CliError("bag_unreadable", f"'{path}' cannot be read: {error.strerror or error}")
