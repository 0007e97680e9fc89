# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node as its peers see it, with a small robot of the test's own that follows what it is sent."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from rcl_interfaces.msg import Parameter as ParameterMessage
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from teo_sign_msgs.action import ExecuteSentence
from teo_sign_msgs.msg import ExecutorStatus, SignSentence, SignToken
from teo_sign_msgs.srv import GetSign, ListSigns
from trajectory_msgs.msg import JointTrajectory

from teo_description import COMMANDED_JOINTS, HEAD, HOME, joint_limits
from teo_lut_executor.node.executor_node import ExecutorNode
from teo_lut_executor.node.parameters import PARAMETERS
from teo_signs.errors import LutError, PlanError
from teo_signs.sign_file import save_sign
from teo_signs.tokens import parse_printed

RATE = 100.0  # joint states a second [Hz]


class SmallRobot(Node):
    """Goes from point to point in straight lines, and keeps what the executor said."""

    def __init__(self, context: Context) -> None:
        super().__init__("small_robot", context=context)
        self.positions = np.array([HOME[name] for name in COMMANDED_JOINTS])
        self.received: list[JointTrajectory] = []
        self.statuses: list[ExecutorStatus] = []
        self.path: list[tuple[float, np.ndarray]] = []  # time [s] and positions [rad] of every step
        self._times = np.zeros(1)
        self._points = self.positions[None]
        self._begin = 0.0
        self._states = self.create_publisher(JointState, "joint_states", 10)
        self.create_subscription(JointTrajectory, "joint_trajectory", self._on_trajectory, 10)
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(ExecutorStatus, "executor_status", self.statuses.append, latched)
        self.tokens = self.create_publisher(SignSentence, "sign_tokens", 10)
        self.create_timer(1.0 / RATE, self._step)

    def _on_trajectory(self, message: JointTrajectory) -> None:
        assert tuple(message.joint_names) == COMMANDED_JOINTS
        self.received.append(message)
        points = np.array([point.positions for point in message.points])
        times = [point.time_from_start.sec + point.time_from_start.nanosec * 1e-9 for point in message.points]
        self._begin = time.monotonic()
        self._times = np.concatenate([[0.0], times])
        self._points = np.concatenate([self.positions[None], points])

    def _step(self) -> None:
        now = time.monotonic()
        elapsed = now - self._begin
        self.positions = np.array([np.interp(elapsed, self._times, column) for column in self._points.T])
        self.path.append((now, self.positions))
        message = JointState(name=list(COMMANDED_JOINTS), position=self.positions.tolist())
        message.velocity = [0.0] * len(message.position)
        self._states.publish(message)

    def states(self) -> list[int]:
        return [status.state for status in self.statuses]


@dataclass
class Graph:
    node: ExecutorNode
    robot: SmallRobot
    executor: SingleThreadedExecutor
    directory: Path
    utterances: int = field(default=0)

    def spin_until(self, condition: Callable[[], bool], timeout: float = 30.0) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s"
            self.executor.spin_once(timeout_sec=0.1)

    def rest(self, signed: int) -> None:
        """Spin until so many sentences have been signed, and nothing is left to do."""
        states = self.robot.states
        self.spin_until(lambda: states().count(ExecutorStatus.STATE_SIGNING) >= signed)
        self.spin_until(lambda: states()[-1] == ExecutorStatus.STATE_IDLE)

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


# Short signs near rest, so that a sentence takes about a second.
QUICK = ("NOD", "TURN", "LOOK")


