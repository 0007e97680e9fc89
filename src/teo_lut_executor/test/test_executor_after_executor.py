# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What an executor leaves to the next, and what two of them do."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from small_robot import Graph, running, save_table
from teo_sign_msgs.msg import ExecutorStatus, SignSentence

from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.interface import Sentence
from teo_lut_executor.execution.journal import Journal
from teo_lut_executor.node.executor_node import ExecutorNode
from teo_names import COMMANDED_JOINTS
from teo_signs.tokens import parse_printed

REST = load_humanoid().ready
# As the translator's publisher keeps what it said.
KEPT = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture
def graph(domain_id: int, tmp_path: Path) -> Iterator[Graph]:
    """A graph for a test that ends its executor."""
    save_table(tmp_path / "lut")
    parameters = {"lut_directory": str(tmp_path / "lut"), "journal": str(tmp_path / "journal")}
    with running(domain_id, *(Parameter(name, value=value) for name, value in parameters.items())) as graph:
        yield graph


@contextmanager
def next_executor(graph: Graph, journal: Path, **values: object) -> Iterator[ExecutorNode]:
    """The executor after the graph's own, which is gone; what was said before is forgotten."""
    given = {"lut_directory": str(graph.directory), "journal": str(journal)} | values
    overrides = [Parameter(name, value=value) for name, value in given.items()]
    node = ExecutorNode(context=graph.robot.context, parameter_overrides=overrides)
    graph.robot.statuses.clear()
    graph.executor.add_node(node)
    try:
        assert node.start()
        yield node
    finally:
        node.destroy_node()


def left_behind(path: Path, *sentences: tuple[str, float, int]) -> None:
    """The journal of a killed executor: texts, how long ago each was accepted [s], how often it was begun."""
    journal = Journal(path)
    for ticket, (text, ago, attempts) in enumerate(sentences):
        sentence = Sentence(tokens=parse_printed(text), utterance_id=text)
        journal.accepted(ticket, sentence, time.time() - ago, attempts=attempts)
    journal.begin()
    journal.close()


def signed(graph: Graph) -> list[str]:
    """The utterances of which signing began, in order, each once."""
    states = graph.robot.statuses
    begun = (each.utterance_id for each in states if each.state == ExecutorStatus.STATE_SIGNING)
    return list(dict.fromkeys(begun))


def test_a_second_executor_says_that_there_is_another_and_sends_nothing(graph: Graph) -> None:
    told: list[DiagnosticArray] = []
    node = ExecutorNode(context=graph.robot.context)
    graph.executor.add_node(node)
    graph.robot.create_subscription(DiagnosticArray, "diagnostics", told.append, 10)
    assert node.start(), "it stays, to tell"
    graph.spin_until(lambda: any("other_executor" in each.status[0].message for each in told))
    graph.publish(graph.sentence("NOD"))
    graph.rest(signed=1)
    assert node.count_publishers("joint_trajectory") == 1
    assert graph.robot.states().count(ExecutorStatus.STATE_SIGNING) == 1
    node.destroy_node()


@pytest.mark.slow
def test_what_a_killed_executor_left_is_signed_or_named(graph: Graph, domain_id: int, tmp_path: Path) -> None:
    path = tmp_path / f"domain{domain_id}.executor.jsonl"
    left_behind(path, ("NOD", 5.0, 0), ("TURN", 5.0, 2), ("A-N-A", 1e4, 0))
    graph.node.destroy_node()
    with next_executor(graph, tmp_path):
        graph.rest(signed=1)
        assert graph.refused() == [("interrupted", "TURN"), ("expired", "A-N-A")]
        assert set(signed(graph)) == {"NOD"}
    assert Journal(path).left == ()


@pytest.mark.slow
def test_a_robot_that_a_killed_executor_left_half_way_goes_to_rest_though_nothing_is_signed_any_more(
    graph: Graph, domain_id: int, tmp_path: Path
) -> None:
    left_behind(tmp_path / f"domain{domain_id}.executor.jsonl", ("NOD", 1e4, 0))
    graph.node.destroy_node()
    graph.robot.stand(FrontalRightElbow=REST[COMMANDED_JOINTS.index("FrontalRightElbow")] - 0.3)
    with next_executor(graph, tmp_path):
        graph.spin_until(lambda: graph.refused() == [("expired", "NOD")])
        graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
        np.testing.assert_allclose(graph.robot.positions, REST, atol=0.02)


@pytest.mark.slow
def test_what_is_said_while_no_executor_is_there_is_signed_once_by_the_next_or_named(
    graph: Graph, tmp_path: Path
) -> None:
    graph.robot.tokens = graph.robot.create_publisher(SignSentence, "sign_tokens", KEPT)
    graph.publish(graph.sentence("NOD"))
    graph.publish(graph.sentence("Ω"))
    graph.rest(signed=1)

    graph.node.destroy_node()
    graph.robot.tokens.publish(graph.sentence("TURN"))
    with next_executor(graph, tmp_path / "journal", journal_age=60.0):
        graph.rest(signed=1)
        told = {(status.utterance_id, status.code) for status in graph.robot.statuses if status.utterance_id}
        assert told == {("text 3", "")}
    graph.robot.tokens.publish(graph.sentence("LOOK"))
    with next_executor(graph, tmp_path / "journal", journal_age=0.0):
        graph.spin_until(lambda: bool(graph.refused()))
        graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
        assert graph.refused() == [("expired", "text 4")]
        assert not signed(graph)


@pytest.mark.slow
def test_without_room_for_a_journal_all_that_is_said_is_signed_once_and_the_disk_told(
    graph: Graph, domain_id: int, tmp_path: Path
) -> None:
    graph.robot.tokens = graph.robot.create_publisher(SignSentence, "sign_tokens", KEPT)
    told: list[DiagnosticStatus] = []
    graph.robot.create_subscription(DiagnosticArray, "diagnostics", lambda m: told.extend(m.status), 10)
    graph.node.destroy_node()
    folder = tmp_path / "full"
    folder.mkdir()
    (folder / f"domain{domain_id}.executor.new").symlink_to("/dev/full")
    graph.robot.tokens.publish(graph.sentence("NOD"))  # while no executor is there
    with next_executor(graph, folder):
        # What was kept comes by another subscription than what is said now, sooner or later than that.
        graph.spin_until(lambda: any(status.utterance_id for status in graph.robot.statuses))
        graph.publish(graph.sentence("TURN"))
        graph.publish(graph.sentence("Ω"))
        graph.rest(signed=2)
        assert graph.refused() == [("unknown_sign", "text 3")]
        assert signed(graph) == ["text 1", "text 2"]
        graph.spin_until(lambda: any("No space left" in s.message for s in told))
        assert told[-1].level == DiagnosticStatus.WARN
