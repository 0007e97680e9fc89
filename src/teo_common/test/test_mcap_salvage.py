# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import random
from pathlib import Path

import pytest
from mcap.writer import CompressionType, Writer

from teo_common.mcap_salvage import McapContent, NotMcapError, StoredMessage, salvage

COUNT, CHUNK = 200, 50


def write(path: Path) -> list[StoredMessage]:
    """Write two topics in chunks of `CHUNK` messages; return what was written."""
    written = []
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=1 << 30, compression=CompressionType.NONE)
        writer.start(profile="ros2")
        channels = {}
        for topic, kind in (("/a", "std_msgs/msg/String"), ("/b", "std_msgs/msg/Int8")):
            schema = writer.register_schema(kind, "ros2msg", b"data")
            channels[topic] = writer.register_channel(topic, "cdr", schema), kind
        for i in range(COUNT):
            topic = "/b" if i % 4 == 0 else "/a"
            channel, kind = channels[topic]
            message = StoredMessage(topic, kind, 1000 + i, 900 + i, random.Random(i).randbytes(100))
            writer.add_message(channel, message.log_time, message.data, message.publish_time)
            written.append(message)
            if i % CHUNK == CHUNK - 1:
                writer.flush()  # type: ignore[no-untyped-call]
        writer.add_metadata("rosbag2", {"ROS_DISTRO": "jazzy"})
        writer.finish()  # type: ignore[no-untyped-call]
    return written


def test_a_whole_file_gives_every_message_and_says_what_it_holds(tmp_path: Path) -> None:
    written = write(tmp_path / "a.mcap")
    content = McapContent()
    assert list(salvage(tmp_path / "a.mcap", content)) == written
    assert (content.complete, content.damaged_chunks, content.fault) == (True, 0, "")
    assert (sorted(content.channels), content.profile) == (["/a", "/b"], "ros2")
    assert content.metadata == {"rosbag2": {"ROS_DISTRO": "jazzy"}}


def test_only_the_topics_asked_for_come_and_early_chunks_are_left_out(tmp_path: Path) -> None:
    written = write(tmp_path / "a.mcap")
    got = list(salvage(tmp_path / "a.mcap", McapContent(), topics=["/b"], start=1000 + CHUNK))
    assert got == [message for message in written[CHUNK:] if message.topic == "/b"]
    assert list(salvage(tmp_path / "a.mcap", McapContent(), topics=[])) == []


@pytest.mark.parametrize("bytes_", [b"", b"\x89MCAP", b"SQLite format 3\x00" * 10])
def test_what_does_not_begin_as_mcap_is_refused(tmp_path: Path, bytes_: bytes) -> None:
    (tmp_path / "a.mcap").write_bytes(bytes_)
    with pytest.raises(NotMcapError, match="is not an MCAP file"):
        list(salvage(tmp_path / "a.mcap", McapContent()))
    with pytest.raises(FileNotFoundError):
        list(salvage(tmp_path / "b.mcap", McapContent()))
