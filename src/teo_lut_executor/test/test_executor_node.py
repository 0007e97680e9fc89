# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node as its peers see it, with a small robot of the test's own that follows what it is sent."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import made_languages
import numpy as np
import pytest
import rclpy
from action_msgs.msg import GoalStatus
from made_signs import make_sign
from msgspec.structs import replace as changed
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from small_robot import Graph, running, save_table
from std_srvs.srv import Trigger
from teo_sign_msgs.action import ExecuteSentence
from teo_sign_msgs.msg import ExecutorStatus, SignSentence, SignToken
from teo_sign_msgs.srv import GetSign, ListQueue, ListSigns

from teo_description.humanoid import load_humanoid
from teo_lut_executor.node.executor_node import ExecutorNode
from teo_names import COMMANDED_JOINTS
from teo_signs.sign import Sign
from teo_signs.sign_file import save_sign

REST = load_humanoid().ready


class SharedGraph:
    """One graph for many tests; it is handed on only at rest, with nothing queued, as it was configured."""

    def __init__(self, domain_id: int, folder: Path) -> None:
        self._domain_id, self._folder = domain_id, folder
        self._running = ExitStack()
        self._graph: Graph | None = None

    def graph(self) -> Graph:
        if self._graph is not None:
            try:
                self._graph.begin_anew()
            except AssertionError:  # the test before has failed: that is its own matter
                self.close()
        if self._graph is None:
            lut = self._folder / f"lut {len(list(self._folder.iterdir()))}"
            save_table(lut)
            parameters = {"lut_directory": str(lut), "capacity": 5, "journal": ""}
            overrides = (Parameter(name, value=value) for name, value in parameters.items())
            self._graph = self._running.enter_context(running(self._domain_id, *overrides))
            self._graph.begin_anew()
        return self._graph

    def close(self) -> None:
        self._running.close()
        self._graph = None


@pytest.fixture(scope="module")
def shared(module_domain_id: int, tmp_path_factory: pytest.TempPathFactory) -> Iterator[SharedGraph]:
    shared = SharedGraph(module_domain_id, tmp_path_factory.mktemp("graphs"))
    yield shared
    shared.close()


@pytest.fixture
def graph(shared: SharedGraph) -> Graph:
    return shared.graph()


def test_sentences_are_signed_in_order_and_bad_ones_refused_when_they_come(graph: Graph) -> None:
    empty = SignSentence(utterance_id="empty", sentence_count=1)
    nan = graph.sentence("NOD", scale=float("nan"))
    unknown = graph.sentence("Ω")
    odd = graph.sentence("NOD")
    odd.tokens[0].kind = 9
    typeless = graph.sentence("NOD")
    typeless.type = 9
    endless = graph.sentence(" ".join("_" for _ in range(900)))
    for message in (graph.sentence("A-N"), empty, nan, unknown, odd, typeless, endless):
        graph.publish(message)
    graph.publish(graph.sentence("TURN LOOK"))
    graph.spin_until(lambda: len(graph.refused()) == 6)
    assert ExecutorStatus.STATE_IDLE not in graph.robot.states()[1:], "told while the first is signed"
    graph.rest(signed=2)
    codes = [code for code, _ in graph.refused()]
    assert codes == ["empty_sentence", "bad_scale", "unknown_sign", "bad_kind", "bad_type", "too_long"]
    signing = {s.utterance_id: s for s in graph.robot.statuses if s.state == ExecutorStatus.STATE_SIGNING}
    assert [[timing.token.gloss for timing in status.timings] for status in signing.values()] == [
        ["A", "N"],
        ["TURN", "LOOK"],
    ]
    first, *_, last = graph.robot.received
    assert first.header.stamp.sec == 0, "from a standstill as soon as it is there"
    assert last.header.stamp.sec > 0, "where it continues the sentence before"
    for trajectory in graph.robot.received:
        assert np.abs(trajectory.points[-1].velocities).max() < 1e-9, "each ends at a standstill"
    np.testing.assert_allclose(graph.robot.positions, REST, atol=0.02)


