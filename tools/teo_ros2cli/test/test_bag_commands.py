# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recording from and playing into a running graph: processes over DDS, in a domain of their own."""

from __future__ import annotations

import fcntl
import functools
import os
import pty
import signal
import subprocess
import sys
import termios
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from builtin_interfaces.msg import Time
from mcap_ros2.reader import read_ros2_messages
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from rosbags.highlevel import AnyReader
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_ros2cli.bags.bag import open_bag
from teo_ros2cli.bags.metadata import TopicRecord, read_metadata
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.interfaces import Schema, schema_of
from teo_ros2cli.qos import QosRecord

Command = Callable[..., subprocess.CompletedProcess[str]]
PATIENCE = 120.0
"""Longest time that anything may take [s], on a machine with ten things to do."""
TEXT = "std_msgs/msg/String"
START = 10**18
JOINTS = [f"Joint{i:02d}" for i in range(40)]
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
DEEP = QoSProfile(depth=1000)
# Prints how late it wakes [s], at moments a hundredth of a second apart until it is ended.
SLEEPER = """
import time
begin, i = time.monotonic(), 0
while True:
    i += 1
    time.sleep(max(begin + i / 100 - time.monotonic(), 0))
    print(time.monotonic() - begin - i / 100, flush=True)
"""


def state(i: int) -> JointState:
    message = JointState(name=JOINTS, position=[i + joint / 64 for joint in range(40)], velocity=[-0.5] * 40)
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(i * 10_000_000, 10**9)
    return message


def trajectory(i: int) -> JointTrajectory:
    points = [
        JointTrajectoryPoint(positions=[float(i), k / 8], accelerations=[0.0, -1.0]) for k in range(500)
    ]
    return JointTrajectory(joint_names=["a", "ñ"], points=points)


def wait_recording(running: Any, *topics: str) -> None:
    for topic in topics:
        running.wait_for_line(f"Subscribed to topic '{topic}'")


def publish_at(rate: float, count: int, *publish: Callable[[int], None]) -> None:
    started = time.monotonic()
    for i in range(count):
        for call in publish:
            call(i)
        time.sleep(max(0.0, started + (i + 1) / rate - time.monotonic()))


def text_bag(directory: Path) -> BagWriter:
    """A bag that is to be written, with a topic of texts."""
    writer = BagWriter(directory)
    writer.add_topic(TopicRecord("/text", TEXT), schema_of(TEXT))
    return writer


def make_text_bag(directory: Path, count: int, step: int) -> None:
    """Write a bag of numbers as text."""
    writer = text_bag(directory)
    for i in range(count):
        writer.write("/text", START + i * step, START + i * step, serialize_message(String(data=str(i))))
    writer.close()


