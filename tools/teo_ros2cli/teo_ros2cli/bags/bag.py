# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Opening a bag: a directory, with or without its metadata, or a single file."""

from __future__ import annotations

import heapq
import itertools
import re
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

from teo_common.mcap_salvage import McapContent, StoredMessage
from teo_ros2cli.bags.mcap_file import FileReport, messages_of, scan, stored_schema, summary_report
from teo_ros2cli.bags.metadata import (
    FILE_NAME,
    NO_START,
    BagMetadata,
    FileRecord,
    TopicRecord,
    parse_offered_qos,
    read_metadata,
)
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import Schema


@dataclass(frozen=True)
class Bag:
    """A bag that was opened.

    Args:
        path: What was opened: a directory or a file.
        files: The MCAP files in the order of time.
        metadata: What the bag holds, as its metadata or, where these are missing, its files tell.
        problems: A sentence for each thing that is wrong with the bag and was worked around.
    """

    path: Path
    files: tuple[Path, ...]
    metadata: BagMetadata
    problems: tuple[str, ...]

    @property
    def size(self) -> int:
        """Size of all files of the bag [bytes]."""
        return sum(file.stat().st_size for file in self.files if file.is_file())

    def schemas(self) -> dict[str, Schema]:
        """Return the definitions of types that the files hold, by the types' names."""
        reports = (summary_report(file) or scan(file) for file in self.files)
        return {s.name: stored_schema(s) for report in reports for s in report.schemas.values()}

    def messages(
        self,
        *,
        topics: Collection[str] | None = None,
        start: int = 0,
        on_problem: Callable[[str], object] = str,
    ) -> Iterator[StoredMessage]:
        """Yield the messages in the order of reception.

        Args:
            topics: Names to yield, None for all.
            start: Time before which messages are left out [ns since the epoch].
            on_problem: Called with a sentence for each thing that could not be read; nothing is by default.
        """
        for file in self.files:
            content = McapContent()
            yield from _in_order(messages_of(file, content, topics=topics, start=start), start)
            for problem in _problems_of(file, content):
                on_problem(problem)


# Messages are stored in the order in which their topics' queues were emptied, nearly that of their times.
_LOOK_AHEAD = 512
# Bytes of messages at which fewer are held back: about 4 s of colour and depth images of 640x480.
_LOOK_AHEAD_BYTES = 200_000_000


def _in_order(messages: Iterator[StoredMessage], start: int) -> Iterator[StoredMessage]:
    """Sort messages that are nearly in order, holding back `_LOOK_AHEAD` of them, fewer if they are large."""
    heap: list[tuple[int, int, StoredMessage]] = []
    counter = itertools.count()
    held = 0
    for message in messages:
        if message.log_time < start:
            continue
        heapq.heappush(heap, (message.log_time, next(counter), message))
        held += len(message.data)
        while len(heap) > _LOOK_AHEAD or held > _LOOK_AHEAD_BYTES:
            first = heapq.heappop(heap)[2]
            held -= len(first.data)
            yield first
    while heap:
        yield heapq.heappop(heap)[2]


def require_bag(path: Path) -> None:
    """See that there is something at a path.

    Raises:
        Ros2CliError: `bag_missing`.
    """
    if not path.exists():
        raise Ros2CliError("bag_missing", f"Bag path '{path}' does not exist!")


def open_bag(path: Path, *, verify: bool = False) -> Bag:
    """Open a bag, without its metadata where these are missing, and to the extent that its files can be read.

    Args:
        path: Directory or `.mcap` file.
        verify: Read the files to their ends and check them, instead of trusting metadata and summaries.

    Raises:
        Ros2CliError: `bag_missing`, `bag_empty` (a directory without files), `storage_unsupported`,
            `not_mcap`, `bag_unreadable`, or `metadata_invalid`.
    """
    require_bag(path)
    if not path.is_dir():
        return _from_files(path, (path,), [], verify)
    try:
        metadata = read_metadata(path)
    except Ros2CliError as error:
        unfinished = f"'{path}' has no {FILE_NAME}: its recorder did not finish"
        reason = unfinished if error.code == "metadata_missing" else error
        return _from_files(path, _files_in(path), [f"{reason}; reading the files themselves"], verify)
    if metadata.storage != "mcap":
        raise Ros2CliError(
            "storage_unsupported", f"'{path}' is stored as '{metadata.storage}': only 'mcap' can be read here"
        )
    files = tuple(path / record.path for record in metadata.files)
    missing = [file for file in files if not file.is_file()]
    if missing or verify:
        problems = [f"'{file}' is named in the metadata, but missing" for file in missing]
        return _from_files(path, tuple(file for file in files if file.is_file()), problems, verify, metadata)
    return Bag(path, files, metadata, ())


