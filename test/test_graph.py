# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The whole graph as its users run it: real processes over DDS, from a text to joint states."""

from __future__ import annotations

import os
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
import rclpy
from progress import Progress
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from teo_sign_msgs.msg import ExecutorStatus, SignSentence

from teo_bringup.graph import Graph
from teo_description import ALL_JOINTS, COMMANDED_JOINTS, HOME, joint_limits
from teo_motion.sentence.rest_posture import REST

START_TIMEOUT = 60.0  # [s] for all processes to be there, on a loaded machine
SIGNING_TIMEOUT = 120.0  # [s] for a short text
REST_TIMEOUT = 10.0  # [s] for the last states: a sentence has succeeded once the robot is nearly at rest


class Witness(Node):
    """Sees what any other participant of the graph can see."""

    def __init__(self, context: Context) -> None:
        super().__init__("witness", context=context)
        self.progress = Progress()
        self.states: list[JointState] = []
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(JointState, "joint_states", self.states.append, 100)
        self.create_subscription(SignSentence, "sign_tokens", self.progress.on_tokens, 100)
        self.create_subscription(ExecutorStatus, "executor_status", self.progress.on_status, latched)

    def positions(self) -> np.ndarray:
        """Every position seen, in the order of ALL_JOINTS. Shape (n, 40)."""
        return np.array([dict_of(state) for state in self.states])


def dict_of(state: JointState) -> list[float]:
    values = dict(zip(state.name, state.position, strict=True))
    return [values[name] for name in ALL_JOINTS]


@pytest.fixture
def witness(domain_id: int) -> Iterator[tuple[Witness, Callable[[Callable[[], bool], float], None]]]:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = Witness(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def spin_until(condition: Callable[[], bool], timeout: float) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s"
            executor.spin_once(timeout_sec=0.1)

    yield node, spin_until
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_a_typed_sentence_moves_the_robot_and_brings_it_back_to_rest(
    witness: tuple[Witness, Callable[[Callable[[], bool], float], None]], tmp_path: Path
) -> None:
    node, spin_until = witness
    home = np.array([HOME[name] for name in ALL_JOINTS])
    rest = home.copy()
    rest[[ALL_JOINTS.index(name) for name in COMMANDED_JOINTS]] = REST
    with Graph(log_folder=tmp_path) as graph:
        graph.start_nodes()

        def ready() -> bool:
            graph.check()
            return (
                bool(node.states)
                and all(node.count_subscribers(topic) for topic in ("text", "joint_trajectory"))
                and "executor" in {i.node_name for i in node.get_subscriptions_info_by_topic("sign_tokens")}
            )

        spin_until(ready, START_TIMEOUT)
        np.testing.assert_allclose(node.positions()[-1], home, atol=1e-9)

        publish = ["ros2", "topic", "pub", "--once", "text", "std_msgs/msg/String", "{data: 'Me llamo Al.'}"]
        subprocess.run(publish, env=os.environ, check=True, capture_output=True, timeout=30)

        def finished() -> bool:
            graph.check()
            return node.progress.finished

        spin_until(finished, SIGNING_TIMEOUT)
        spin_until(lambda: np.allclose(node.positions()[-1], rest, rtol=0, atol=1e-6), REST_TIMEOUT)

    progress = node.progress
    assert progress.signed, progress.refusals
    assert [timing.token.gloss for timing in progress.started[0].timings] == ["MI", "NOMBRE", "A", "L"]

    positions = node.positions()
    limits = joint_limits(ALL_JOINTS)
    assert (positions >= limits.lower - 1e-9).all() and (positions <= limits.upper + 1e-9).all()
    stamps = np.array([s.header.stamp.sec + s.header.stamp.nanosec * 1e-9 for s in node.states])
    steps = np.diff(stamps)
    speeds = np.abs(np.diff(positions, axis=0)) / steps[:, None]
    assert (speeds[steps > 0] <= limits.velocity * 1.02).all()  # stamps jitter by a fraction of a period

    elbow = ALL_JOINTS.index("FrontalRightElbow")
    assert positions[:, elbow].min() < -1.0, "spelling bends the right elbow"
    legs = [place for place, joint in enumerate(ALL_JOINTS) if joint not in COMMANDED_JOINTS]
    assert len(legs) == 12
    assert np.abs(positions[:, legs] - home[legs]).max() < 1e-9, "the legs stay"