@pytest.fixture
def graph(domain_id: int, table_directory: Path, make_sign: Callable[..., Any]) -> Iterator[Graph]:
    joints = ("AxialNeck", "FrontalNeck")
    for number, gloss in enumerate(QUICK):
        knots = [[0.1 * number, 0.05], [0.1 * number - 0.05, 0.0]]
        save_sign(table_directory, make_sign(gloss, knots, [0.0, 0.2], joints=joints))
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    overrides = [
        Parameter("lut_directory", value=str(table_directory)),
        Parameter("final_hold", value=0.0),
        Parameter("capacity", value=5),
    ]
    node = ExecutorNode(context=context, parameter_overrides=overrides)
    robot = SmallRobot(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(robot)
    yield Graph(node, robot, executor, table_directory)
    executor.shutdown()
    robot.destroy_node()
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_sentences_are_signed_in_order_and_bad_ones_refused_between(graph: Graph) -> None:
    empty = SignSentence(utterance_id="empty", sentence_count=1)
    nan = graph.sentence("NOD", scale=float("nan"))
    unknown = graph.sentence("Ω")
    odd = graph.sentence("NOD")
    odd.tokens[0].kind = 9
    typeless = graph.sentence("NOD")
    typeless.type = 9
    for message in (graph.sentence("NOD"), empty, nan):
        graph.publish(message)
    graph.spin_until(lambda: graph.robot.states().count(ExecutorStatus.STATE_REFUSED) == 2)
    for message in (unknown, odd, typeless, graph.sentence("TURN LOOK")):
        graph.publish(message)
    graph.rest(signed=2)
    codes = [status.code for status in graph.robot.statuses if status.state == ExecutorStatus.STATE_REFUSED]
    assert codes == ["empty_sentence", "bad_scale", "unknown_sign", "bad_kind", "bad_type"]
    signing = [status for status in graph.robot.statuses if status.state == ExecutorStatus.STATE_SIGNING]
    assert [[timing.token.gloss for timing in status.timings] for status in signing] == [
        ["NOD"],
        ["TURN", "LOOK"],
    ]
    assert len(graph.robot.received) == 2
    for status, trajectory in zip(signing, graph.robot.received, strict=True):
        last = trajectory.points[-1]
        end = last.time_from_start.sec + last.time_from_start.nanosec * 1e-9
        assert end == pytest.approx(status.duration)
        assert np.abs(last.velocities).max() == 0.0
        first = trajectory.points[0]
        assert first.time_from_start.sec == 0 and 0 < first.time_from_start.nanosec <= 20_000_000
        assert trajectory.header.stamp.sec == 0
    np.testing.assert_allclose(graph.robot.positions, [HOME[name] for name in COMMANDED_JOINTS], atol=0.02)


def test_a_late_listener_still_learns_what_was_said(graph: Graph) -> None:
    graph.publish(graph.sentence("NOD"))
    graph.rest(signed=1)
    late: list[ExecutorStatus] = []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    graph.robot.create_subscription(ExecutorStatus, "executor_status", late.append, latched)
    graph.spin_until(lambda: len(late) >= len(graph.robot.statuses))
    assert late == graph.robot.statuses


def test_a_goal_gets_feedback_and_a_result(graph: Graph) -> None:
    client = ActionClient(graph.robot, ExecuteSentence, "execute_sentence")
    graph.spin_until(client.server_is_ready)
    feedback: list[ExecuteSentence.Feedback] = []
    goal = ExecuteSentence.Goal(sentence=graph.sentence("NOD TURN"))
    sent = client.send_goal_async(goal, lambda message: feedback.append(message.feedback))
    handle = graph.wait(sent)
    assert handle.accepted
    result = graph.wait(handle.get_result_async()).result
    assert (result.code, result.message) == (ExecuteSentence.Result.SUCCESS, "")
    assert [timing.token.gloss for timing in result.timings] == ["NOD", "TURN"]
    assert result.sentence == goal.sentence
    assert {"NOD", "TURN"} >= {message.gloss for message in feedback} - {""}
    progress = [message.progress for message in feedback]
    assert len(progress) >= 5 and progress == sorted(progress) and progress[0] >= 0.0 and progress[-1] <= 1.0

    refused = graph.wait(client.send_goal_async(ExecuteSentence.Goal(sentence=graph.sentence("Ω"))))
    result = graph.wait(refused.get_result_async()).result
    assert result.code == ExecuteSentence.Result.REFUSED and result.message.startswith("unknown_sign: ")
    client.destroy()


def test_a_canceled_goal_brings_the_robot_back_to_rest(graph: Graph) -> None:
    client = ActionClient(graph.robot, ExecuteSentence, "execute_sentence")
    graph.spin_until(client.server_is_ready)
    handle = graph.wait(client.send_goal_async(ExecuteSentence.Goal(sentence=graph.sentence("A-N-A-N"))))
    elbow = COMMANDED_JOINTS.index("FrontalRightElbow")
    graph.spin_until(lambda: graph.robot.positions[elbow] < -0.5)
    waiting = graph.wait(client.send_goal_async(ExecuteSentence.Goal(sentence=graph.sentence("NOD"))))
    graph.wait(waiting.cancel_goal_async())
    assert graph.wait(waiting.get_result_async()).result.code == ExecuteSentence.Result.CANCELED
    before = len(graph.robot.path)
    graph.wait(handle.cancel_goal_async())
    result = graph.wait(handle.get_result_async()).result
    assert result.code == ExecuteSentence.Result.CANCELED
    assert len(graph.robot.received) == 2
    np.testing.assert_allclose(graph.robot.positions, [HOME[name] for name in COMMANDED_JOINTS], atol=0.02)
    times = np.array([when for when, _ in graph.robot.path[before:]])
    steps = np.abs(np.diff([positions for _, positions in graph.robot.path[before:]], axis=0)).max(axis=1)
    # No jump: full speed in the time since the step before, however late a timer was.
    assert (steps <= float(joint_limits().velocity[0]) * np.diff(times) + 0.03).all()
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
    client.destroy()


def test_type_and_negation_are_shown_with_the_head_unless_it_is_to_be_still(graph: Graph) -> None:
    def most(head_motion: float) -> list[float]:
        """The most that yaw and pitch are away from rest in a negated question [rad]."""
        graph.node.set_parameters([Parameter("head_motion", value=head_motion)])
        message = graph.sentence("A")
        message.type, message.negated = SignSentence.TYPE_YES_NO_QUESTION, True
        before = len(graph.robot.received)
        graph.publish(message)
        graph.spin_until(lambda: len(graph.robot.received) > before)
        points = np.array([point.positions for point in graph.robot.received[-1].points])
        return np.abs(points[:, : len(HEAD)]).max(axis=0).tolist()

    assert most(0.0) == [0.0, 0.0]
    graph.rest(signed=1)
    assert most(1.0) == pytest.approx(np.radians([12.0, 9.0]), abs=0.01)


def test_signs_are_listed_and_shown_as_soon_as_they_are_saved(
    graph: Graph, make_sign: Callable[..., Any]
) -> None:
    list_signs = graph.robot.create_client(ListSigns, "list_signs")
    get_sign = graph.robot.create_client(GetSign, "get_sign")
    graph.spin_until(lambda: list_signs.service_is_ready() and get_sign.service_is_ready())
    listed = graph.wait(list_signs.call_async(ListSigns.Request(prefix="L")))
    assert list(listed.glosses) == ["L", "LL", "LOOK"]
    assert list(listed.kinds) == [SignToken.KIND_LETTER, SignToken.KIND_LETTER, SignToken.KIND_LEXICAL]

    assert graph.wait(get_sign.call_async(GetSign.Request(gloss="NUEVO"))).code == "unknown_sign"
    save_sign(graph.directory, make_sign("NUEVO", [[0.1], [0.2]], [0.0, 0.5], joints=("AxialNeck",)))
    shown = graph.wait(get_sign.call_async(GetSign.Request(gloss="NUEVO")))
    assert shown.success and shown.code == "" and '"NUEVO"' in shown.entry
    assert [list(point.positions) for point in shown.trajectory.points] == [[0.1], [0.2]]
    assert shown.trajectory.points[1].time_from_start.nanosec == 500_000_000
    graph.publish(graph.sentence("NUEVO"))
    graph.rest(signed=1)

    (graph.directory / "ROTO.json").write_text("{")
    broken = graph.wait(get_sign.call_async(GetSign.Request(gloss="ROTO")))
    assert (broken.success, broken.code) == (False, "invalid_sign")
    assert "ROTO" not in graph.wait(list_signs.call_async(ListSigns.Request())).glosses


def test_parameters_are_checked_and_take_effect_with_the_next_sentence(graph: Graph) -> None:
    def change(name: str, value: float) -> bool:
        (result,) = graph.node.set_parameters([Parameter(name, value=value)])
        return bool(result.successful)

    assert not change("acceleration", -1.0)
    assert not change("jerk", 900.0), "too high for the period"
    assert not change("lut_directory", 1.0)
    assert change("posture_hold", 1.5) and change("acceleration", 2.0) and change("jerk", 10.0)
    graph.publish(graph.sentence("NOD"))
    graph.spin_until(lambda: bool(graph.robot.received))
    accelerations = np.array([point.accelerations for point in graph.robot.received[0].points])
    assert 0.5 < np.abs(accelerations).max() <= 2.0


def test_every_parameter_is_described(graph: Graph) -> None:
    for row in PARAMETERS:
        described = graph.node.describe_parameter(row.name)
        assert described.description.endswith((".", "]."))
        ranged = bool(described.floating_point_range) or bool(described.integer_range)
        assert ranged or isinstance(row.default, str)
    assert isinstance(graph.node.get_parameter("acceleration").to_parameter_msg(), ParameterMessage)


def test_a_node_without_a_table_or_with_impossible_parameters_says_why(
    domain_id: int, tmp_path: Path, table_directory: Path
) -> None:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    try:
        with pytest.raises(LutError) as no_table:
            ExecutorNode(
                context=context, parameter_overrides=[Parameter("lut_directory", value=str(tmp_path / "no"))]
            )
        assert no_table.value.code == "no_directory"
        with pytest.raises(PlanError) as no_plan:
            overrides = [
                Parameter("lut_directory", value=str(table_directory)),
                Parameter("jerk", value=1000.0),
                Parameter("acceleration", value=1.0),
            ]
            ExecutorNode(context=context, parameter_overrides=overrides)
        assert no_plan.value.code == "bad_limits"
    finally:
        rclpy.shutdown(context=context)