def test_all_that_is_published_is_recorded_with_every_value(graph: Any, start: Any, tmp_path: Path) -> None:
    description = graph.node.create_publisher(String, "robot_description", LATCHED)
    description.publish(String(data="<robot name='TEO'/>"))  # long before the recorder
    # Ten messages are a tenth of a second: what a recorder that sleeps longer asks for again would be gone.
    states = graph.node.create_publisher(JointState, "joint_states", DEEP)
    plans = graph.node.create_publisher(JointTrajectory, "joint_trajectory", DEEP)
    others = ("-x", "rosout|parameter", "--custom-data", "robot=TEO")
    recorder = start("bag", "record", "-a", "-o", str(tmp_path / "bag"), *others)
    wait_recording(recorder, "/robot_description", "/joint_states", "/joint_trajectory")
    graph.wait_until(
        lambda: states.get_subscription_count() == plans.get_subscription_count() == 1, "all is matched"
    )

    def plan(i: int) -> None:
        if i % 50 == 0:
            plans.publish(trajectory(i))

    written: list[tuple[int, int]] = []  # system time just before and after each joint state [ns]

    def joint_state(i: int) -> None:
        before = time.time_ns()
        states.publish(state(i))
        written.append((before, time.time_ns()))

    publish_at(100.0, 100, joint_state, plan)
    for publisher in (states, plans):
        assert publisher.wait_for_all_acked(Duration(seconds=PATIENCE))
    assert recorder.stop() == 0
    assert recorder.wait_for_line("Recording stopped")

    read: dict[str, list[Any]] = {}
    for message in read_ros2_messages(str(tmp_path / "bag" / "bag_0.mcap")):
        read.setdefault(message.channel.topic, []).append(message)
    assert set(read) == {"/robot_description", "/joint_states", "/joint_trajectory"}
    (robot,) = read["/robot_description"]
    assert robot.ros_msg.data == "<robot name='TEO'/>"
    assert len(read["/joint_states"]) == 100
    for i, (message, (before, after)) in enumerate(zip(read["/joint_states"], written, strict=True)):
        assert message.ros_msg.name == JOINTS
        assert list(message.ros_msg.position) == list(state(i).position)
        stamp = message.ros_msg.header.stamp
        assert (stamp.sec, stamp.nanosec) == divmod(i * 10_000_000, 10**9)
        assert before - 1000 <= message.publish_time_ns <= after + 1000  # DDS counts fractions of 2**-32 s
        assert 0 <= message.log_time_ns - message.publish_time_ns < 500_000_000
    for message, i in zip(read["/joint_trajectory"], (0, 50), strict=True):
        assert list(message.ros_msg.points[499].positions) == [float(i), 499 / 8]
        assert list(message.ros_msg.points[499].accelerations) == [0.0, -1.0]

    metadata = read_metadata(tmp_path / "bag")
    assert metadata.custom_data == {"robot": "TEO"}
    offered = {topic.name: topic.offered_qos for topic, _ in metadata.topics}
    assert [qos.durability for qos in offered["/robot_description"]] == ["transient_local"]
    assert [qos.durability for qos in offered["/joint_states"]] == ["volatile"]
    hashes = {topic.name: topic.type_hash for topic, _ in metadata.topics}
    assert hashes["/robot_description"].startswith("RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288")


