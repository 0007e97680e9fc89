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
from absence import node_without
from progress import Progress
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from teo_sign_msgs.msg import ExecutorStatus, SignSentence

from teo_bringup.graph import SIGNING, Graph
from teo_description.humanoid import Humanoid, load_humanoid

START_TIMEOUT = 60.0  # [s] for all processes to be there, on a loaded machine
SIGNING_TIMEOUT = 120.0  # [s] for a short text
REST_TIMEOUT = 10.0  # [s] for the last states: a sentence has succeeded once the robot is nearly at rest


class Witness(Node):
    """Sees what any other participant of the graph can see."""

    def __init__(self, context: Context) -> None:
        super().__init__("witness", context=context)
        self.progress = Progress()
        self.states: list[JointState] = []
        self.executor_of_all = SingleThreadedExecutor(context=context)
        self.executor_of_all.add_node(self)
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(JointState, "joint_states", self.states.append, 100)
        # By way of `progress`, which each text begins anew.
        self.create_subscription(SignSentence, "sign_tokens", lambda m: self.progress.on_tokens(m), 100)
        status = ExecutorStatus, "executor_status", lambda m: self.progress.on_status(m)
        self.create_subscription(*status, latched)

    def positions(self, humanoid: Humanoid) -> np.ndarray:
        """Every position seen, in the order of all joints. Shape (n, joints)."""
        values = (dict(zip(state.name, state.position, strict=True)) for state in self.states)
        return np.array([[row[name] for name in humanoid.all_joints] for row in values])

    def spin_until(self, condition: Callable[[], bool], timeout: float) -> None:
        """Hear what comes until something is so."""
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s"
            self.executor_of_all.spin_once(timeout_sec=0.1)

    def wait_for_all(self, graph: Graph) -> None:
        """Until every node can serve and listens."""

        def ready() -> bool:
            graph.check()
            listening = (self.count_subscribers(topic) for topic in ("text", "joint_trajectory"))
            hearers = {each.node_name for each in self.get_subscriptions_info_by_topic("sign_tokens")}
            return graph.is_ready() and bool(self.states) and all(listening) and "executor" in hearers

        self.spin_until(ready, START_TIMEOUT)

    def see_signed(self, graph: Graph, text: str, humanoid: Humanoid) -> list[str]:
        """Have a text signed until the robot is at rest again; the glosses of its first sentence."""
        self.progress = progress = Progress()
        ros2("topic", "pub", "--once", "text", "std_msgs/msg/String", f"{{data: '{text}'}}")

        def finished() -> bool:
            graph.check()
            return progress.finished

        self.spin_until(finished, SIGNING_TIMEOUT)
        rest = np.concatenate([humanoid.ready, [humanoid.home[name] for name in humanoid.standing]])
        self.spin_until(
            lambda: np.allclose(self.positions(humanoid)[-1], rest, rtol=0, atol=1e-6), REST_TIMEOUT
        )
        assert progress.signed, progress.refusals
        return [timing.token.gloss for timing in progress.started[0].timings]


@pytest.fixture
def witness(domain_id: int) -> Iterator[Witness]:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = Witness(context)
    yield node
    node.executor_of_all.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)


def ros2(*words: str) -> str:
    """What a command of `ros2` says, which must succeed."""
    done = subprocess.run(["ros2", *words], env=os.environ, capture_output=True, timeout=90, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def speak(language: str) -> None:
    """Have translator and executor change to a language."""
    for name in ("executor", "translator"):
        assert "successful" in ros2("param", "set", f"/{name}", "language", language)


def check_motion(witness: Witness, humanoid: Humanoid) -> None:
    """Every state is within the limits, from each to the next too; what is never commanded stays."""
    positions, limits = witness.positions(humanoid), humanoid.limits(humanoid.all_joints)
    assert (positions >= limits.lower - 1e-9).all() and (positions <= limits.upper + 1e-9).all()
    stamps = np.array([s.header.stamp.sec + s.header.stamp.nanosec * 1e-9 for s in witness.states])
    steps = np.diff(stamps)
    speeds = np.abs(np.diff(positions, axis=0)) / steps[:, None]
    assert (speeds[steps > 0] <= limits.velocity * 1.02).all()  # stamps jitter by a fraction of a period
    home = np.array([humanoid.home[name] for name in humanoid.all_joints])
    standing = slice(len(humanoid.commanded_joints), None)
    assert np.abs(positions[:, standing] - home[standing]).max() < 1e-9
    np.testing.assert_allclose(positions[0], home, atol=1e-9)
    elbow = humanoid.all_joints.index(humanoid.elbows[0])
    assert np.ptp(positions[:, elbow]) > 0.7, "signing bends the right elbow"


def test_a_typed_sentence_moves_the_robot_and_brings_it_back_to_rest_in_either_language(
    witness: Witness, tmp_path: Path
) -> None:
    teo = load_humanoid("teo")
    """Without what a robot has not: OpenCV, MediaPipe, PyTorch, the studio, a ros2 of our own, ..."""
    with Graph(tmp_path) as graph:
        for name in SIGNING:
            graph.start(name, *node_without(name))
        witness.wait_for_all(graph)
        for language, text, signs in (
            ("ssp", "Me llamo Al.", ["MI", "NOMBRE", "A", "L"]),
            ("ase", "My name is Al.", ["MY", "NAME", "A", "L"]),
        ):
            speak(language)
            assert witness.see_signed(graph, text, teo) == signs
            assert witness.progress.sentences[0].language == language
    assert len(teo.standing) == 12, "the legs"
    check_motion(witness, teo)


@pytest.mark.slow
def test_another_robot_signs_by_its_own_table_in_either_language(witness: Witness, tmp_path: Path) -> None:
    gr1t2 = load_humanoid("gr1t2")
    with Graph(tmp_path) as graph:
        graph.start_nodes(arguments=["--ros-args", "-p", "robot:=gr1t2"])
        witness.wait_for_all(graph)
        assert witness.see_signed(graph, "Hola.", gr1t2) == ["HOLA"]
        speak("ase")
        assert witness.see_signed(graph, "Hello.", gr1t2) == ["HELLO"]
    check_motion(witness, gr1t2)
