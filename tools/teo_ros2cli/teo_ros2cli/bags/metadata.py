# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a bag holds: the content of `metadata.yaml`, version 9, as rosbag2 of ROS 2 Jazzy writes it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from teo_common.atomic_files import write_atomically
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.qos import QosRecord

FILE_NAME = "metadata.yaml"
VERSION = 9
# Start time of a bag without messages [ns]: the latest time there is.
NO_START = 2**63 - 1


@dataclass(frozen=True)
class TopicRecord:
    """One topic of a bag.

    Args:
        name: Full topic name.
        type: Type name, such as `std_msgs/msg/String`.
        type_hash: Type description hash, `RIHS01_...`, or empty where it was not known.
        offered_qos: Profiles of its publishers: of all that were there at once when they were most.
        serialization_format: Encoding of the messages.
    """

    name: str
    type: str
    type_hash: str = ""
    offered_qos: tuple[QosRecord, ...] = ()
    serialization_format: str = "cdr"


@dataclass(frozen=True)
class FileRecord:
    """One file of a bag: name, time of the first message [ns since the epoch], duration [ns], messages."""

    path: str
    start: int
    duration: int
    messages: int


@dataclass(frozen=True)
class BagMetadata:
    """All that `metadata.yaml` says.

    Args:
        files: The files in the order of time.
        topics: The topics with the number of messages of each.
        start: Time of the first message [ns since the epoch], `NO_START` without messages.
        duration: From the first message to the last [ns].
        storage: Storage identifier.
        custom_data: What the person who recorded wished to add.
        ros_distro: Distribution that recorded it.
    """

    files: tuple[FileRecord, ...]
    topics: tuple[tuple[TopicRecord, int], ...]
    start: int
    duration: int
    storage: str = "mcap"
    custom_data: Mapping[str, str] = field(default_factory=dict)
    ros_distro: str = "jazzy"

    @property
    def messages(self) -> int:
        """Number of messages of all topics."""
        return sum(count for _, count in self.topics)

    def to_tree(self) -> dict[str, Any]:
        """Return the mapping under the key `rosbag2_bagfile_information`."""
        return {
            "version": VERSION,
            "storage_identifier": self.storage,
            "duration": {"nanoseconds": self.duration},
            "starting_time": {"nanoseconds_since_epoch": self.start},
            "message_count": self.messages,
            "topics_with_message_count": [_topic_tree(topic, count) for topic, count in self.topics],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [record.path for record in self.files],
            "files": [
                {
                    "path": record.path,
                    "starting_time": {"nanoseconds_since_epoch": record.start},
                    "duration": {"nanoseconds": record.duration},
                    "message_count": record.messages,
                }
                for record in self.files
            ],
            "custom_data": dict(self.custom_data) or None,  # as rosbag2 writes that there are none
            "ros_distro": self.ros_distro,
        }


def _topic_tree(topic: TopicRecord, count: int) -> dict[str, Any]:
    return {
        "topic_metadata": {
            "name": topic.name,
            "type": topic.type,
            "serialization_format": topic.serialization_format,
            "offered_qos_profiles": [profile.to_tree() for profile in topic.offered_qos],
            "type_description_hash": topic.type_hash,
        },
        "message_count": count,
    }


class _Dumper(yaml.SafeDumper):
    """Quotes text with line breaks so that every one of them is escaped, which the other quotes fold."""

    def represent_str(self, data: str) -> yaml.ScalarNode:
        style = None if data.isprintable() else '"'
        return self.represent_scalar("tag:yaml.org,2002:str", data, style)


_Dumper.add_representer(str, _Dumper.represent_str)


def block_text(tree: Mapping[str, Any] | Sequence[Any]) -> str:
    """Return a tree as YAML in block style, keys in their order, no line broken."""
    text: str = yaml.dump(tree, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=math.inf)
    return text


def write_metadata(directory: Path, metadata: BagMetadata) -> None:
    """Write `metadata.yaml` into a bag's directory, all of it or nothing."""
    text = block_text({"rosbag2_bagfile_information": metadata.to_tree()})
    write_atomically(directory / FILE_NAME, text.encode())


def read_metadata(directory: Path) -> BagMetadata:
    """Read `metadata.yaml` of any version up to 9.

    Raises:
        Ros2CliError: `metadata_missing`, or `metadata_invalid` with what is wrong in it.
    """
    path = directory / FILE_NAME
    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise Ros2CliError("metadata_missing", f"'{path}' does not exist") from error
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise Ros2CliError("metadata_invalid", f"'{path}' cannot be read: {error}") from error
    try:
        return _from_tree(tree["rosbag2_bagfile_information"])
    except KeyError as error:
        raise Ros2CliError("metadata_invalid", f"'{path}' lacks the key {error}") from error
    except (TypeError, ValueError, AttributeError) as error:
        raise Ros2CliError("metadata_invalid", f"'{path}' is not bag metadata: {error}") from error


def _from_tree(tree: Mapping[str, Any]) -> BagMetadata:
    if tree.get("compression_mode"):
        raise ValueError(
            f"compression mode '{tree['compression_mode']}' is not supported (compression within MCAP chunks "
            f"is)"
        )
    paths = [str(path) for path in tree["relative_file_paths"]]
    known = {str(entry["path"]): entry for entry in tree.get("files") or ()}
    files = []
    for path in paths:
        entry = known.get(path, tree)  # before version 5 the files are not told apart
        files.append(
            FileRecord(
                path=path,
                start=int(entry["starting_time"]["nanoseconds_since_epoch"]),
                duration=int(entry["duration"]["nanoseconds"]),
                messages=int(entry["message_count"]),
            )
        )
    return BagMetadata(
        files=tuple(files),
        topics=tuple(_topic_from(entry) for entry in tree["topics_with_message_count"] or ()),
        start=int(tree["starting_time"]["nanoseconds_since_epoch"]),
        duration=int(tree["duration"]["nanoseconds"]),
        storage=str(tree["storage_identifier"]),
        custom_data={str(key): str(value) for key, value in (tree.get("custom_data") or {}).items()},
        ros_distro=str(tree.get("ros_distro") or ""),
    )


def _topic_from(entry: Mapping[str, Any]) -> tuple[TopicRecord, int]:
    about = entry["topic_metadata"]
    topic = TopicRecord(
        name=str(about["name"]),
        type=str(about["type"]),
        type_hash=str(about.get("type_description_hash") or ""),
        offered_qos=parse_offered_qos(about.get("offered_qos_profiles")),
        serialization_format=str(about["serialization_format"]),
    )
    return topic, int(entry["message_count"])


def offered_qos_text(profiles: Sequence[QosRecord]) -> str:
    """Return profiles as the YAML text that an MCAP channel's metadata holds."""
    return block_text([profile.to_tree() for profile in profiles]).rstrip("\n")


def parse_offered_qos(value: Any) -> tuple[QosRecord, ...]:
    """Read profiles from a channel's metadata or `metadata.yaml`: a list, or YAML text of one.

    Raises:
        ValueError: They cannot be read.
    """
    if isinstance(value, str):
        try:
            value = yaml.safe_load(value)
        except yaml.YAMLError as error:
            raise ValueError(f"offered_qos_profiles is not valid YAML: {error}") from error
    if not value:
        return ()
    if not isinstance(value, list) or not all(isinstance(entry, Mapping) for entry in value):
        raise ValueError(f"offered_qos_profiles must be a list of profiles, got {value!r}")
    return tuple(QosRecord.from_tree(entry) for entry in value)