def _files_in(directory: Path) -> tuple[Path, ...]:
    files = [path for path in directory.iterdir() if path.suffix == ".mcap" and path.is_file()]
    if not files:
        raise Ros2CliError("bag_empty", f"'{directory}' holds no bag: no {FILE_NAME} and no .mcap file")
    return tuple(sorted(files, key=_natural))


def _natural(path: Path) -> list[tuple[int, str]]:
    """Sort key that puts bag_10 after bag_9."""
    return [(int(part), "") if part.isdigit() else (0, part) for part in re.split(r"(\d+)", path.name)]


def _from_files(
    path: Path,
    files: tuple[Path, ...],
    problems: list[str],
    verify: bool,
    metadata: BagMetadata | None = None,
) -> Bag:
    """Make the metadata from the files; what the metadata alone know is taken from there."""
    topics: dict[str, TopicRecord] = {topic.name: topic for topic, _ in metadata.topics} if metadata else {}
    counts: dict[str, int] = dict.fromkeys(topics, 0)
    records: list[FileRecord] = []
    distro = metadata.ros_distro if metadata else ""
    reports = []
    for file in files:
        report = None if verify else summary_report(file)
        if report is None:
            report = scan(file)
            problems += _problems_of(file, report)
        reports.append(report)
        distro = distro or _distro_in(report)
        for topic in _topics_of(report, problems):
            topics.setdefault(topic.name, topic)
            counts[topic.name] = counts.get(topic.name, 0) + report.counts.get(topic.name, 0)
        records.append(report.span.record(file))
    if metadata and (lost := metadata.messages - sum(counts.values())) > 0:
        problems.append(f"{lost} of {metadata.messages} messages that the metadata count cannot be read")
    start = min((record.start for record in records), default=NO_START)
    end = max((report.span.end for report in reports), default=0)
    made = BagMetadata(
        files=tuple(records),
        topics=tuple((topic, counts[name]) for name, topic in topics.items()),
        start=start,
        duration=max(end - start, 0),
        custom_data=metadata.custom_data if metadata else {},
        ros_distro=distro,
    )
    return Bag(path, files, made, tuple(problems))


def _distro_in(report: FileReport) -> str:
    told = report.metadata.get("rosbag2", {})
    match = re.search(r"^ros_distro: (\w+)", told.get("serialized_metadata", ""), re.M)
    return told.get("ROS_DISTRO", "") or (match[1] if match else "")


def _topics_of(report: FileReport, problems: list[str]) -> Iterator[TopicRecord]:
    for name, channel in report.channels.items():
        schema = report.schemas.get(channel.schema_id)
        try:
            offered = parse_offered_qos(channel.metadata.get("offered_qos_profiles"))
        except ValueError as error:
            problems.append(f"topic '{name}' has QoS profiles that cannot be read: {error}")
            offered = ()
        yield TopicRecord(
            name=name,
            type=schema.name if schema else "",
            type_hash=channel.metadata.get("topic_type_hash", ""),
            offered_qos=offered,
            serialization_format=channel.message_encoding,
        )


def _problems_of(file: Path, content: McapContent) -> list[str]:
    problems = []
    if content.damaged_chunks:
        problems.append(f"'{file}' has {content.damaged_chunks} damaged chunk(s), which are left out")
    if not content.complete:
        problems.append(
            f"'{file}' is truncated or damaged ({content.fault}): what comes after that place is lost"
        )
    return problems