@pytest.mark.slow
def test_a_bag_plays_as_it_was_recorded(graph: Any, start: Any, tmp_path: Path) -> None:
    writer = text_bag(tmp_path / "bag")
    latched = QosRecord(depth=1, durability="transient_local")
    writer.add_topic(TopicRecord("/robot", TEXT, offered_qos=(latched,)), schema_of(TEXT))
    for topic, i in (("/robot", 0), *(("/text", i) for i in range(150))):
        writer.write(topic, START + i * 10_000_000, 0, serialize_message(String(data=f"{topic} {i}")))
    writer.close()
    came: list[tuple[str, int]] = []
    qualities: list[DurabilityPolicy] = []

    def note(message: String, info: dict[str, Any]) -> None:
        came.append((message.data, info["source_timestamp"]))
        if not qualities:
            offers = graph.node.get_publishers_info_by_topic("robot")
            qualities.extend(info.qos_profile.durability for info in offers)

    graph.node.create_subscription(String, "played", note, DEEP)
    sleeper = start("-c", SLEEPER, program=sys.executable)
    player = start("bag", "play", str(tmp_path / "bag"), "--remap", "/text:=/played")
    assert player.finish() == 0
    assert "Set rate to 1" in player.text
    assert "Played 151 messages." in player.text
    graph.wait_until(lambda: len(came) == 150, "all came")
    assert [data for data, _ in came] == [f"/text {i}" for i in range(150)]
    assert qualities == [DurabilityPolicy.TRANSIENT_LOCAL]
    # Published at the distances of reception, as well as a process keeps time that does nothing besides.
    errors = sorted(abs((moment - came[0][1]) * 1e-9 - i / 100) for i, (_, moment) in enumerate(came))
    sleeper.stop(signal.SIGKILL)
    late = sorted(float(line) for line in sleeper.lines[:-1])
    assert errors[len(errors) // 2] < 0.005 + late[len(late) // 2]


@pytest.mark.slow
def test_playing_is_faster_partial_and_repeated_on_request(
    graph: Any, start: Any, ros2_here: Command, tmp_path: Path
) -> None:
    make_text_bag(tmp_path / "bag", 20, step=1_000_000_000)
    came: list[str] = []
    moments: list[int] = []

    def note(message: String, info: dict[str, Any]) -> None:
        came.append(message.data)
        moments.append(info["source_timestamp"])

    graph.node.create_subscription(String, "text", note, DEEP)
    done = ros2_here("bag", "play", str(tmp_path / "bag"), "-r", "200", "-d", "1", "--start-offset", "9.5")
    assert done.returncode == 0
    graph.wait_until(lambda: len(moments) == 10, "the second half came")
    assert came == [str(i) for i in range(10, 20)]
    assert (moments[-1] - moments[0]) * 1e-9 < 4.5  # 9 as recorded, 0.045 on a machine that keeps up
    came.clear()
    part = ros2_here(
        "bag", "play", str(tmp_path / "bag"), "-r", "200", "-d", "1", "--playback-duration", "5.5"
    )
    assert "Played 6 messages." in part.stderr
    came.clear()
    loop = start("bag", "play", str(tmp_path / "bag"), "-l", "-r", "500", "--topics", "/text", "/nothing")
    loop.wait_for_line("Topic '/nothing' is not in the bag; it holds /text")
    graph.wait_until(lambda: came.count("5") >= 2, "it came twice")
    assert loop.stop() == 0


@pytest.mark.slow
def test_keys_pause_and_step(graph: Any, start: Any, tmp_path: Path) -> None:
    make_text_bag(tmp_path / "bag", 5, step=1000)
    came: list[str] = []
    graph.node.create_subscription(String, "text", lambda message: came.append(message.data), DEEP)
    keys, terminal = pty.openpty()

    def control() -> None:
        os.setsid()
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)

    player = start("bag", "play", str(tmp_path / "bag"), "-p", stdin=terminal, preexec_fn=control)
    player.wait_for_line("Press CURSOR_RIGHT for Play Next Message")
    player.wait_for_line("Playback until timestamp: -1")

    pressed = 0

    def step() -> list[str]:
        # A message that is played before the subscription is matched is lost: then one more.
        nonlocal pressed
        pressed += os.write(keys, b"\x1b[C") == 3
        deadline = time.monotonic() + 2.0
        while not came and time.monotonic() < deadline:
            time.sleep(0.01)
        return came

    graph.wait_until(step, "a message came")
    assert len(came) <= pressed, "a press plays one message"
    os.write(keys, b" ")
    assert player.finish() == 0
    graph.wait_until(lambda: came[-1] == "4", "the others came")
    os.close(keys)
    os.close(terminal)


def test_simulated_time_stamps_what_is_recorded(graph: Any, start: Any, tmp_path: Path) -> None:
    clock = graph.node.create_publisher(Clock, "/clock", DEEP)
    texts = graph.node.create_publisher(String, "text", DEEP)
    recorder = start("bag", "record", "--use-sim-time", "-o", str(tmp_path / "bag"), "--topics", "/text")
    wait_recording(recorder, "/text")
    recorder.wait_for_line("All requested topics are subscribed. Stopping discovery...")
    graph.wait_until(
        lambda: texts.get_subscription_count() == clock.get_subscription_count() == 1, "all is matched"
    )
    texts.publish(String(data="before the clock runs"))
    assert texts.wait_for_all_acked(Duration(seconds=PATIENCE))
    for i in range(1, 4):
        time.sleep(0.1)
        clock.publish(Clock(clock=Time(sec=1000 * i)))
        time.sleep(0.1)
        texts.publish(String(data=str(i)))
    assert texts.wait_for_all_acked(Duration(seconds=PATIENCE))
    time.sleep(0.2)
    assert recorder.stop() == 0
    assert [m.log_time for m in open_bag(tmp_path / "bag").messages()] == [
        i * 1000 * 10**9 for i in (1, 2, 3)
    ]


