# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What one MCAP file of a bag holds, told by its summary or by reading it to its end."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from mcap.reader import make_reader
from mcap.records import Schema as McapSchema

from teo_common.mcap_salvage import DAMAGE, McapContent, NotMcapError, StoredMessage, salvage
from teo_ros2cli.bags.metadata import NO_START
from teo_ros2cli.definitions import Schema
from teo_ros2cli.errors import Ros2CliError


@dataclass
class FileReport(McapContent):
    """What was found in a file, with its messages counted.

    Args:
        counts: Messages by topic name.
        start: Time of the first message [ns], `NO_START` without messages.
        end: Time of the last message [ns].
    """

    counts: dict[str, int] = field(default_factory=dict)
    start: int = NO_START
    end: int = 0

    @property
    def messages(self) -> int:
        """Number of messages of all topics."""
        return sum(self.counts.values())


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
            if summary.statistics.message_count:
                report.start = summary.statistics.message_start_time
                report.end = summary.statistics.message_end_time
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
        report.start = min(report.start, message.log_time)
        report.end = max(report.end, message.log_time)
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
