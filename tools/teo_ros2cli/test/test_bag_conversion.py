# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags written anew, and bags of other kinds, judged by rosbags, which shares nothing with this package."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from rosbags.highlevel import AnyReader
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Ros2Writer
from rosbags.typesys import Stores, get_typestore

from teo_ros2cli.bags.bag import open_bag
from teo_ros2cli.bags.foreign_bag import open_any_bag
from teo_ros2cli.bags.metadata import TopicRecord
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import Schema, schema_of
from teo_ros2cli.qos import QosRecord

Command = Callable[..., subprocess.CompletedProcess[str]]
TEXT = "std_msgs/msg/String"
STATE = "sensor_msgs/msg/JointState"
START = 1_700_000_000_000_000_000
JAZZY = get_typestore(Stores.ROS2_JAZZY)
NOETIC = get_typestore(Stores.ROS1_NOETIC)


def text(data: str) -> bytes:
    return bytes(JAZZY.serialize_cdr(JAZZY.types[TEXT](data), TEXT))


def write_texts(directory: Path, topic: str, times: range, **options: Any) -> None:
    writer = BagWriter(directory, **options)
    writer.add_topic(
        TopicRecord(topic, TEXT, offered_qos=(QosRecord(durability="transient_local"),)), schema_of(TEXT)
    )
    for i, time in enumerate(times):
        writer.write(topic, START + time, START + time - 5, text(f"{topic} {time}"), i)
    writer.close()


def read(directory: Path) -> list[tuple[str, int, str]]:
    with AnyReader([directory], default_typestore=JAZZY) as reader:
        return [
            (c.topic, time - START, getattr(reader.deserialize(data, c.msgtype), "data", ""))
            for c, time, data in reader.messages()
        ]


def outputs(path: Path, *bags: dict[str, Any]) -> str:
    path.write_text(yaml.safe_dump({"output_bags": list(bags)}))
    return str(path)


def test_bags_are_merged_filtered_and_split(ros2_here: Command, tmp_path: Path) -> None:
    write_texts(tmp_path / "even", "/even", range(0, 100, 2), custom_data={"who": "a"})
    write_texts(tmp_path / "odd", "/odd", range(1, 100, 2))
    wanted = outputs(
        tmp_path / "out.yaml",
        {"uri": str(tmp_path / "all"), "storage_id": "mcap"},
        {"uri": str(tmp_path / "some"), "regex": "^/o", "storage_preset_profile": "none"},
        {"uri": str(tmp_path / "none"), "all_topics": True, "exclude_regex": "."},
    )
    done = ros2_here(
        "bag", "convert", "-i", str(tmp_path / "even"), "mcap", "-i", str(tmp_path / "odd"), "-o", wanted
    )
    assert (done.returncode, done.stderr) == (0, "")
    everything = [(("/even", "/odd")[i % 2], i, f"{('/even', '/odd')[i % 2]} {i}") for i in range(100)]
    assert read(tmp_path / "all") == everything
    assert read(tmp_path / "some") == everything[1::2]
    assert open_bag(tmp_path / "none").metadata.topics == ()
    merged = open_bag(tmp_path / "all", verify=True)
    assert merged.problems == ()
    assert merged.metadata.custom_data == {"who": "a"}
    assert [m.sequence for m in merged.messages(topics=["/odd"])] == list(range(50))
    assert {q.durability for t, _ in merged.metadata.topics for q in t.offered_qos} == {"transient_local"}
    assert "already exists" in ros2_here("bag", "convert", "-i", str(tmp_path / "odd"), "-o", wanted).stderr


def test_a_type_that_is_not_installed_keeps_its_definition(ros2_here: Command, tmp_path: Path) -> None:
    schema = Schema("lab_msgs/msg/Odd", "ros2msg", "int32 x\n")
    writer = BagWriter(tmp_path / "bag")
    writer.add_topic(TopicRecord("/odd", schema.name), schema)
    writer.write("/odd", START, START, b"\x00\x01\x00\x00\x07\x00\x00\x00")
    writer.close()
    wanted = outputs(tmp_path / "out.yaml", {"uri": str(tmp_path / "new")})
    assert ros2_here("bag", "convert", "-i", str(tmp_path / "bag"), "-o", wanted).returncode == 0
    with AnyReader([tmp_path / "new"]) as reader:
        ((connection, _, data),) = reader.messages()
        assert reader.deserialize(data, connection.msgtype).x == 7


@pytest.mark.parametrize(
    ("entry", "part"),
    [
        ({}, "lacks `uri`"),
        ({"uri": "x", "topic": []}, "there is no key `topic`"),
        ({"uri": "x", "topics": "/a"}, "`topics` must be a list, got '/a'"),
        ({"uri": "x", "max_bagfile_size": True}, "`max_bagfile_size` must be a number"),
        ({"uri": "x", "max_bagfile_duration": -1}, "must not be below 0"),
        ({"uri": "x", "storage_id": "sqlite3"}, "`storage_id` can only be '' or 'mcap', got 'sqlite3'"),
        ({"uri": "x", "storage_preset_profile": "best"}, "must be one of none"),
        ({"uri": "x", "regex": "("}, "not a regular expression"),
    ],
)
def test_a_wish_that_cannot_be_met_is_told(
    ros2_here: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, entry: dict[str, Any], part: str
) -> None:
    write_texts(tmp_path / "bag", "/t", range(3))
    monkeypatch.chdir(tmp_path)
    wanted = outputs(tmp_path / "out.yaml", entry)
    done = ros2_here("bag", "convert", "-i", str(tmp_path / "bag"), "-o", wanted)
    assert done.returncode == 1
    assert part in done.stderr
    assert not (tmp_path / "x").exists()