def test_the_clock_is_played_at_a_rate_or_with_the_messages(
    graph: Any, ros2_here: Command, tmp_path: Path
) -> None:
    make_text_bag(tmp_path / "bag", 11, step=100_000_000)
    play = functools.partial(ros2_here, "bag", "play", str(tmp_path / "bag"))
    came: list[float] = []
    graph.node.create_subscription(
        Clock, "/clock", lambda message: came.append(message.clock.sec + message.clock.nanosec * 1e-9), DEEP
    )
    assert play("-r", "0.5", "-d", "1", "--clock", "50").returncode == 0
    assert 60 <= len(came) <= 110  # two seconds; a tick that a busy machine cannot make in time is left out
    assert came == sorted(came)
    assert 1e9 <= came[0] < came[-1] <= 1e9 + 1.1
    came.clear()
    # A second before the first message: who listens has found the clock by then.
    assert play("-r", "2", "-d", "1", "--clock-topics", "/text").returncode == 0
    told = [1e9 + i / 10 for i in range(11)]
    graph.wait_until(lambda: came[-11:] == pytest.approx(told), "the clock was told before each message")
    assert len(came) < 15  # the last of the first time may have come late
    both = play("--clock", "10", "--clock-topics-all")
    assert (both.returncode, "not allowed with argument" in both.stderr) == (2, True)


@pytest.mark.slow
def test_unknown_types_and_damage_are_told_and_the_rest_is_played(
    graph: Any, ros2_here: Command, tmp_path: Path
) -> None:
    writer = text_bag(tmp_path / "bag")
    kind = "lost_msgs/msg/Odd"
    writer.add_topic(TopicRecord("/odd", kind), Schema(kind, "ros2msg", "string data\n"))
    for i in range(5):
        for topic in ("/text", "/odd"):
            writer.write(topic, START + i, START + i, serialize_message(String(data=str(i))))
    writer.close()
    (tmp_path / "bag" / "metadata.yaml").unlink()
    came: list[str] = []
    graph.node.create_subscription(String, "text", lambda message: came.append(message.data), DEEP)
    done = ros2_here("bag", "play", str(tmp_path / "bag"), "-d", "1")
    assert done.returncode == 0
    assert "has no metadata.yaml" in done.stderr
    assert "Ignoring a topic '/odd', reason: " in done.stderr
    graph.wait_until(lambda: len(came) == 5, "all came")
    for words in (
        [str(tmp_path / "none")],
        [str(tmp_path / "bag"), "--remap", "a"],
        [str(tmp_path / "bag"), "-e", "("],
    ):
        refused = ros2_here("bag", "play", *words)
        assert (refused.returncode, refused.stderr.startswith("[ERROR] [ros2bag]: ")) == (1, True)


def test_a_killed_recorder_leaves_what_came_before_the_last_second(
    graph: Any, start: Any, ros2_here: Command, tmp_path: Path
) -> None:
    texts = graph.node.create_publisher(String, "text", DEEP)
    recorder = start("bag", "record", "/text", "-o", str(tmp_path / "bag"))
    wait_recording(recorder, "/text")
    graph.wait_until(lambda: texts.get_subscription_count() == 1, "the recorder is matched")
    publish_at(100.0, 200, lambda i: texts.publish(String(data=str(i))))
    recorder.stop(signal.SIGKILL)
    assert not (tmp_path / "bag" / "metadata.yaml").exists()
    done = ros2_here("bag", "info", str(tmp_path / "bag"))
    assert done.returncode == 0
    assert "truncated" in done.stderr
    messages = list(open_bag(tmp_path / "bag").messages())
    assert 50 <= len(messages) <= 200
    assert [m.data[8:-1].rstrip(b"\0").decode() for m in messages] == [str(i) for i in range(len(messages))]
    assert ros2_here("bag", "reindex", str(tmp_path / "bag"), "-o", str(tmp_path / "whole")).returncode == 0
    with AnyReader([tmp_path / "whole"]) as reader:
        assert [bytes(data) for _, _, data in reader.messages()] == [m.data for m in messages]
    assert not (tmp_path / "bag" / "metadata.yaml").exists()


