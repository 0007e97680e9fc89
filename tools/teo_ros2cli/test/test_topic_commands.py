# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The commands in a running graph: processes over DDS, in a domain of their own."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

import pytest
from sensor_msgs.msg import JointState
from std_msgs.msg import String

TRAJECTORY = (
    "{header: {frame_id: base_link}, joint_names: [a, 'b c'], points: [{positions: [0.25, -1e-3], "
    "time_from_start: {sec: 1, nanosec: 500000000}}, {positions: [1, 2], velocities: [.inf, 0]}]}"
)
Command = Callable[..., subprocess.CompletedProcess[str]]


def test_pub_once_waits_for_a_subscription_and_echo_prints_what_it_sends(graph: Any, start: Any) -> None:
    del graph
    kind = "trajectory_msgs/msg/JointTrajectory"
    pub = start("topic", "pub", "--once", "/plan", kind, TRAJECTORY)
    pub.wait_for_line("Waiting for at least 1 matching subscription(s)...")
    echo = start("topic", "echo", "--once", "/plan", kind)
    assert (pub.finish(), echo.finish()) == (0, 0)
    assert "publisher: beginning loop" in pub.lines
    sent = "publishing #1: trajectory_msgs.msg.JointTrajectory(header=std_msgs.msg.Header("
    assert pub.wait_for_line(sent).endswith(")])")
    points = (
        "- positions:\n  - 0.25\n  - -0.001\n  velocities: []\n  accelerations: []\n  effort: []\n"
        "  time_from_start:\n    sec: 1\n    nanosec: 500000000\n"
        "- positions:\n  - 1.0\n  - 2.0\n  velocities:\n  - .inf\n  - 0.0\n  accelerations: []\n"
        "  effort: []\n  time_from_start:\n    sec: 0\n    nanosec: 0\n---"
    )
    assert echo.text == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: base_link\n"
        f"joint_names:\n- a\n- b c\npoints:\n{points}"
    )


# A subscription in a process of its own: prints what comes.
LISTENER = """
import sys
import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("listener")
profile = QoSProfile(depth=10, reliability=ReliabilityPolicy[sys.argv[1]])
node.create_subscription(String, "text", lambda message: print("got", message.data, "."), profile)
print("listening")
rclpy.spin(node)
"""


@pytest.mark.slow
def test_pub_once_reaches_each_of_three_processes_with_each_text(
    domain_id: int,  # noqa: ARG001
    prompt_discovery: None,  # noqa: ARG001
    ros2: Command,
    start: Any,
) -> None:
    burners, texts = 2, 4
    kinds = ("RELIABLE", "BEST_EFFORT", "BEST_EFFORT")
    listeners = [start("-c", LISTENER, kind, program=sys.executable) for kind in kinds]
    for listener in listeners:
        listener.wait_for_line("listening")
    for _ in range(burners):
        start("-c", "while True: pass", program=sys.executable)
    for number in range(texts):
        done = ros2("topic", "pub", "--once", "/text", "std_msgs/msg/String", f"{{data: text {number}}}")
        assert (done.returncode, done.stderr) == (0, "")
    for listener in listeners:
        # Best effort is not acknowledged: the last one may still be on its way.
        listener.wait_for_line(f"got text {texts - 1} .")
        assert listener.lines == ["listening", *(f"got text {number} ." for number in range(texts))]


@pytest.mark.slow
def test_pub_waits_for_the_acknowledgement_of_a_process_that_is_held_up(
    domain_id: int,  # noqa: ARG001
    prompt_discovery: None,  # noqa: ARG001
    start: Any,
) -> None:
    listener = start("-c", LISTENER, "RELIABLE", program=sys.executable)
    listener.wait_for_line("listening")
    words = ("/text", "std_msgs/msg/String", "{data: held}")
    pub = start("topic", "pub", "--keep-alive", "0", "-t", "2", "-r", "2", *words)
    pub.wait_for_line("publishing #1")
    listener.process.send_signal(signal.SIGSTOP)
    pub.wait_for_line("publishing #2")
    with pytest.raises(subprocess.TimeoutExpired):
        pub.process.wait(0.5)
    listener.process.send_signal(signal.SIGCONT)
    assert pub.finish() == 0
    assert "Not every subscription" not in pub.text


@pytest.mark.slow
def test_pub_so_many_times_with_its_own_name_and_stamp(graph: Any, ros2_here: Command) -> None:
    came: list[JointState] = []
    graph.node.create_subscription(JointState, "state", came.append, 10)
    before = time.time()
    options = ("-t", "3", "-r", "50", "-p", "2", "-n", "me")
    done = ros2_here("topic", "pub", *options, "/state", "sensor_msgs/JointState", "{header: auto}")
    assert done.returncode == 0
    assert re.findall(r"publishing #(\d)", done.stdout) == ["2"]
    graph.wait_until(lambda: len(came) == 3, "three messages came")
    stamps = [message.header.stamp.sec + message.header.stamp.nanosec * 1e-9 for message in came]
    assert before < stamps[0] < stamps[1] < stamps[2] < time.time()


def test_pub_gives_up_waiting_if_told_to(graph: Any, ros2_here: Command) -> None:
    del graph
    words = ("-w", "2", "--max-wait-time-secs", "0.3", "/x", "std_msgs/msg/String")
    done = ros2_here("topic", "pub", "--once", *words)
    assert done.returncode == 1
    assert done.stderr == "Timed out waiting for subscribers: Expected 2 subscribers but only got 0.\n"


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 2), (signal.SIGTERM, 143)])
def test_an_interrupted_command_ends_without_noise(
    graph: Any, start: Any, number: signal.Signals, status: int
) -> None:
    publisher = graph.node.create_publisher(String, "text", 10)
    graph.node.create_timer(0.05, lambda: publisher.publish(String(data="x")))
    echo = start("topic", "echo", "/text")
    echo.wait_for_line("---")
    assert echo.stop(number) == status
    assert set(echo.lines) == {"data: x", "---"}