def test_bags_that_disagree_on_a_type_are_not_merged(ros2_here: Command, tmp_path: Path) -> None:
    write_texts(tmp_path / "a", "/t", range(3))
    writer = BagWriter(tmp_path / "b")
    writer.add_topic(TopicRecord("/t", STATE), schema_of(STATE))
    writer.close()
    wanted = outputs(tmp_path / "out.yaml", {"uri": str(tmp_path / "new")})
    done = ros2_here("bag", "convert", "-i", str(tmp_path / "a"), "-i", str(tmp_path / "b"), "-o", wanted)
    assert (done.returncode, "is of type std_msgs/msg/String in one bag" in done.stderr) == (1, True)


def write_ros1(path: Path) -> None:
    types = NOETIC.types
    with Ros1Writer(path) as writer:
        talk = writer.add_connection("/text", TEXT, typestore=NOETIC, latching=1)
        state = writer.add_connection("/state", STATE, typestore=NOETIC)
        for i in range(20):
            message = types[TEXT](f"¡{i}!")
            writer.write(talk, START + 10 * i, NOETIC.serialize_ros1(message, TEXT))
            stamp = types["builtin_interfaces/msg/Time"](sec=5, nanosec=i)
            header = types["std_msgs/msg/Header"](seq=99, stamp=stamp, frame_id="base")
            values = [np.array([i, -0.5])] * 3
            joints = types[STATE](header, ["a", "b"], *values)
            writer.write(state, START + 10 * i + 1, NOETIC.serialize_ros1(joints, STATE))


def write_sqlite(path: Path) -> None:
    forever = QosTime(2147483647, 4294967295)
    latched = Qos(
        QosHistory.KEEP_LAST,
        3,
        QosReliability.RELIABLE,
        QosDurability.TRANSIENT_LOCAL,
        forever,
        forever,
        QosLiveliness.AUTOMATIC,
        forever,
        avoid_ros_namespace_conventions=False,
    )
    with Ros2Writer(path, version=8, storage_plugin=StoragePlugin.SQLITE3) as writer:
        talk = writer.add_connection("/text", TEXT, typestore=JAZZY, offered_qos_profiles=[latched])
        for i in range(20):
            writer.write(talk, START + 10 * i, text(f"¡{i}!"))


def test_a_bag_of_ros_1_is_read_as_one_of_ros_2(ros2_here: Command, tmp_path: Path) -> None:
    write_ros1(tmp_path / "old.bag")
    bag = open_any_bag(tmp_path / "old.bag")
    assert [(t.name, t.type, n, len(t.offered_qos)) for t, n in bag.metadata.topics] == [
        ("/text", TEXT, 20, 1),
        ("/state", STATE, 20, 0),
    ]
    states = [JAZZY.deserialize_cdr(m.data, STATE) for m in bag.messages(topics=["/state"])]
    assert [(s.header.stamp.nanosec, s.header.frame_id, s.position[0]) for s in states] == [
        (i, "base", i) for i in range(20)
    ]
    late = bag.messages(topics=["/text"], start=START + 100)
    assert [m.log_time - START for m in late] == list(range(100, 200, 10))
    told = ros2_here("bag", "info", str(tmp_path / "old.bag"))
    assert (
        told.returncode,
        "Topic: /state | Type: sensor_msgs/msg/JointState | Count: 20" in told.stdout,
    ) == (0, True)
    wanted = outputs(tmp_path / "out.yaml", {"uri": str(tmp_path / "new"), "topics": ["/text"]})
    assert ros2_here("bag", "convert", "-i", str(tmp_path / "old.bag"), "-o", wanted).returncode == 0
    assert read(tmp_path / "new") == [("/text", 10 * i, f"¡{i}!") for i in range(20)]


def test_a_bag_in_sqlite_is_read_with_its_qualities_of_service(tmp_path: Path) -> None:
    write_sqlite(tmp_path / "old")
    for path in (tmp_path / "old", next((tmp_path / "old").glob("*.db3"))):
        bag = open_any_bag(path)
        ((topic, count),) = bag.metadata.topics
        assert (count, topic.offered_qos) == (20, (QosRecord(depth=3, durability="transient_local"),))
        assert [m.data for m in bag.messages()] == [text(f"¡{i}!") for i in range(20)]


@pytest.mark.parametrize("name", ["x.bag", "x.db3"])
def test_damaged_bags_of_other_kinds_are_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(b"#ROSBAG V2.0\nbroken")
    with pytest.raises(Ros2CliError) as caught:
        open_any_bag(tmp_path / name)
    assert caught.value.code == "bag_unreadable"
    with pytest.raises(Ros2CliError) as caught:
        open_any_bag(tmp_path / f"no_{name}")
    assert caught.value.code == "bag_missing"