@pytest.mark.slow
def test_topics_that_appear_and_publishers_that_differ_are_recorded(
    graph: Any, start: Any, tmp_path: Path
) -> None:
    first = graph.node.create_publisher(String, "text", LATCHED)
    first.publish(String(data="latched"))
    recorder = start("bag", "record", "-a", "-o", str(tmp_path / "bag"), "--include-unpublished-topics")
    wait_recording(recorder, "/text")
    # A subscription without a publisher, and a second publisher that offers less than the recorder asks for.
    graph.node.create_subscription(String, "waiting", lambda _: None, 10)
    graph.node.create_subscription(JointState, "awaited", lambda _: None, LATCHED)
    weak = graph.node.create_publisher(
        String, "text", QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
    )
    wait_recording(recorder, "/waiting", "/awaited")
    awaited = graph.node.create_publisher(JointState, "awaited", LATCHED)
    awaited.publish(state(0))

    def reliabilities() -> list[ReliabilityPolicy]:
        return [info.qos_profile.reliability for info in graph.node.get_subscriptions_info_by_topic("text")]

    graph.wait_until(
        lambda: reliabilities() == [ReliabilityPolicy.BEST_EFFORT], "the weaker subscription is the only one"
    )
    graph.wait_until(
        lambda: weak.get_subscription_count() == first.get_subscription_count() == 1, "both are matched"
    )
    for i in range(10):
        weak.publish(String(data=f"weak {i}"))
        first.publish(String(data=f"first {i}"))
        time.sleep(0.01)
    late = graph.node.create_publisher(JointState, "late", LATCHED)
    late.publish(state(1))
    wait_recording(recorder, "/late")
    graph.wait_until(lambda: late.get_subscription_count() == 1, "the late topic is matched")
    for publisher in (late, awaited):
        graph.wait_until(
            lambda publisher=publisher: publisher.wait_for_all_acked(Duration(seconds=0.1)),
            "the recorder has the late messages",
        )
    assert recorder.stop() == 0
    found = [
        m.ros_msg.data
        for m in read_ros2_messages(str(tmp_path / "bag" / "bag_0.mcap"))
        if m.channel.topic == "/text"
    ]
    assert sorted(found) == sorted(
        ["latched", *(f"{who} {i}" for who in ("weak", "first") for i in range(10))]
    )
    topics = {topic.name: (topic, n) for topic, n in read_metadata(tmp_path / "bag").topics}
    assert (topics["/late"][1], topics["/awaited"][1], topics["/waiting"][1]) == (1, 1, 0)
    # What publishers offer that came after the recorder is known as well: in the metadata and in the file.
    for source in (
        topics,
        {t.name: (t, n) for t, n in open_bag(tmp_path / "bag" / "bag_0.mcap").metadata.topics},
    ):
        assert [qos.durability for qos in source["/awaited"][0].offered_qos] == ["transient_local"]
        assert sorted(qos.reliability for qos in source["/text"][0].offered_qos)[-1:] == ["reliable"]
        assert source["/waiting"][0].offered_qos == ()


def test_a_stop_before_anything_leaves_a_good_empty_bag(
    domain_id: int, start: Any, ros2_here: Command, tmp_path: Path
) -> None:
    del domain_id
    recorder = start("bag", "record", "/nothing", cwd=tmp_path)
    recorder.wait_for_line("Recording...")
    assert recorder.stop(signal.SIGTERM) == 0
    (bag,) = tmp_path.iterdir()
    assert bag.name.startswith("rosbag2_2")
    assert "holds no messages" in ros2_here("bag", "info", str(bag)).stderr
    with AnyReader([bag]) as reader:
        assert reader.message_count == 0
    assert (
        ros2_here("bag", "record", "-a", "-o", str(bag)).stderr
        == f"[ERROR] [ros2bag]: Output folder '{bag}' already exists.\n"
    )
