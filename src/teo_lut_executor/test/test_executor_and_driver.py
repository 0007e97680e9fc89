# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The executor with the simulated driver: motions as goals of its action, and newer texts that replace."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from teo_sign_msgs.msg import DriverState, ExecutorStatus, SignSentence, SignToken
from trajectory_msgs.msg import JointTrajectory

from teo_lut_executor.node.executor_node import ExecutorNode
from teo_signs.sign_file import save_sign
from teo_signs.tokens import parse_printed
from teo_sim_driver.node.driver_node import DriverNode

SIGNING, REFUSED = ExecutorStatus.STATE_SIGNING, ExecutorStatus.STATE_REFUSED


class Lab(Node):
    """Publishes sentences, and hears what becomes of them."""

    def __init__(self, context: Context, executor_node: ExecutorNode, spin: Callable[[], None]) -> None:
        super().__init__("lab", context=context)
        self.executor_node = executor_node
        self._spin = spin
        self.statuses: list[ExecutorStatus] = []
        self.sources: set[int] = set()
        self.by_topic: list[JointTrajectory] = []
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(ExecutorStatus, "executor_status", self.statuses.append, latched)
        self.create_subscription(
            DriverState, "driver_state", lambda state: self.sources.add(state.source), latched
        )
        self.create_subscription(JointTrajectory, "joint_trajectory", self.by_topic.append, 10)
        self._tokens = self.create_publisher(SignSentence, "sign_tokens", 10)

    def sign(self, utterance: str, text: str) -> None:
        tokens = [
            SignToken(gloss=token.gloss, kind=int(token.kind), duration_scale=1.0)
            for token in parse_printed(text)
        ]
        self.until(lambda: self._tokens.get_subscription_count() > 0)
        self._tokens.publish(SignSentence(utterance_id=utterance, sentence_count=1, tokens=tokens))

    def until(self, condition: Callable[[], bool], timeout: float = 60.0) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s"
            self._spin()

    def of(self, state: int) -> list[str]:
        """Which texts were told to be in a state, in order."""
        return [status.utterance_id for status in self.statuses if status.state == state]

    def rest(self, signed: str) -> None:
        """Wait until a text has been signed and all is idle."""
        self.until(lambda: signed in self.of(SIGNING))
        self.until(lambda: self.statuses[-1].state == ExecutorStatus.STATE_IDLE)


@pytest.fixture
def lab(domain_id: int, table_directory: Path, make_sign: Callable[..., Any]) -> Iterator[Lab]:
    for number, gloss in enumerate(("NOD", "TURN")):
        knots = [[0.1 * number, 0.05], [0.1 * number - 0.05, 0.0]]
        save_sign(table_directory, make_sign(gloss, knots, [0.0, 0.2], joints=("AxialNeck", "FrontalNeck")))
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    overrides = [
        Parameter("lut_directory", value=str(table_directory)),
        Parameter("journal", value=""),
        Parameter("trajectory_interface", value="action"),
    ]
    node = ExecutorNode(context=context, parameter_overrides=overrides)
    driver = DriverNode(context=context)
    executor = SingleThreadedExecutor(context=context)
    lab = Lab(context, node, lambda: executor.spin_once(timeout_sec=0.1))
    for each in (node, driver, lab):
        executor.add_node(each)
    assert node.start()
    yield lab
    executor.shutdown()
    for each in (lab, node, driver):
        each.destroy_node()
    rclpy.shutdown(context=context)


def test_motions_as_goals_of_the_action_sign_sentences_in_a_row(lab: Lab) -> None:
    lab.sign("one", "NOD TURN")
    lab.sign("two", "TURN NOD")
    lab.rest("two")
    # Not once each: on a machine that is busy a motion may come too late, and its sentence is signed again.
    assert list(dict.fromkeys(lab.of(SIGNING))) == ["one", "two"]
    assert not lab.of(REFUSED)
    assert DriverState.SOURCE_ACTION in lab.sources and DriverState.SOURCE_TOPIC not in lab.sources
    assert not lab.by_topic


def test_a_newer_text_replaces_the_one_that_is_signed_and_those_that_wait(lab: Lab) -> None:
    setting = Parameter("preempt_policy", value="replace")
    assert lab.executor_node.set_parameters([setting])[0].successful
    lab.sign("old", "A-N-A-N-A-N-A-N")
    lab.until(lambda: lab.of(SIGNING) == ["old"])
    lab.sign("newer", "A-N")
    lab.sign("newest", "NOD")
    lab.rest("newest")
    replaced = [status.utterance_id for status in lab.statuses if status.code == "replaced"]
    assert replaced == ["old", "newer"], "each is named, once"
    assert lab.of(SIGNING)[0] == "old" and lab.of(SIGNING)[-1] == "newest"
    assert list(dict.fromkeys(lab.of(REFUSED))) == replaced
