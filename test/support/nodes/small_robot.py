# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A small robot that follows what it is sent, and the executor before it, as tests see both."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
from made_signs import make_sign, small_table
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import JointState
from teo_sign_msgs.msg import DriverState, ExecutorStatus, SignSentence, SignToken
from trajectory_msgs.msg import JointTrajectory

from teo_lut_executor.node.executor_node import ExecutorNode
from teo_lut_executor.node.parameters import PARAMETERS
from teo_names import COMMANDED_JOINTS, HOME
from teo_signs.sign_file import save_sign
from teo_signs.tokens import parse_printed

# Joint states a second [Hz]: half of those of the driver, as executor and robot share one thread here.
RATE = 50.0
REPORT_STEPS = 5  # between what it says of itself while it moves, as the driver's
# Short signs near rest, so that a sentence takes about a second.
QUICK = ("NOD", "TURN", "LOOK")
NECK = ("AxialNeck", "FrontalNeck")
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class SmallRobot(Node):
    """Goes from point to point in straight lines from a motion's stamp on; keeps what the executor said.

    It says when a motion began, as the driver does: of one without a stamp nobody else knows, and a stop from
    where the robot is not makes it jump.
    """

    def __init__(self, context: Context) -> None:
        super().__init__("small_robot", context=context)
        self.silent = False
        self.received: list[JointTrajectory] = []
        self.statuses: list[ExecutorStatus] = []
        self.path: list[tuple[float, np.ndarray]] = []  # time [s] and positions [rad] of every step
        # By which a motion came after its stamp, at most [s]; the robot makes up for it at once.
        self.late = 0.0
        self.stand()
        self._states = self.create_publisher(JointState, "joint_states", 10)
        self._reports = self.create_publisher(DriverState, "driver_state", LATCHED)
        self.create_subscription(JointTrajectory, "joint_trajectory", self._on_trajectory, 10)
        self.create_subscription(ExecutorStatus, "executor_status", self.statuses.append, LATCHED)
        self.tokens = self.create_publisher(SignSentence, "sign_tokens", 1000)
        self.create_timer(1.0 / RATE, self._step)

    def stand(self, **elsewhere: float) -> None:
        """Be at rest, at home but for some joints [rad]."""
        self.positions = np.array([(HOME | elsewhere)[name] for name in COMMANDED_JOINTS])
        self._times = np.zeros(1)  # [s], of the clock
        self._points = self.positions[None]
        self._motions: list[tuple[float, float]] = []  # begin and end of what it follows [s], of the clock

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds * 1e-9)

    def _on_trajectory(self, message: JointTrajectory) -> None:
        assert tuple(message.joint_names) == COMMANDED_JOINTS
        self.received.append(message)
        stamp = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
        now = self._now()
        begin = stamp or now
        self.late = max(self.late, now - begin)
        here, before = self._at(begin), self._times < begin
        points = np.array([point.positions for point in message.points])
        times = [point.time_from_start.sec + point.time_from_start.nanosec * 1e-9 for point in message.points]
        self._times = np.concatenate([self._times[before], [begin], begin + np.array(times)])
        self._points = np.concatenate([self._points[before], here[None], points])
        self._motions = [motion for motion in self._motions if motion[0] < begin]
        self._motions.append((begin, begin + times[-1]))
        self._report(now)

    def _step(self) -> None:
        now = self._now()
        before, self.positions = self.positions, self._at(now)
        self.path.append((now, self.positions))
        if self.silent:
            return
        message = JointState(name=list(COMMANDED_JOINTS), position=self.positions.tolist())
        message.velocity = ((self.positions - before) * RATE).tolist()
        self._states.publish(message)
        if len(self.path) % REPORT_STEPS == 0:
            self._report(now)

    def _report(self, now: float) -> None:
        message = DriverState(mode=DriverState.MODE_HOLDING, speed_scaling=1.0)
        message.header.stamp = Time(nanoseconds=round(now * 1e9)).to_msg()
        begin, end = next((motion for motion in reversed(self._motions) if motion[0] <= now), (0.0, 0.0))
        if now < end:
            message.mode = DriverState.MODE_MOVING
            message.path_time, message.path_duration = now - begin, end - begin
        self._reports.publish(message)

    def _at(self, now: float) -> np.ndarray:
        return np.array([np.interp(now, self._times, column) for column in self._points.T])

    def states(self) -> list[int]:
        return [status.state for status in self.statuses]


