# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import random
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml
from mcap.reader import make_reader
from mcap_ros2.reader import read_ros2_messages
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from teo_ros2cli.bags.bag import Bag, open_bag
from teo_ros2cli.bags.mcap_file import PRESETS
from teo_ros2cli.bags.metadata import NO_START, TopicRecord, read_metadata
from teo_ros2cli.bags.rewriting import reindex
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.cli.bag.stored import moment_text, size_text, summary
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import installed_type_hash, schema_of
from teo_ros2cli.qos import QosRecord

START = 1_700_000_000_123_456_789
STEP = 10_000_000
TEXT = "std_msgs/msg/String"
TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"
LATCHED = QosRecord(history="unknown", depth=0, durability="transient_local")


def topic(name: str, kind: str, *offered: QosRecord) -> TopicRecord:
    return TopicRecord(name, kind, installed_type_hash(kind), offered)


STORE = get_typestore(Stores.ROS2_JAZZY)
"""Makes the wire format independently. (rclpy's serialize_message can leave unused bytes at the end.)"""


def text(data: str) -> bytes:
    return bytes(STORE.serialize_cdr(STORE.types[TEXT](data), TEXT))


def trajectory(i: int) -> bytes:
    types = STORE.types
    header = types["std_msgs/msg/Header"](types["builtin_interfaces/msg/Time"](i, 0), "base")
    numbers = [np.array([0.1 * i, -1.0]), np.array([1e-300, 2.0]), np.array([]), np.array([])]
    point = types[f"{TRAJECTORY}Point"](*numbers, types["builtin_interfaces/msg/Duration"](0, i))
    message = types[TRAJECTORY](header, ["año", "b"], [point] * (i % 4))
    return bytes(STORE.serialize_cdr(message, TRAJECTORY))


def write_bag(directory: Path, count: int = 300, **options: object) -> list[tuple[str, int, bytes]]:
    """Write two topics in turn; return what was written."""
    writer = BagWriter(directory, **options)  # type: ignore[arg-type]
    writer.add_topic(topic("/text", TEXT, QosRecord(), LATCHED), schema_of(TEXT))
    writer.add_topic(topic("/plan", TRAJECTORY, LATCHED), schema_of(TRAJECTORY))
    writer.add_topic(topic("/silent", TEXT), schema_of(TEXT))
    written = []
    for i in range(count):
        name = "/plan" if i % 3 == 0 else "/text"
        # Random letters, which do not compress: so the file has several chunks.
        filler = "".join(random.Random(i).choices("abcdefghijklmnopqrstuvwxyz", k=400))
        data = trajectory(i) if name == "/plan" else text(f"¡{i}! {filler}")
        written.append((name, START + i * STEP, data))
        writer.write(name, START + i * STEP, START + i * STEP - 1000, data, i)
        if i % 50 == 49:
            writer.flush()
    writer.close()
    return written


@pytest.mark.parametrize("preset", PRESETS)
def test_others_read_every_value_of_a_bag(tmp_path: Path, preset: str) -> None:
    written = write_bag(tmp_path / "bag", preset=preset)
    with AnyReader([tmp_path / "bag"]) as reader:
        read = [(c.topic, time, bytes(data)) for c, time, data in reader.messages()]
        assert read == written
        decoded = [reader.deserialize(data, c.msgtype) for c, _, data in reader.messages()]
        assert decoded[1].data.startswith("¡1! ")
        assert list(decoded[3].points[0].positions) == [pytest.approx(0.3), -1.0]
        assert decoded[3].joint_names == ["año", "b"]
    messages = list(read_ros2_messages(str(tmp_path / "bag" / "bag_0.mcap")))
    assert [(m.channel.topic, m.log_time_ns, m.publish_time_ns) for m in messages] == [
        (name, time, time - 1000) for name, time, _ in written
    ]
    assert [m.sequence_count for m in messages] == list(range(len(written)))
    assert messages[1].ros_msg.data == decoded[1].data
    assert messages[6].ros_msg.points[1].time_from_start.nanosec == 6


