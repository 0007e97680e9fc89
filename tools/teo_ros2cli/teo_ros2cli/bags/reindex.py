# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Repairing a bag whose recorder did not finish, so that every reader of MCAP reads it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from teo_common.mcap_salvage import McapContent
from teo_ros2cli.bags.bag import Bag, open_bag
from teo_ros2cli.bags.file_writer import DEFAULT_PRESET, PRESETS, BagFileWriter
from teo_ros2cli.bags.mcap_file import messages_of, scan, stored_schema, summary_report
from teo_ros2cli.bags.metadata import TopicRecord, write_metadata
from teo_ros2cli.definitions import Schema

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
        on_progress(f"'{file}': repairing, {report.messages} messages can be read")
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
