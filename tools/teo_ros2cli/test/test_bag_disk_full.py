# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is left of a bag that filled the disk."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from rosbags.highlevel import AnyReader

from teo_ros2cli.bags.bag import open_bag
from teo_ros2cli.bags.rewriting import reindex

# Records until the disk is full, which a limit on the size of files stands for.
FULL_DISK = """
import pathlib, resource, sys
from teo_ros2cli.bags.writer import BackgroundWriter, BagWriter
from teo_ros2cli.bags.metadata import TopicRecord
from teo_ros2cli.interfaces import schema_of
from teo_ros2cli.errors import Ros2CliError

resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
bag = BackgroundWriter(BagWriter(pathlib.Path(sys.argv[1]), preset="fastwrite"), 0)
bag.add_topic(TopicRecord("/t", "std_msgs/msg/String"), schema_of("std_msgs/msg/String"))
for i in range(500):
    bag.write("/t", 10**18 + i, 10**18 + i, b"\\0\\1\\0\\0" + bytes(1_000))
try:
    bag.close()
except Ros2CliError as error:
    print(error.code, error)
"""


def test_of_a_bag_that_filled_the_disk_all_is_read_that_found_room(tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    done = subprocess.run(
        [sys.executable, "-c", FULL_DISK, str(bag)], capture_output=True, text=True, timeout=120, check=True
    )
    assert done.stdout.startswith(
        "bag_unwritable The bag cannot be written: [Errno 27] File too large. What "
    )
    assert f"`ros2 bag reindex {bag}` finishes it" in done.stdout
    messages = list(open_bag(bag).messages())
    assert [message.log_time for message in messages] == [10**18 + i for i in range(len(messages))]
    assert 90 <= len(messages) <= 96  # of 1,035 bytes each, in 100,000
    reindex(bag)
    with AnyReader([bag]) as reader:
        assert reader.message_count == len(messages)