def test_metadata_are_those_of_rosbag2(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag", custom_data={"robot": "TEO", "run": "1"}, ros_distro="jazzy")
    with Reader(tmp_path / "bag") as reader:  # an independent reader of version 9
        assert (reader.message_count, reader.start_time, reader.duration) == (300, START, 299 * STEP + 1)
        assert reader.storage.metadata.custom == {"robot": "TEO", "run": "1"}
        assert {name: info.msgcount for name, info in reader.topics.items()} == {
            "/text": 200,
            "/plan": 100,
            "/silent": 0,
        }
        offered = reader.topics["/text"].connections[0].ext.offered_qos_profiles  # type: ignore[union-attr]
        assert [(q.durability.name, q.reliability.name, q.depth) for q in offered] == [
            ("VOLATILE", "RELIABLE", 10),
            ("TRANSIENT_LOCAL", "RELIABLE", 0),
        ]
        assert reader.topics["/plan"].connections[0].digest == installed_type_hash(TRAJECTORY)
    written = (tmp_path / "bag" / "metadata.yaml").read_text()
    assert written.startswith(
        "rosbag2_bagfile_information:\n  version: 9\n  storage_identifier: mcap\n  duration:\n"
    )
    about = yaml.safe_load(written)["rosbag2_bagfile_information"]
    assert about["compression_format"] == ""
    assert about["custom_data"]["run"] == "1"
    assert read_metadata(tmp_path / "bag") == open_bag(tmp_path / "bag").metadata


def test_the_file_follows_the_ros2_profile(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag")
    with (tmp_path / "bag" / "bag_0.mcap").open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        found = reader.get_summary()
        assert found is not None
        assert {schema.encoding for schema in found.schemas.values()} == {"ros2msg"}
        assert {channel.message_encoding for channel in found.channels.values()} == {"cdr"}
        assert {index.compression for index in found.chunk_indexes} == {"zstd"}
        assert len(found.chunk_indexes) > 1
        records = [record.metadata for record in reader.iter_metadata() if record.name == "rosbag2"]
        assert records[0] == {"ROS_DISTRO": "jazzy"}
        assert records[-1]["serialized_metadata"].startswith("version: 9\n")
        assert sum(1 for _ in reader.iter_messages()) == 300


def test_a_bag_is_split_by_time_and_read_as_one(tmp_path: Path) -> None:
    written = write_bag(tmp_path / "bag", max_duration=1_000_000_000)
    metadata = read_metadata(tmp_path / "bag")
    assert [(record.path, record.messages) for record in metadata.files] == [
        ("bag_0.mcap", 100),
        ("bag_1.mcap", 100),
        ("bag_2.mcap", 100),
    ]
    with AnyReader([tmp_path / "bag"]) as reader:
        assert [(c.topic, t, bytes(d)) for c, t, d in reader.messages()] == written
    bag = open_bag(tmp_path / "bag")
    assert [(m.topic, m.log_time, m.data) for m in bag.messages()] == written
    (tmp_path / "bag" / "metadata.yaml").unlink()
    assert [m.log_time for m in open_bag(tmp_path / "bag").messages()] == [time for _, time, _ in written]


def test_a_bag_is_split_by_size(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag", max_size=20_000)
    files = read_metadata(tmp_path / "bag").files
    assert len(files) > 2
    assert sum(record.messages for record in files) == 300


def test_a_directory_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(Ros2CliError) as caught:
        BagWriter(tmp_path / "file" / "bag")
    assert caught.value.code == "output_unwritable"


@pytest.mark.parametrize("topics", [0, 1])
def test_a_bag_without_messages_is_good(tmp_path: Path, topics: int) -> None:
    writer = BagWriter(tmp_path / "bag")
    for i in range(topics):
        writer.add_topic(topic(f"/t{i}", TEXT), schema_of(TEXT))
    writer.close()
    bag = open_bag(tmp_path / "bag", verify=True)
    assert (bag.metadata.messages, bag.metadata.start, bag.problems) == (0, NO_START, ())
    assert list(bag.messages()) == []
    assert "Messages:          0\n" in summary(bag.metadata, bag.size)
    with Reader(tmp_path / "bag") as reader:
        assert (reader.message_count, len(reader.topics)) == (0, topics)


def test_messages_are_played_in_order_though_stored_a_little_beside(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "bag")
    writer.add_topic(topic("/text", TEXT), schema_of(TEXT))
    times = [START + i * 1000 for i in range(1500)]
    shaken = sorted(times, key=lambda time: time + random.Random(time).randint(0, 100_000))
    for time in shaken:
        writer.write("/text", time, time, text("x"))
    writer.close()
    assert shaken != times
    assert [message.log_time for message in open_bag(tmp_path / "bag").messages()] == times
    late = open_bag(tmp_path / "bag").messages(start=times[1200])
    assert [message.log_time for message in late] == times[1200:]
    assert list(open_bag(tmp_path / "bag").messages(topics=["/other"])) == []


# Damage


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A good bag."""
    directory = tmp_path_factory.mktemp("whole") / "bag"
    write_bag(directory)
    return directory


def damaged(whole: Path, tmp_path: Path, damage: Callable[[bytes], bytes], *, metadata: bool = True) -> Bag:
    shutil.copytree(whole, tmp_path / "bag")
    path = tmp_path / "bag" / "bag_0.mcap"
    path.write_bytes(damage(path.read_bytes()))
    if not metadata:
        (tmp_path / "bag" / "metadata.yaml").unlink()
    return open_bag(tmp_path / "bag", verify=True)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9, 0.999])
def test_a_truncated_bag_gives_what_is_before_the_cut(whole: Path, tmp_path: Path, share: float) -> None:
    bag = damaged(whole, tmp_path, lambda data: data[: int(len(data) * share)], metadata=False)
    assert any("truncated" in problem for problem in bag.problems)
    assert any("metadata.yaml" in problem for problem in bag.problems)
    assert 300 * share - 60 <= bag.metadata.messages <= 300
    assert bag.metadata.messages % 50 == 0  # whole chunks
    assert len(list(bag.messages())) == bag.metadata.messages
    if bag.metadata.messages:
        assert {t.name: t.type for t, _ in bag.metadata.topics}["/plan"] == TRAJECTORY


def scratched(data: bytes) -> bytes:
    middle = len(data) // 3
    return data[:middle] + bytes(byte ^ 0x55 for byte in data[middle : middle + 40]) + data[middle + 40 :]


@pytest.mark.parametrize("seed", range(40))
def test_any_damage_is_survived(whole: Path, tmp_path: Path, seed: int) -> None:
    dice = random.Random(seed)

    def hurt(data: bytes) -> bytes:
        broken = bytearray(data)
        for _ in range(dice.randint(1, 30)):
            broken[dice.randrange(8, len(broken))] = dice.randrange(256)
        return bytes(broken[: dice.randrange(100, len(broken) + 1)])

    bag = damaged(whole, tmp_path, hurt)
    told: list[str] = []
    assert len(list(bag.messages(on_problem=told.append))) == bag.metadata.messages <= 300
    assert bag.problems or bag.metadata.messages == 300
    assert "Topic information:" in summary(bag.metadata, bag.size)


def read_by_others(directory: Path) -> list[tuple[str, int, bytes]]:
    """Read a bag with two readers that share nothing with this package; both must see the same."""
    with AnyReader([directory]) as reader:
        read = [(c.topic, time, bytes(data)) for c, time, data in reader.messages()]
    streams = [path.open("rb") for path in sorted(directory.glob("*.mcap"))]
    found = [found for stream in streams for found in make_reader(stream).iter_messages()]
    assert [(channel.topic, message.log_time, message.data) for _, channel, message in found] == read
    for stream in streams:
        stream.close()
    return read


@pytest.mark.parametrize(("preset", "share"), [("zstd_fast", 0.3), *((preset, 0.6) for preset in PRESETS)])
def test_a_repaired_bag_is_read_by_everybody(tmp_path: Path, preset: str, share: float) -> None:
    written = write_bag(tmp_path / "bag", preset=preset, max_duration=2_000_000_000, custom_data={"a": "b"})
    last = tmp_path / "bag" / "bag_1.mcap"
    whole = (tmp_path / "bag" / "bag_0.mcap").read_bytes()
    data = last.read_bytes()
    last.write_bytes(data[: int(len(data) * share)])
    with pytest.raises(Exception, match=r"(?i)magic|truncat|end"):
        read_by_others(tmp_path / "bag")
    told: list[str] = []
    bag = reindex(tmp_path / "bag", told.append)
    read = read_by_others(tmp_path / "bag")
    assert read == written[: len(read)]
    assert 200 + 100 * share - 50 <= len(read) < 300
    assert (len(told), "bag_1.mcap" in told[0]) == (1, True)
    assert (tmp_path / "bag" / "bag_0.mcap").read_bytes() == whole
    assert any("messages that the metadata count" in problem for problem in bag.problems)
    assert {topic.name for topic, _ in bag.metadata.topics} == {"/text", "/plan", "/silent"}
    again = open_bag(tmp_path / "bag", verify=True)
    assert (again.problems, again.metadata.messages) == ((), len(read))
    assert again.metadata.custom_data == {"a": "b"}
    latched = {t.name: [q.durability for q in t.offered_qos] for t, _ in again.metadata.topics}
    assert latched["/text"] == ["volatile", "transient_local"]
    assert reindex(tmp_path / "bag", told.append).problems == ()
    assert len(told) == 1
    with last.open("rb") as stream:
        assert [m.sequence for _, _, m in make_reader(stream).iter_messages()] == list(range(200, len(read)))


def test_a_damaged_chunk_is_cut_out_of_a_repaired_bag(tmp_path: Path) -> None:
    written = write_bag(tmp_path / "bag")
    path = tmp_path / "bag" / "bag_0.mcap"
    path.write_bytes(scratched(path.read_bytes()))
    (tmp_path / "bag" / "metadata.yaml").unlink()
    assert any("damaged chunk" in problem for problem in open_bag(tmp_path / "bag", verify=True).problems)
    reindex(tmp_path / "bag")
    read = read_by_others(tmp_path / "bag")
    assert len(read) == 250
    assert set(read) < set(written)


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


@pytest.mark.parametrize("content", [b"", b"\x89MCAP", b"not a bag at all", b"\x00" * 1000])
def test_what_is_no_mcap_file_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(content)
    with pytest.raises(Ros2CliError, match="is not an MCAP file") as caught:
        open_bag(path)
    assert caught.value.code == "not_mcap"


def test_missing_and_empty_bags_are_told_apart(tmp_path: Path) -> None:
    with pytest.raises(Ros2CliError) as caught:
        open_bag(tmp_path / "nothing")
    assert caught.value.code == "bag_missing"
    with pytest.raises(Ros2CliError) as caught:
        open_bag(tmp_path)
    assert caught.value.code == "bag_empty"


@pytest.mark.parametrize(
    "broken",
    [
        "",
        "[]",
        "rosbag2_bagfile_information: 3",
        "a: [",
        "rosbag2_bagfile_information: {version: 9}",
        "\x00\xff",
    ],
)
def test_broken_metadata_are_replaced_by_what_the_files_tell(tmp_path: Path, broken: str) -> None:
    write_bag(tmp_path / "bag", 10)
    (tmp_path / "bag" / "metadata.yaml").write_text(broken, encoding="latin-1")
    bag = open_bag(tmp_path / "bag")
    assert bag.metadata.messages == 10
    assert len(bag.problems) == 1
    assert bag.metadata.ros_distro == "jazzy"


def test_a_missing_file_of_a_bag_is_told(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag", max_duration=1_000_000_000)
    (tmp_path / "bag" / "bag_1.mcap").unlink()
    bag = open_bag(tmp_path / "bag")
    assert bag.metadata.messages == 200
    assert "'bag_1.mcap' is named" in bag.problems[0].replace(str(tmp_path / "bag") + "/", "")


def test_a_bag_of_another_storage_is_refused(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag", 3)
    path = tmp_path / "bag" / "metadata.yaml"
    path.write_text(path.read_text().replace("storage_identifier: mcap", "storage_identifier: sqlite3"))
    with pytest.raises(Ros2CliError) as caught:
        open_bag(tmp_path / "bag")
    assert caught.value.code == "storage_unsupported"


# Text


def test_the_summary_has_the_known_layout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import time

    monkeypatch.setenv("TZ", "UTC")
    time.tzset()
    write_bag(tmp_path / "bag")
    bag = open_bag(tmp_path / "bag")
    lines = summary(bag.metadata, 1536).splitlines()
    assert lines == [
        "",
        "Files:             bag_0.mcap",
        "Bag size:          1.5 KiB",
        "Storage id:        mcap",
        "ROS Distro:        jazzy",
        "Duration:          2.990000000s",
        "Start:             Nov 14 2023 22:13:20.123456789 (1700000000.123456789)",
        "End:               Nov 14 2023 22:13:23.113456789 (1700000003.113456789)",
        "Messages:          300",
        "Topic information: Topic: /text | Type: std_msgs/msg/String | Count: 200 | Serialization Format: "
        "cdr",
        "                   Topic: /plan | Type: trajectory_msgs/msg/JointTrajectory | Count: 100 | "
        "Serialization Format: cdr",
        "                   Topic: /silent | Type: std_msgs/msg/String | Count: 0 | Serialization Format: "
        "cdr",
        "Service:           0",
        "Service information: ",
    ]
    assert moment_text(0).endswith("1970 00:00:00.000000000 (0.000000000)")
    assert [size_text(size) for size in (0, 1023, 1024, 5 * 1024**3)] == [
        "0 B",
        "1023 B",
        "1.0 KiB",
        "5.0 GiB",
    ]
