# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time from a text on `text` to its first JointTrajectory, through the real translator and executor.

The bench stands in for driver and clock: simulated time runs with real time, and as soon as a trajectory
arrives it is set past the trajectory's end and the robot reported there, so that 200 sentences take seconds
instead of the hour that signing them would take. The baseline, in the same run, is the same text echoed by a
process that does nothing with it: what DDS alone costs.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from report import Figure, percentiles
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus
from trajectory_msgs.msg import JointTrajectory

from teo_bringup.graph import Graph
from teo_description import ALL_JOINTS, HOME

SENTENCES = 200
_TEXTS = (
    "¿Qué tal?",
    "Me llamo Ana.",
    "Buenos días",
    "Yo tengo 7 años",
    "Hola",
    "¡Vamos a comer!",
    "Dame la mano",
)
_TIMEOUT = 60.0  # [s] for one answer, start of the processes included
_TICK = 0.002  # [s] between clock messages

_ECHO = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("echo")
publisher = node.create_publisher(String, "echo", 10)
node.create_subscription(String, "text", publisher.publish, 10)
rclpy.spin(node)
"""


@dataclass
class _Inbox:
    """What has arrived since it was last emptied."""

    trajectories: list[JointTrajectory] = field(default_factory=list)
    echoes: list[String] = field(default_factory=list)
    states: list[int] = field(default_factory=list)


def measure(sentences: int = SENTENCES) -> list[Figure]:
    """Time from a text to its trajectory and, as the baseline, to its echo."""
    os.environ.setdefault("ROS_DOMAIN_ID", "19")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    rclpy.init()
    node = Node("bench")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    inbox = _Inbox()
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(JointTrajectory, "joint_trajectory", inbox.trajectories.append, 10)
    node.create_subscription(String, "echo", inbox.echoes.append, 10)
    node.create_subscription(
        ExecutorStatus, "executor_status", lambda m: inbox.states.append(m.state), latched
    )
    text = node.create_publisher(String, "text", 10)
    clock = node.create_publisher(Clock, "clock", 10)
    joints = node.create_publisher(JointState, "joint_states", 10)
    home = JointState(
        name=list(ALL_JOINTS), position=[HOME[name] for name in ALL_JOINTS], velocity=[0.0] * 40
    )
    ahead = 0.0  # of simulated time before real time [s]

    def tick() -> None:
        now = time.monotonic() + ahead
        home.header.stamp.sec, home.header.stamp.nanosec = int(now), int(now % 1 * 1e9)
        clock.publish(Clock(clock=home.header.stamp))
        joints.publish(home)

    def wait(condition: Callable[[], bool]) -> None:
        deadline = time.monotonic() + _TIMEOUT
        while not condition():
            if time.monotonic() > deadline:
                raise TimeoutError(f"no answer within {_TIMEOUT} s")
            graph.check()
            tick()
            executor.spin_once(timeout_sec=_TICK)

    latencies: dict[str, list[float]] = {"text to trajectory": [], "DDS echo": []}
    with tempfile.TemporaryDirectory() as folder, Graph(log_folder=Path(folder)) as graph:
        graph.start("translator", "ros2", "run", "teo_sign_translator", "translator_node")
        simulated = ("--ros-args", "-p", "use_sim_time:=true")
        graph.start("executor", "ros2", "run", "teo_lut_executor", "executor_node", *simulated)
        graph.start("echo", sys.executable, "-c", _ECHO)
        wait(lambda: node.count_subscribers("text") == 2 and node.count_subscribers("sign_tokens") == 1)
        wait(lambda: ExecutorStatus.STATE_IDLE in inbox.states)
        for index in range(sentences):
            inbox.trajectories.clear()
            inbox.echoes.clear()
            start = time.perf_counter()
            text.publish(String(data=_TEXTS[index % len(_TEXTS)]))
            wait(lambda: bool(inbox.echoes))
            latencies["DDS echo"].append(time.perf_counter() - start)
            wait(lambda: bool(inbox.trajectories))
            latencies["text to trajectory"].append(time.perf_counter() - start)
            inbox.states.clear()
            end = inbox.trajectories[0].points[-1].time_from_start
            ahead += end.sec + end.nanosec * 1e-9 + 0.1
            wait(lambda: ExecutorStatus.STATE_IDLE in inbox.states)
    node.destroy_node()
    rclpy.shutdown()
    return [percentiles(name, values) for name, values in latencies.items()]
