# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time from a text on `text` to its first JointTrajectory, through the real translator and executor.

The bench stands in for driver and clock, at the driver's rate: simulated time runs with real time and the
robot follows, until the motion of the whole sentence has arrived; then the clock is set past its end, so that
200 sentences take seconds instead of the hour that signing them would take. The baseline, in turn in the same
run, is the same text echoed by a process that does nothing with it: what DDS alone costs.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus
from trajectory_msgs.msg import JointTrajectory

from report import Figure, percentiles
from teo_bringup.graph import Graph
from teo_description.humanoid import load_humanoid
from teo_names import COMMANDED_JOINTS, HOME

REST = load_humanoid().ready

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
_TICK = 0.01  # [s] between joint states, and between clock messages

_ECHO = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("echo")
publisher = node.create_publisher(String, "echo", 10)
node.create_subscription(String, "call", publisher.publish, 10)
rclpy.spin(node)
"""


@dataclass
class _Inbox:
    """What has arrived since it was last emptied."""

    trajectories: list[JointTrajectory] = field(default_factory=list)
    arrived: list[float] = field(default_factory=list)  # [s] when each came
    states: list[int] = field(default_factory=list)


class _Robot:
    """Is where the trajectories say."""

    def __init__(self) -> None:
        """Stand at home."""
        self._times = np.zeros(1)  # [s]
        self._points = np.array([[HOME[name] for name in COMMANDED_JOINTS]])

    def take(self, message: JointTrajectory, now: float) -> None:
        """Follow a trajectory from its stamp on, or at once if it has none."""
        begin = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9 or now
        before = self._times < begin
        times = [p.time_from_start.sec + p.time_from_start.nanosec * 1e-9 for p in message.points]
        points = [p.positions for p in message.points]
        here = self.at(begin)
        self._times = np.concatenate([self._times[before], [begin], begin + np.array(times)])
        self._points = np.concatenate([self._points[before], here[None], points])

    @property
    def end(self) -> float:
        """When it stands [s]."""
        return float(self._times[-1])

    def at(self, now: float) -> np.ndarray:
        """Positions of the commanded joints at a time [s]. Shape (28,)."""
        return np.array([np.interp(now, self._times, column) for column in self._points.T])


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
    robot = _Robot()

    def on_trajectory(message: JointTrajectory) -> None:
        inbox.arrived.append(time.perf_counter())
        inbox.trajectories.append(message)
        robot.take(message, time.monotonic() + ahead)

    def on_echo(_: String) -> None:
        inbox.arrived.append(time.perf_counter())

    node.create_subscription(JointTrajectory, "joint_trajectory", on_trajectory, 10)
    node.create_subscription(String, "echo", on_echo, 10)
    node.create_subscription(
        ExecutorStatus, "executor_status", lambda m: inbox.states.append(m.state), latched
    )
    text = node.create_publisher(String, "text", 10)
    call = node.create_publisher(String, "call", 10)
    clock = node.create_publisher(Clock, "clock", 10)
    joints = node.create_publisher(JointState, "joint_states", 10)
    state = JointState(name=list(COMMANDED_JOINTS))
    ahead = 0.0  # of simulated time before real time [s]

    def tick() -> None:
        now = time.monotonic() + ahead
        state.header.stamp.sec, state.header.stamp.nanosec = int(now), int(now % 1 * 1e9)
        here = robot.at(now)
        state.position, state.velocity = here.tolist(), ((robot.at(now + _TICK) - here) / _TICK).tolist()
        clock.publish(Clock(clock=state.header.stamp))
        joints.publish(state)

    def ends_at_rest(message: JointTrajectory) -> bool:
        return bool(np.allclose(message.points[-1].positions, REST))

    def wait(condition: Callable[[], bool]) -> None:
        due = time.monotonic()
        deadline = due + _TIMEOUT
        while not condition():
            now = time.monotonic()
            if now > deadline:
                raise TimeoutError(f"no answer within {_TIMEOUT} s")
            if now >= due:
                graph.check()
                tick()
                due = now + _TICK
            executor.spin_once(timeout_sec=max(due - time.monotonic(), 0.0))

    def measured(publisher: Publisher, message: String) -> float:
        inbox.trajectories.clear()
        inbox.arrived.clear()
        start = time.perf_counter()
        publisher.publish(message)
        wait(lambda: bool(inbox.arrived))
        return inbox.arrived[0] - start

    latencies: dict[str, list[float]] = {"text to trajectory": [], "DDS echo": []}
    with tempfile.TemporaryDirectory() as folder, Graph(Path(folder)) as graph:
        graph.start("translator", "ros2", "run", "teo_sign_translator", "translator_node")
        simulated = ("--ros-args", "-p", "use_sim_time:=true", "-p", "journal:=''")
        graph.start("executor", "ros2", "run", "teo_lut_executor", "executor_node", *simulated)
        graph.start("echo", sys.executable, "-c", _ECHO)
        for topic in ("text", "call", "sign_tokens"):
            wait(lambda topic=topic: node.count_subscribers(topic) == 1)  # type: ignore[misc]
        wait(lambda: ExecutorStatus.STATE_IDLE in inbox.states)
        for index in range(sentences):
            message = String(data=_TEXTS[index % len(_TEXTS)])
            latencies["DDS echo"].append(measured(call, message))
            latencies["text to trajectory"].append(measured(text, message))
            wait(lambda: ExecutorStatus.STATE_SIGNING in inbox.states)
            wait(lambda: ends_at_rest(inbox.trajectories[-1]))
            inbox.states.clear()
            ahead += robot.end + 0.1 - (time.monotonic() + ahead)
            wait(lambda: ExecutorStatus.STATE_IDLE in inbox.states)
    node.destroy_node()
    rclpy.shutdown()
    return [percentiles(name, values) for name, values in latencies.items()]
