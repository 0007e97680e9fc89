# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The commands in a running graph over DDS, in a domain of their own."""

from __future__ import annotations

import io
import re
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.lifecycle import LifecycleNode
from rclpy.parameter import parameter_value_to_python
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from rclpy.service_introspection import ServiceIntrospectionState
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import SetBool

Command = Callable[..., subprocess.CompletedProcess[str]]


class Metronome:
    """Publishes fifty times a second, or as often as the machine lets it, and knows how often that was."""

    def __init__(self, graph: Any, kind: Any, topic: str, make: Callable[[], Any]) -> None:
        self._publisher = graph.node.create_publisher(kind, topic, 10)
        self._make = make
        self._times: list[float] = []
        graph.node.create_timer(0.02, self._beat)

    def _beat(self) -> None:
        self._publisher.publish(self._make())
        self._times.append(time.monotonic())

    def rate(self, window: int) -> float:
        """That of the latest messages, so many intervals back [1/s]."""
        latest = self._times[-window - 1 :]
        return (len(latest) - 1) / (latest[-1] - latest[0])


def test_rate_bandwidth_and_delay_are_those_of_what_comes(graph: Any, start: Any) -> None:
    def stamped() -> JointState:
        message = JointState(name=["x" * 1000])
        message.header.stamp = graph.node.get_clock().now().to_msg()
        return message

    metronome = Metronome(graph, JointState, "state", stamped)
    size = len(serialize_message(stamped()))
    hz = start("topic", "hz", "-w", "100", "/state")
    bandwidth = start("topic", "bw", "/state")
    delay = start("topic", "delay", "/state")

    def rate_is_right() -> bool:
        hz.lines.clear()
        rate = float(hz.wait_for_line("average rate: ").removeprefix("average rate: "))
        form = r"\tmin: 0\.\d{3}s max: \d\.\d{3}s std dev: \d\.\d{5}s window: (\d+)"
        found = re.fullmatch(form, hz.wait_for_line("min:"))
        assert found is not None
        return rate == pytest.approx(metronome.rate(int(found[1])), rel=0.2)

    def bandwidth_is_right() -> bool:
        bandwidth.lines.clear()
        value, unit, _, count, _ = bandwidth.wait_for_line("/s from").split()
        assert unit in ("B/s", "KB/s")
        told = float(value) * (1000 if unit == "KB/s" else 1)
        return told == pytest.approx(size * metronome.rate(int(count)), rel=0.4)

    # It is told a moment after it was measured, and the pace of a loaded machine changes.
    graph.wait_until(rate_is_right, "the rate is told at which messages are published")
    assert hz.stop() == 2
    graph.wait_until(bandwidth_is_right, "the bandwidth is told of what is published")
    assert 0 <= float(delay.wait_for_line("average delay: ").split()[-1]) < 1


def test_an_empty_graph_is_listed_as_such(domain_id: int, ros2_here: Command) -> None:
    del domain_id
    assert ros2_here("node", "list").stdout == ""
    assert ros2_here("topic", "list").stdout == "/parameter_events\n/rosout\n"


def test_parameters_are_loaded_from_a_file_and_deleted(
    graph: Any, ros2_here: Command, tmp_path: Path
) -> None:
    limits = ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.0)])
    graph.node.declare_parameter("speed", 1.0, limits)
    graph.node.declare_parameter("grip.names", ["a", "b"])
    graph.node.declare_parameter("loose", 1, ParameterDescriptor(dynamic_typing=True))
    file = tmp_path / "parameters.yaml"
    file.write_text(
        "/**: {ros__parameters: {speed: 0.5}}\n"
        "tester: {ros__parameters: {speed: 1.5, grip: {names: [c]}}}\n"
        "/other: {ros__parameters: {speed: 0.1}}\n"
    )
    done = ros2_here("param", "load", "/tester", str(file))
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "Set parameter speed successful\nSet parameter grip.names successful\n"
    assert graph.node.get_parameter("speed").value == 1.5
    assert list(graph.node.get_parameter("grip.names").value) == ["c"]
    file.write_text("/tester: {ros__parameters: {speed: 9.0}}\n")
    refused = ros2_here("param", "load", "/tester", str(file))
    assert (refused.returncode, refused.stderr.startswith("Set parameter speed failed: ")) == (1, True)
    file.write_text("/other: {ros__parameters: {speed: 0.1}}\n")
    assert "has no parameters for '/tester'" in ros2_here("param", "load", "/tester", str(file)).stderr
    assert ros2_here("param", "delete", "/tester", "loose").stdout == "Deleted parameter successfully\n"
    assert ros2_here("param", "get", "/tester", "loose").stderr == "Parameter not set.\n"
    kept = ros2_here("param", "delete", "/tester", "speed")
    assert (kept.returncode, kept.stderr.startswith("Deleting parameter failed: ")) == (1, True)