def test_the_queue_is_told_at_every_change_listed_and_cleared(graph: Graph) -> None:
    listing = graph.robot.create_client(ListQueue, "list_queue")
    clearing = graph.robot.create_client(Trigger, "clear_queue")
    graph.spin_until(lambda: listing.service_is_ready() and clearing.service_is_ready())
    graph.publish(graph.sentence("A"))
    graph.spin_until(lambda: ExecutorStatus.STATE_SIGNING in graph.robot.states())
    for text in ("NOD", "TURN"):
        message = graph.sentence(text)
        message.text = text.lower()
        graph.publish(message)
    graph.spin_until(lambda: graph.robot.statuses[-1].queued == 2)
    late: list[ExecutorStatus] = []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    graph.robot.create_subscription(ExecutorStatus, "executor_status", late.append, latched)
    graph.spin_until(lambda: bool(late))
    assert [status.queued for status in late] == [2], "who comes late learns the present state alone"
    listed = graph.wait(listing.call_async(ListQueue.Request()))
    assert (list(listed.texts), listed.current) == (["", "nod", "turn"], 0)
    assert list(listed.utterance_ids) == ["text 1", "text 2", "text 3"]
    assert graph.wait(clearing.call_async(Trigger.Request())).success
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
    assert graph.refused() == [("cleared", "text 2"), ("cleared", "text 3")]


def test_an_executor_that_is_not_active_moves_nothing_and_keeps_the_queue(graph: Graph) -> None:
    graph.publish(graph.sentence("A"))
    elbow = COMMANDED_JOINTS.index("FrontalRightElbow")
    graph.spin_until(lambda: graph.robot.positions[elbow] < -0.5)
    graph.publish(graph.sentence("NOD"))
    graph.spin_until(lambda: graph.robot.statuses[-1].queued == 1)
    graph.node.trigger_deactivate()
    graph.spin_until(lambda: graph.refused() == [("inactive", "text 1")])
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_WAITING)
    graph.node.trigger_activate()
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
    assert graph.robot.statuses[-2].utterance_id == "text 2"


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

    unknown = graph.sentence("Ω")
    assert not graph.wait(client.send_goal_async(ExecuteSentence.Goal(sentence=unknown))).accepted
    graph.spin_until(lambda: bool(graph.refused()))
    assert graph.refused() == [("unknown_sign", unknown.utterance_id)]
    client.destroy()


def test_the_result_of_a_goal_that_the_executor_does_not_know_is_no_success(graph: Graph) -> None:
    result = ExecuteSentence.Impl.GetResultService  # asked as of a goal that an executor before took
    client = graph.robot.create_client(result, "execute_sentence/_action/get_result")
    graph.spin_until(client.service_is_ready)
    answer = graph.wait(client.call_async(result.Request()))
    assert answer.status == GoalStatus.STATUS_UNKNOWN
    assert answer.result.code == ExecuteSentence.Result.UNKNOWN != ExecuteSentence.Result.SUCCESS
    assert "has ended" in answer.result.message
    graph.robot.destroy_client(client)


def test_a_canceled_goal_brings_the_robot_back_to_rest(graph: Graph) -> None:
    client = ActionClient(graph.robot, ExecuteSentence, "execute_sentence")
    graph.spin_until(client.server_is_ready)
    handle = graph.wait(client.send_goal_async(ExecuteSentence.Goal(sentence=graph.sentence("A-N"))))
    elbow = COMMANDED_JOINTS.index("FrontalRightElbow")
    graph.spin_until(lambda: graph.robot.positions[elbow] < -0.5)
    waiting = graph.wait(client.send_goal_async(ExecuteSentence.Goal(sentence=graph.sentence("NOD"))))
    graph.wait(waiting.cancel_goal_async())
    assert graph.wait(waiting.get_result_async()).result.code == ExecuteSentence.Result.CANCELED
    graph.wait(handle.cancel_goal_async())
    result = graph.wait(handle.get_result_async()).result
    assert result.code == ExecuteSentence.Result.CANCELED
    np.testing.assert_allclose(graph.robot.positions, REST, atol=0.02)
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
    client.destroy()


