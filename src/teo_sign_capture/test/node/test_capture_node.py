# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The service as the console sees it, with a camera of the test's own."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import rclpy
from made_bags import messages, signing
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from teo_sign_msgs.msg import SkeletonArray
from teo_sign_msgs.srv import CaptureSign

from teo_sign_capture.node.capture_node import CaptureNode
from teo_signs.look_up_table import Lut
from teo_signs.sign_file import read_sign

RATE = 15.0  # [Hz]


@dataclass
class Graph:
    node: CaptureNode
    peer: Node
    executor: SingleThreadedExecutor
    directory: Path
    states: list[str]

    def call(self, gloss: str, countdown: float = 0.0, replace: bool = False) -> Any:
        client = self.peer.create_client(CaptureSign, "capture_sign")
        self.spin_until(client.service_is_ready)
        return client.call_async(CaptureSign.Request(gloss=gloss, countdown=countdown, replace=replace))

    def spin_until(self, condition: Any, timeout: float = 30.0) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s: {self.states}"
            self.executor.spin_once(timeout_sec=0.05)

    def answer(self, future: Any) -> CaptureSign.Response:
        self.spin_until(future.done)
        return future.result()


@pytest.fixture
def graph(domain_id: int, tmp_path: Path) -> Iterator[Graph]:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    directories = {"lut_directory": "lut", "recordings_directory": "recordings"}
    overrides = [Parameter(name, value=str(tmp_path / folder)) for name, folder in directories.items()]
    node = CaptureNode(
        context=context, parameter_overrides=[*overrides, Parameter("longest_wait", value=20.0)]
    )
    peer = Node("console", context=context)
    states: list[str] = []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    peer.create_subscription(String, "capture_state", lambda message: states.append(message.data), latched)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(peer)
    (tmp_path / "lut").mkdir()
    yield Graph(node, peer, executor, tmp_path, states)
    executor.shutdown()
    node.destroy_node()
    peer.destroy_node()
    rclpy.try_shutdown(context=context)


@pytest.fixture
def camera(graph: Graph) -> None:
    """Publishes a person who signs once, at a camera's pace, from the end of the countdown on."""
    node = graph.peer
    publisher = node.create_publisher(SkeletonArray, "skeletons", 10)
    arrays = messages(signing(rate=RATE, duration=4.0))
    began: list[float] = []

    def publish() -> None:
        if "sign now" in graph.states:
            began[:] = began or [time.monotonic()]
            while arrays and time.monotonic() - began[0] >= (60 - len(arrays)) / RATE:
                publisher.publish(arrays.pop(0))

    node.create_timer(1.0 / RATE, publish)


@pytest.mark.usefixtures("camera")
def test_a_sign_is_recorded_saved_and_found_by_a_table_in_use(graph: Graph) -> None:
    graph.node.set_parameters([Parameter("language", value="ase")])
    table = Lut.open(graph.directory / "lut", language="ase")
    response = graph.answer(graph.call("SIGNO"))
    assert response.success, response.message
    assert response.code == ""
    sign = read_sign(Path(response.path))
    assert (sign.language, sign.robot, sign.provenance.standing) == ("ase", "teo", "recorded")
    assert 0.4 < sign.duration < 0.9
    assert Path(response.picture).is_file()
    assert "palm_error_p95_deg" in response.quality
    assert len(list((graph.directory / "recordings").glob("SIGNO-*.mcap"))) == 1
    # As the executor looks before each sentence.
    assert table.refresh() == ""
    assert "SIGNO" in table
    graph.spin_until(lambda: graph.states[-1:] == ["idle"])
    assert "sign now" in graph.states
    assert "capturing" in graph.states


def test_nobody_before_the_camera_is_said_and_the_next_request_served(graph: Graph) -> None:
    graph.node.set_parameters([Parameter("longest_wait", value=1.0)])
    response = graph.answer(graph.call("SIGNO", countdown=0.1))
    assert not response.success
    assert response.code == "no_skeletons"
    assert response.path == ""
    assert not list((graph.directory / "lut").iterdir())
    assert graph.answer(graph.call("signo")).code == "bad_gloss"
    assert graph.answer(graph.call("SIGNO", countdown=99.0)).code == "bad_countdown"


def test_one_sign_at_a_time(graph: Graph) -> None:
    graph.node.set_parameters([Parameter("longest_wait", value=2.0)])
    first = graph.call("SIGNO", countdown=0.2)
    graph.spin_until(lambda: any(state.startswith(("countdown", "sign")) for state in graph.states))
    assert graph.answer(graph.call("OTRO")).code == "busy"
    assert graph.answer(first).code == "no_skeletons"


def test_bad_parameters_are_refused_with_the_reason(graph: Graph) -> None:
    (result,) = graph.node.set_parameters([Parameter("standing", value="certain")])
    assert not result.successful
    assert "recorded" in result.reason
    (result,) = graph.node.set_parameters([Parameter("language", value="nobody's")])
    assert "unknown_language" in result.reason
    (result,) = graph.node.set_parameters([Parameter("longest_wait", value=0.0)])
    assert not result.successful