@dataclass
class Graph:
    node: ExecutorNode
    robot: SmallRobot
    executor: SingleThreadedExecutor
    directory: Path
    utterances: int = field(default=0)

    def __post_init__(self) -> None:
        self._started = {row.name: self.node.get_parameter(row.name) for row in PARAMETERS}

    def spin_until(self, condition: Callable[[], bool], timeout: float = 90.0) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s"
            self.executor.spin_once(timeout_sec=0.1)

    def begin_anew(self) -> None:
        """Wait until it rests with nothing queued; as it was started then, with what it said forgotten."""
        self.robot.silent = False
        self.node.set_parameters(
            [parameter for parameter in self._started.values() if self._differs(parameter)]
        )
        self.spin_until(lambda: self.robot.states()[-1:] == [ExecutorStatus.STATE_IDLE])
        assert not self.robot.statuses[-1].queued
        self.robot.stand()
        self.utterances = 0
        del self.robot.statuses[:-1]
        self.robot.received.clear()
        self.robot.path.clear()
        self.robot.late = 0.0

    def _differs(self, parameter: Parameter) -> bool:
        return bool(self.node.get_parameter(parameter.name).value != parameter.value)

    def rest(self, signed: int) -> None:
        """Spin until so many sentences have been signed, and nothing is left to do."""
        states = self.robot.states
        self.spin_until(lambda: states().count(ExecutorStatus.STATE_SIGNING) >= signed)
        self.spin_until(lambda: states()[-1] == ExecutorStatus.STATE_IDLE)

    def refused(self) -> list[tuple[str, str]]:
        """Code and utterance of everything that was refused."""
        refused = [s for s in self.robot.statuses if s.state == ExecutorStatus.STATE_REFUSED]
        return [(status.code, status.utterance_id) for status in refused]

    def wait(self, future: Any) -> Any:
        self.spin_until(future.done)
        return future.result()

    def sentence(self, text: str, scale: float = 1.0) -> SignSentence:
        self.utterances += 1
        tokens = [
            SignToken(
                gloss=token.gloss, kind=int(token.kind), duration_scale=scale, word_index=token.word_index
            )
            for token in parse_printed(text)
        ]
        return SignSentence(utterance_id=f"text {self.utterances}", sentence_count=1, tokens=tokens)

    def publish(self, message: SignSentence) -> None:
        self.spin_until(lambda: self.robot.tokens.get_subscription_count() > 0)
        self.robot.tokens.publish(message)


def save_table(directory: Path) -> None:
    """The small table, and quick signs beside it."""
    directory.mkdir(parents=True, exist_ok=True)
    quick = (
        make_sign(gloss, [[0.1 * n, 0.05], [0.1 * n - 0.05, 0.0]], [0.0, 0.2], joints=NECK)
        for n, gloss in enumerate(QUICK)
    )
    for sign in (*small_table().values(), *quick):
        save_sign(directory, sign)


@contextmanager
def running(domain_id: int, *overrides: Parameter) -> Iterator[Graph]:
    """An executor and the small robot; where a `lut_directory` is given, signs are saved there."""
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    overrides = (Parameter("final_hold", value=0.0), *overrides)
    node = ExecutorNode(context=context, parameter_overrides=overrides)
    robot = SmallRobot(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(robot)
    assert node.start()
    directory = node.get_parameter("lut_directory").value
    yield Graph(node, robot, executor, Path(directory))
    executor.shutdown()
    robot.destroy_node()
    node.destroy_node()
    rclpy.shutdown(context=context)