def test_managed_nodes_are_taken_from_state_to_state(graph: Any, ros2_here: Command) -> None:
    managed = LifecycleNode("managed", context=graph.context)
    graph.executor.add_node(managed)
    try:
        assert ros2_here("lifecycle", "nodes").stdout == "/managed\n"
        assert ros2_here("lifecycle", "get", "/managed").stdout == "unconfigured [1]\n"
        listed = ros2_here("lifecycle", "list", "managed").stdout
        assert listed.startswith("- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n")
        assert "activate" not in listed
        assert "\n- activate [3]\n" in ros2_here("lifecycle", "list", "managed", "-a").stdout
        refused = ros2_here("lifecycle", "set", "managed", "activate")
        assert (refused.returncode, refused.stdout) == (1, "")
        assert refused.stderr.startswith(
            "Unknown transition requested, available ones are:\n- configure [1]\n"
        )
        assert ros2_here("lifecycle", "set", "managed", "configure").stdout == "Transitioning successful\n"
        assert ros2_here("lifecycle", "set", "managed", "3").returncode == 0
        assert ros2_here("lifecycle", "get").stdout == "/managed: active [3]\n"
        assert ros2_here("lifecycle", "get", "/tester").stderr == "Node '/tester' has no lifecycle\n"
    finally:
        graph.executor.remove_node(managed)
        managed.destroy_node()


