# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time from a text on `text` to its first JointTrajectory, through the real translator and executor.

The bench stands in for driver and clock, at the driver's rate: simulated time runs with real time and the
robot follows, until the motion of the whole sentence has arrived; then the clock is set past its end, so that
200 sentences take seconds instead of the hour that signing them would take. The baseline, in turn in the same
run, is the same text echoed by a process that does nothing with it: what DDS alone costs.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus
from trajectory_msgs.msg import JointTrajectory

from nodes.bench_node import BenchNode, bench_graph, seconds
from report import Figure, percentiles
from teo_bringup.graph import Graph
from teo_description.humanoid import load_humanoid
from teo_names import COMMANDED_JOINTS, HOME

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


class _Robot:
    """Is where the trajectories say, in a simulated time that can be set forward."""

    def __init__(self, node: BenchNode, graph: Graph) -> None:
        """Stand at home."""
        self._node, self._graph = node, graph
        self._times = np.zeros(1)  # [s]
        self._points = np.array([[HOME[name] for name in COMMANDED_JOINTS]])
        self._ahead = 0.0  # of real time [s]
        self._due = 0.0  # [s] of real time, when it tells where it is
        self.arrived: list[float] = []  # [s] when each answer came
        self.states: list[int] = []  # of the executor, since the last text
        self.goal = self._points[0]
        node.create_subscription(JointTrajectory, "joint_trajectory", self._take, 10)
        node.create_subscription(String, "echo", lambda _: self.arrived.append(time.perf_counter()), 10)
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_subscription(
            ExecutorStatus, "executor_status", lambda status: self.states.append(status.state), latched
        )
        self._clock = node.create_publisher(Clock, "clock", 10)
        self._joints = node.create_publisher(JointState, "joint_states", 10)

    def wait_for(self, what: str, condition: Callable[[], bool]) -> None:
        """Tell time and where the robot is, until a condition holds.

        Raises:
            TimeoutError: It does not.
            GraphError: A process ended.
        """
        deadline = time.monotonic() + _TIMEOUT
        while not condition():
            now = time.monotonic()
            if now > deadline:
                raise TimeoutError(f"expected {what} within {_TIMEOUT} s")
            if now >= self._due:
                self._graph.check()
                self._tell(now + self._ahead)
                self._due = now + _TICK
            self._node.spin_once(self._due - time.monotonic())

    def measured(self, publisher: Publisher, message: String) -> float:
        """Time until a text is answered [s]."""
        self.arrived.clear()
        start = time.perf_counter()
        publisher.publish(message)
        self.wait_for("an answer", lambda: bool(self.arrived))
        return self.arrived[0] - start

    def pass_time(self) -> None:
        """Set the time past the end of all motion."""
        self._ahead += float(self._times[-1]) + 0.1 - (time.monotonic() + self._ahead)

    def _take(self, message: JointTrajectory) -> None:
        """Follow a trajectory from its stamp on, or at once if it has none."""
        self.arrived.append(time.perf_counter())
        begin = seconds(message.header.stamp) or time.monotonic() + self._ahead
        before = self._times < begin
        times = [begin + seconds(point.time_from_start) for point in message.points]
        here = self._at(begin)
        self._times = np.concatenate([self._times[before], [begin], times])
        self._points = np.concatenate(
            [self._points[before], here[None], [point.positions for point in message.points]]
        )
        self.goal = self._points[-1]

    def _at(self, now: float) -> np.ndarray:
        """Positions of the commanded joints at a time [s]. Shape (28,)."""
        return np.array([np.interp(now, self._times, column) for column in self._points.T])

    def _tell(self, now: float) -> None:
        state = JointState(name=list(COMMANDED_JOINTS))
        state.header.stamp.sec, state.header.stamp.nanosec = int(now), int(now % 1 * 1e9)
        here = self._at(now)
        state.position, state.velocity = here.tolist(), ((self._at(now + _TICK) - here) / _TICK).tolist()
        self._clock.publish(Clock(clock=state.header.stamp))
        self._joints.publish(state)


def measure(sentences: int = 200) -> list[Figure]:
    """Time from a text to its trajectory and, as the baseline, to its echo."""
    latencies: dict[str, list[float]] = {"text to trajectory": [], "DDS echo": []}
    rest = load_humanoid().ready
    with bench_graph() as (node, graph):
        robot = _Robot(node, graph)
        text, call = (node.create_publisher(String, topic, 10) for topic in ("text", "call"))
        graph.start_nodes(["translator"])
        graph.start_nodes(["executor"], ("--ros-args", "-p", "use_sim_time:=true", "-p", "journal:=''"))
        graph.start("echo", sys.executable, "-c", _ECHO)
        robot.wait_for(
            "the nodes",
            lambda: all(node.count_subscribers(topic) == 1 for topic in ("text", "call", "sign_tokens")),
        )
        robot.wait_for("the executor", lambda: ExecutorStatus.STATE_IDLE in robot.states)
        for index in range(sentences):
            message = String(data=_TEXTS[index % len(_TEXTS)])
            latencies["DDS echo"].append(robot.measured(call, message))
            latencies["text to trajectory"].append(robot.measured(text, message))
            robot.wait_for("signing", lambda: ExecutorStatus.STATE_SIGNING in robot.states)
            robot.wait_for("the whole motion", lambda: bool(np.allclose(robot.goal, rest)))
            robot.states.clear()
            robot.pass_time()
            robot.wait_for("the end", lambda: ExecutorStatus.STATE_IDLE in robot.states)
    return [percentiles(name, values) for name, values in latencies.items()]
