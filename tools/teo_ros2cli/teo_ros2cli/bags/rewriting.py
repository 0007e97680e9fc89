# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writing bags anew: repaired after a recorder did not finish, merged, filtered, in another layout."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from teo_common.mcap_salvage import McapContent
from teo_ros2cli.bags.bag import Bag, open_bag
from teo_ros2cli.bags.mcap_file import (
    DEFAULT_PRESET,
    PRESETS,
    BagFileWriter,
    messages_of,
    scan,
    stored_schema,
    summary_report,
)
from teo_ros2cli.bags.metadata import TopicRecord, write_metadata
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import Schema, schema_of


@dataclass(frozen=True)
class OutputBag:
    """A bag that is to be written.

    Args:
        directory: Where, a directory that does not exist yet.
        selection: Which topics it gets.
        preset: Layout, a name in `PRESETS`.
        max_size: Size at which a file is followed by another [bytes]; 0 for no limit.
        max_duration: Longest time in one file [s]; 0 for no limit.
    """

    directory: Path
    selection: TopicSelection
    preset: str = DEFAULT_PRESET
    max_size: int = 0
    max_duration: int = 0


def convert(
    bags: Sequence[Bag], outputs: Sequence[OutputBag], on_problem: Callable[[str], object] = str
) -> tuple[int, ...]:
    """Write the messages of some bags, in the order of their reception, into others.

    Args:
        bags: What is read.
        outputs: What is written.
        on_problem: Called with a sentence for each thing that could not be read.

    Returns:
        How many messages each output has got.

    Raises:
        Ros2CliError: `output_exists`, `output_unwritable`; `topic_types_differ`, two of the bags have a topic
            of one name and not of one type.
        OSError: A disk is full.
    """
    topics = _topics(bags)
    stored = {name: schema for bag in bags for name, schema in bag.schemas().items()}
    writers: list[BagWriter] = []
    for output in outputs:
        writer = BagWriter(
            Path.cwd() / output.directory,
            preset=output.preset,
            max_size=output.max_size,
            max_duration=output.max_duration * 1_000_000_000,
            custom_data={k: v for bag in bags for k, v in bag.metadata.custom_data.items()},
            ros_distro=next((bag.metadata.ros_distro for bag in bags if bag.metadata.ros_distro), ""),
        )
        writers.append(writer)
        for topic in topics.values():
            if output.selection.accepts(topic.name, topic.type):
                writer.add_topic(topic, stored.get(topic.type) or _installed_schema(topic.type))
    counts = [0] * len(outputs)
    streams = [bag.messages(on_problem=on_problem) for bag in bags]
    try:
        for message in heapq.merge(*streams, key=lambda message: message.log_time):
            for i, (output, writer) in enumerate(zip(outputs, writers, strict=True)):
                if output.selection.accepts(message.topic, topics[message.topic].type):
                    writer.write(
                        message.topic, message.log_time, message.publish_time, message.data, message.sequence
                    )
                    counts[i] += 1
    finally:
        for writer in writers:
            writer.close()
    return tuple(counts)


def _topics(bags: Sequence[Bag]) -> dict[str, TopicRecord]:
    topics: dict[str, TopicRecord] = {}
    for bag in bags:
        for topic, _ in bag.metadata.topics:
            known = topics.setdefault(topic.name, topic)
            if known.type != topic.type:
                raise Ros2CliError(
                    "topic_types_differ",
                    f"Topic '{topic.name}' is of type {known.type} in one bag and {topic.type} in another: "
                    f"leave one of them out",
                )
    return topics


def _installed_schema(type_name: str) -> Schema:
    """Return a type's definition; of one that is not installed, only its name, as rosbag2 does."""
    try:
        return schema_of(type_name)
    except Ros2CliError:
        return Schema(type_name, "", "")


_UNFINISHED = ".repairing"


def reindex(path: Path, on_progress: Callable[[str], object] = str) -> Bag:
    """Give every file of a bag that lacks them an end and an index, and the bag its metadata, in place.

    A file is replaced, all at once, by one that holds every message that can be read of it: of a recorder
    that was killed, all but the open chunk. Good files stay as they are, byte for byte.

    Args:
        path: The bag's directory, or a lone file.
        on_progress: Called with a sentence for each file that is repaired.

    Returns:
        The bag as it is now.

    Raises:
        Ros2CliError: As `open_bag`: there is no bag, or one of its files is no MCAP file at all.
        OSError: A file cannot be written; the bag is as it was, or some of its files are repaired.
    """
    before = open_bag(path)
    for file in before.files:
        report = scan(file)
        if report.complete and not report.damaged_chunks and summary_report(file) is not None:
            continue
        on_progress(f"'{file}': repairing, {report.span.messages} messages can be read")
        _rewrite(file, before)
    after = open_bag(path, verify=True)
    if path.is_dir():
        write_metadata(path, after.metadata)
    return after


def _rewrite(file: Path, bag: Bag) -> None:
    """Replace a file by one with all that can be read of it."""
    topics = {topic.name: topic for topic, _ in bag.metadata.topics}
    unfinished = file.with_name(file.name + _UNFINISHED)
    unfinished.unlink(missing_ok=True)  # of a repair that was cut short
    content = McapContent()
    writer = BagFileWriter(unfinished, PRESETS[DEFAULT_PRESET], bag.metadata.ros_distro)
    try:
        for message in messages_of(file, content):
            channel = content.channels[message.topic]
            stored = content.schemas.get(channel.schema_id)
            schema = stored_schema(stored) if stored is not None else Schema("", "", "")
            topic = topics.get(message.topic, TopicRecord(message.topic, message.type))
            identifier = writer.add_topic(topic, schema)
            writer.write(identifier, message.log_time, message.publish_time, message.data, message.sequence)
        writer.close()
        unfinished.replace(file)
    except BaseException:
        unfinished.unlink(missing_ok=True)
        raise