def test_services_are_listed_and_called(
    graph: Any, ros2_here: Command, start: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def answer(request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success = request.data
        response.message = "hecho"
        return response

    service = graph.node.create_service(SetBool, "switch", answer)
    assert ros2_here("service", "type", "/switch").stdout == "std_srvs/srv/SetBool\n"
    done = ros2_here("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}")
    assert done.returncode == 0
    assert done.stdout.endswith(
        "requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n"
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='hecho')\n\n"
    )
    assert ros2_here("service", "info", "/nothing").stderr == "Unknown service '/nothing'\n"
    monkeypatch.setattr("sys.stdin", io.StringIO("data: true\n"))
    piped = ros2_here("service", "call", "/switch", "std_srvs/srv/SetBool", "--stdin")
    assert "success=True" in piped.stdout
    refused = ros2_here("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: 7}")
    assert "field 'data' takes true or false" in refused.stderr

    echo = start("service", "echo", "/switch", "--flow-style")
    echo.wait_for_line("'/switch' tells of no calls: its node has to switch introspection on")
    service.configure_introspection(
        graph.node.get_clock(), QoSProfile(depth=10), ServiceIntrospectionState.CONTENTS
    )
    graph.wait_until(
        lambda: graph.node.count_subscribers("/switch/_service_event") == 1, "the echo has subscribed"
    )
    ros2_here("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}")
    assert "event_type: REQUEST_RECEIVED" in echo.wait_for_line("request: [{data: true}], response: []")
    assert "event_type: RESPONSE_SENT" in echo.wait_for_line("response: [{success: true, message: hecho}]")
    assert echo.stop() == 2


def test_the_doctor_names_what_keeps_a_graph_from_working(
    graph: Any, ros2_here: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    weak = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    graph.node.create_publisher(String, "text", weak)
    graph.node.create_subscription(String, "text", lambda _: None, 10)
    graph.node.create_publisher(JointState, "alone", 10)
    done = ros2_here("doctor")
    assert (done.returncode, done.stdout) == (0, "\n1/6 check(s) failed\n\nFailed modules: qos\n")
    assert "qos: ERROR: /text: tester -> tester: ERROR: Best effort publisher" in done.stderr
    assert "topic: WARNING: Publisher without subscriber detected on /alone." in done.stderr
    report = ros2_here("doctor", "--report").stdout
    titles = [line.strip() for line in report.splitlines() if line.startswith("   ")]
    assert titles[:3] == ["NETWORK CONFIGURATION", "PLATFORM INFORMATION", "RMW MIDDLEWARE"]
    assert titles[3:] == ["NODE LIST", "TOPIC LIST", "QOS COMPATIBILITY LIST"]
    assert "node : /tester\n" in report
    assert "topic            : /text\npublisher count  : 1\nsubscriber count : 1\n" in report
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_nothing_cpp")
    assert "Failed modules: rmw qos\n" in ros2_here("doctor").stdout
    # There are no containers: nothing is listed, and one that is named is not found.
    assert ros2_here("component", "list").stdout == ""
    assert ros2_here("component", "list", "/c").stderr == "Unable to find container node '/c'\n"


def test_goals_are_sent_and_their_results_printed(graph: Any, ros2_here: Command) -> None:
    messages = pytest.importorskip("teo_sign_msgs.action")
    from rclpy.action import ActionServer

    def execute(handle: Any) -> Any:
        handle.publish_feedback(messages.ExecuteSentence.Feedback(gloss="HOLA"))
        handle.succeed()
        return messages.ExecuteSentence.Result(code=messages.ExecuteSentence.Result.SUCCESS, message="hecho")

    server = ActionServer(graph.node, messages.ExecuteSentence, "sign", execute)
    kind = "teo_sign_msgs/action/ExecuteSentence"
    assert ros2_here("action", "list", "-t").stdout == f"/sign [{kind}]\n"
    info = ros2_here("action", "info", "/sign").stdout
    assert info == "Action: /sign\nAction clients: 0\nAction servers: 1\n    /tester\n"
    done = ros2_here("action", "send_goal", "-f", "/sign", kind, "{}")
    server.destroy()
    assert done.returncode == 0, done.stderr
    for part in (
        "Waiting for an action server to become available...\nSending goal:\n    ",
        "\nGoal accepted with ID: ",
        "Feedback:\n    token: 0\n    gloss: HOLA\n",
        "Result:\n    code: 0\n    message: hecho\n",
        "\nGoal finished with status: SUCCEEDED\n",
    ):
        assert part in done.stdout


TALKER = ("composition", "composition::Talker")


class Container:
    """Keeps what it was asked to load, by number."""

    def __init__(self, node: Any) -> None:
        self.loaded: dict[int, LoadNode.Request] = {}
        self._count = 0
        place = "/box/_container"
        node.create_service(ListNodes, f"{place}/list_nodes", self._list)
        node.create_service(LoadNode, f"{place}/load_node", self._load)
        node.create_service(UnloadNode, f"{place}/unload_node", self._unload)

    def _list(self, _request: ListNodes.Request, answer: ListNodes.Response) -> ListNodes.Response:
        answer.unique_ids = list(self.loaded)
        answer.full_node_names = [f"/{request.node_name or 'talker'}" for request in self.loaded.values()]
        return answer

    def _load(self, request: LoadNode.Request, answer: LoadNode.Response) -> LoadNode.Response:
        if (request.package_name, request.plugin_name) != TALKER:
            answer.error_message = "Failed to find class with the requested plugin name."
            return answer
        self._count += 1
        self.loaded[self._count] = request
        answer.success, answer.unique_id = True, self._count
        answer.full_node_name = f"/{request.node_name or 'talker'}"
        return answer

    def _unload(self, request: UnloadNode.Request, answer: UnloadNode.Response) -> UnloadNode.Response:
        answer.success = self.loaded.pop(request.unique_id, None) is not None
        answer.error_message = "" if answer.success else "No node found with unique_id: 9"
        return answer


def test_components_are_loaded_listed_and_unloaded(graph: Any, ros2_here: Command) -> None:
    container = Container(graph.node)
    done = ros2_here("component", "load", "box", *TALKER)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "Loaded component 1 into '/box' container node as '/talker'\n"
    options = ("-n", "anna", "--node-namespace", "/left", "--log-level", "warn", "-r", "chatter:=text")
    values = ("-p", "rate:=2.5", "-p", "names:=[a, b]", "-e", "use_intra_process_comms:=true")
    assert ros2_here("component", "load", "-q", "/box", *TALKER, *options, *values).stdout == "2 /anna\n"
    request = container.loaded[2]
    assert (request.node_namespace, request.log_level, list(request.remap_rules)) == (
        "/left",
        30,
        ["chatter:=text"],
    )
    given = {entry.name: parameter_value_to_python(entry.value) for entry in request.parameters}
    assert (given["rate"], list(given["names"])) == (2.5, ["a", "b"])
    (extra,) = request.extra_arguments
    assert (extra.name, extra.value.bool_value) == ("use_intra_process_comms", True)
    assert ros2_here("component", "list").stdout == "/box\n  1  /talker\n  2  /anna\n"
    assert ros2_here("component", "list", "--containers-only").stdout == "/box\n"
    assert ros2_here("component", "unload", "/box", "1").stdout == (
        "Unloaded component 1 from '/box' container node\n"
    )
    assert ros2_here("component", "list", "box").stdout == "/box\n  2  /anna\n"
    for words, told in (
        (("load", "/nobody", *TALKER), "Unable to find container node '/nobody'\n"),
        (
            ("load", "/box", "composition", "composition::Nothing"),
            "Failed to load component: Failed to find class with the requested plugin name.\n",
        ),
        (
            ("unload", "/box", "9"),
            "Failed to unload component 9 from '/box' container node\n    No node found with unique_id: 9\n",
        ),
    ):
        refused = ros2_here("component", *words)
        assert (refused.returncode, refused.stdout, refused.stderr) == (1, "", told)