def test_signs_are_listed_and_shown_as_soon_as_they_are_saved(
    graph: Graph,
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

    sketch = make_sign("IDEA", [[0.1], [0.2]], [0.0, 0.5], joints=("AxialNeck",))
    sketch = replace(sketch, provenance=changed(sketch.provenance, standing="sketched"))
    save_sign(graph.directory, sketch)
    assert "IDEA" not in graph.wait(list_signs.call_async(ListSigns.Request())).glosses
    assert graph.wait(get_sign.call_async(GetSign.Request(gloss="IDEA"))).success

    (graph.directory / "ROTO.json").write_text("{")
    broken = graph.wait(get_sign.call_async(GetSign.Request(gloss="ROTO")))
    assert (broken.success, broken.code) == (False, "invalid_sign")
    assert "ROTO" not in graph.wait(list_signs.call_async(ListSigns.Request())).glosses
    for gloss in ("NUEVO", "IDEA", "ROTO"):
        (graph.directory / f"{gloss}.json").unlink()


def test_parameters_are_checked_and_take_effect_with_the_next_sentence(graph: Graph) -> None:
    def change(name: str, value: float | str) -> bool:
        (result,) = graph.node.set_parameters([Parameter(name, value=value)])
        return bool(result.successful)

    assert not change("acceleration", -1.0)
    assert not change("least_standing", "guessed")
    assert not change("lut_directory", 1.0)
    assert not change("hand_drive", "hydraulic")
    assert not change("preempt_policy", "never")
    assert change("posture_hold", 1.5) and change("acceleration", 2.0) and change("jerk", 10.0)
    graph.publish(graph.sentence("NOD"))
    graph.rest(signed=1)
    accelerations = np.concatenate([[p.accelerations for p in sent.points] for sent in graph.robot.received])
    assert 0.5 < np.abs(accelerations).max() <= 2.0


def test_a_newer_text_replaces_the_one_that_is_signed_and_those_that_wait(graph: Graph) -> None:
    (changed,) = graph.node.set_parameters([Parameter("preempt_policy", value="replace")])
    assert changed.successful
    graph.publish(graph.sentence("A-N"))
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_SIGNING)
    for text in ("A", "NOD"):
        graph.publish(graph.sentence(text))
    graph.spin_until(lambda: graph.robot.states()[-1] == ExecutorStatus.STATE_IDLE)
    assert sorted(graph.refused()) == [("replaced", "text 1"), ("replaced", "text 2")], "each once"
    signed = [s.utterance_id for s in graph.robot.statuses if s.state == ExecutorStatus.STATE_SIGNING]
    assert signed[-1] == "text 3"


def test_a_node_without_its_table_is_not_configured(domain_id: int) -> None:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    overrides = [Parameter("lut_directory", value="/nowhere"), Parameter("journal", value="")]
    node = ExecutorNode(context=context, parameter_overrides=overrides)
    assert not node.start()
    node.destroy_node()
    rclpy.shutdown(context=context)


@pytest.mark.slow
def test_each_sentence_is_signed_in_its_own_language_or_refused_while_languages_change(
    domain_id: int, data_home: Path
) -> None:
    def nod(language: str, turn: float) -> Sign:
        sign = make_sign("NOD", [[0.0, 0.0], [turn, 0.0]], [0.0, 0.4], joints=("AxialNeck", "FrontalNeck"))
        return replace(sign, language=language)

    other = made_languages.CODE
    save_sign(data_home / "teo" / "lut", nod("ssp", 0.2))
    made_languages.make_language(data_home, {"NOD": nod(other, -0.3)})
    with running(domain_id, Parameter("journal", value="")) as graph:
        first, early, waiting, late, last = (graph.sentence("NOD") for _ in range(5))
        first.language = late.language = "ssp"
        early.language = last.language = other
        assert waiting.language == "", "that of the executor"
        for message in (first, early, waiting):
            graph.publish(message)
        taken = ExecutorStatus.STATE_WAITING  # a refusal tells of sentences that wait as well
        graph.spin_until(lambda: any(s.queued and s.state == taken for s in graph.robot.statuses))
        assert graph.refused() == [("other_language", early.utterance_id)]
        (result,) = graph.node.set_parameters([Parameter("language", value=other)])
        assert result.successful, result.reason
        graph.publish(late)
        graph.publish(last)
        graph.rest(signed=3)
        refused = [("other_language", message.utterance_id) for message in (early, late)]
        assert graph.refused() == refused
        turns = np.array(
            [positions[COMMANDED_JOINTS.index("AxialNeck")] for _, positions in graph.robot.path]
        )
        left, right = np.flatnonzero(turns > 0.15), np.flatnonzero(turns < -0.25)
        assert np.count_nonzero(np.diff(left) > 1) == 1, "two sentences turn to the left"
        assert left[-1] < right[0], "and then one to the right"
        (result,) = graph.node.set_parameters([Parameter("language", value="qqq")])
        assert result.reason.startswith("[unknown_language]")
