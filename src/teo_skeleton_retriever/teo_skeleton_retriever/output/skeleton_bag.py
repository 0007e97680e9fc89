# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons written to an MCAP file, as rosbag2 would record their topic."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

from mcap.writer import CompressionType, Writer

from teo_skeleton_retriever.bags.bag_reader import message_types
from teo_skeleton_retriever.output.output_file import output_file

TOPIC = "/skeletons"
_TYPE = "teo_sign_msgs/msg/SkeletonArray"


class SkeletonBag:
    """Writes messages to an MCAP file; see `skeleton_bag`."""

    def __init__(self, stream: BinaryIO) -> None:
        """Begin the file."""
        self._writer = Writer(stream, compression=CompressionType.ZSTD)
        self._writer.start(profile="ros2", library="teo_skeleton_retriever")
        self._types = types = message_types()
        definition, _ = types.generate_msgdef(_TYPE, ros_version=2)
        schema = self._writer.register_schema(_TYPE, "ros2msg", definition.encode())
        metadata = {"topic_type_hash": types.hash_rihs01(_TYPE), "offered_qos_profiles": "[]"}
        self._channel = self._writer.register_channel(TOPIC, "cdr", schema, metadata)

    def write(self, message: Any, time: int) -> None:
        """Append a SkeletonArray that a recorder would have received at this time [ns]."""
        stamp = message.header.stamp
        published = stamp.sec * 1_000_000_000 + stamp.nanosec
        data = bytes(self._types.serialize_cdr(message, _TYPE))
        self._writer.add_message(self._channel, time, data, published)

    def finish(self) -> None:
        """Write the index; nothing can be appended after it."""
        self._writer.finish()  # type: ignore[no-untyped-call]


@contextmanager
def skeleton_bag(path: Path) -> Iterator[SkeletonBag]:
    """Write an MCAP file, which appears when the block ends well.

    Args:
        path: File to write, replaced if it exists; its folder exists.

    Raises:
        RetrieverError: There is no such folder, or the name does not end in .mcap.
    """
    with output_file(path, ".mcap") as temporary, temporary.open("wb") as stream:
        bag = SkeletonBag(stream)
        yield bag
        bag.finish()
