# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The commands in a running graph: processes over DDS, in a domain of their own."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.lifecycle import LifecycleNode
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import SetBool

Command = Callable[..., subprocess.CompletedProcess[str]]


def latched(depth: int = 1) -> QoSProfile:
    return QoSProfile(depth=depth, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_the_graph_is_listed(graph: Any, ros2: Command) -> None:
    graph.node.create_publisher(String, "text", 10)
    graph.node.create_publisher(String, "_secret", 10)
    graph.node.create_subscription(JointState, "state", lambda _: None, latched())
    # A command looks for a moment; on a loaded machine what it looks for may come a moment later.
    listed = "/parameter_events\n/rosout\n/state\n/text\n"
    graph.wait_until(lambda: ros2("topic", "list").stdout == listed, "all topics are listed")
    typed = {"/_secret [std_msgs/msg/String]", "/state [sensor_msgs/msg/JointState]"}
    graph.wait_until(
        lambda: typed <= set(ros2("topic", "list", "-t", "-a").stdout.splitlines()), "hidden ones are listed"
    )

    def both_sides() -> bool:
        published, subscribed = ros2("topic", "list", "-v").stdout.split("\nSubscribed topics:\n")
        return (
            "\nPublished topics:\n" in published
            and " * /text [std_msgs/msg/String] 1 publisher\n" in published
            and " * /state [sensor_msgs/msg/JointState] 1 subscriber\n" in subscribed
        )

    graph.wait_until(both_sides, "publishers and subscribers are counted")
    assert ros2("topic", "type", "text").stdout == "std_msgs/msg/String\n"


def test_info_tells_who_is_there_and_how(graph: Any, ros2: Command) -> None:
    graph.node.create_publisher(String, "text", latched())
    graph.node.create_subscription(
        String, "text", lambda _: None, QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    )
    counted = "Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 1\n"
    graph.wait_until(lambda: ros2("topic", "info", "/text").stdout == counted, "both ends are counted")
    verbose = ros2("topic", "info", "-v", "/text").stdout
    for part in (
        "Type: std_msgs/msg/String\n\nPublisher count: 1\n\nNode name: tester\nNode namespace: /\n",
        "Topic type hash: RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18\n",
        "Endpoint type: PUBLISHER\n",
        "  Durability: TRANSIENT_LOCAL\n",
        "\n\nSubscription count: 1\n\n",
        "  Reliability: BEST_EFFORT\n",
        "  Lifespan: Infinite\n",
    ):
        assert part in verbose
    # The command's own publisher is not counted.
    assert ros2("topic", "info", "/rosout").stdout.splitlines()[1] == "Publisher count: 1"
    unknown = ros2("topic", "info", "/nothing")
    assert (unknown.returncode, unknown.stderr) == (1, "Unknown topic '/nothing'\n")


def test_hz_is_about_right(graph: Any, start: Any) -> None:
    publisher = graph.node.create_publisher(String, "text", 10)
    graph.node.create_timer(0.02, lambda: publisher.publish(String(data="x")))
    hz = start("topic", "hz", "-w", "100", "/text")
    hz.wait_for_line("average rate: ")
    hz.lines.clear()
    rate = float(hz.wait_for_line("average rate: ").removeprefix("average rate: "))
    assert 40 < rate < 60
    form = r"\tmin: 0\.\d{3}s max: \d\.\d{3}s std dev: 0\.\d{5}s window: \d+"
    assert re.fullmatch(form, hz.wait_for_line("min:"))
    assert hz.stop() == 2


def test_bandwidth_and_delay_are_about_right(graph: Any, start: Any) -> None:
    publisher = graph.node.create_publisher(JointState, "state", 10)

    def publish() -> None:
        message = JointState(name=["x" * 1000])
        message.header.stamp = graph.node.get_clock().now().to_msg()
        publisher.publish(message)

    graph.node.create_timer(0.02, publish)
    bandwidth = start("topic", "bw", "/state")
    delay = start("topic", "delay", "/state")
    value, unit = bandwidth.wait_for_line("/s from").split()[:2]
    assert (unit, 30 < float(value) < 70) == ("KB/s", True)
    assert 0 <= float(delay.wait_for_line("average delay: ").split()[-1]) < 1


def test_nodes_are_listed_without_the_commands_own(graph: Any, ros2: Command) -> None:
    del graph
    assert ros2("node", "list").stdout == "/tester\n"
    info = ros2("node", "info", "/tester").stdout
    assert info.startswith("/tester\n  Subscribers:\n")
    assert "  Publishers:\n    /parameter_events: rcl_interfaces/msg/ParameterEvent\n" in info
    assert "    /tester/get_parameters: rcl_interfaces/srv/GetParameters\n" in info
    assert ros2("node", "info", "/nobody").stderr == "Unable to find node '/nobody'\n"


def test_an_empty_graph_is_listed_as_such(domain_id: int, ros2: Command) -> None:
    del domain_id
    assert ros2("node", "list").stdout == ""
    assert ros2("topic", "list").stdout == "/parameter_events\n/rosout\n"


def test_parameters_are_listed_read_and_set(graph: Any, ros2: Command) -> None:
    limits = ParameterDescriptor(
        description="speed [m/s]", floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.0)]
    )
    graph.node.declare_parameter("speed", 1.0, limits)
    graph.node.declare_parameter("names", ["a", "b"])
    listing = ros2("param", "list").stdout
    assert listing.startswith("/tester:\n  names\n  speed\n")
    assert ros2("param", "get", "tester", "speed").stdout == "Double value is: 1.0\n"
    assert ros2("param", "set", "/tester", "speed", "1.5").stdout == "Set parameter successful\n"
    assert graph.node.get_parameter("speed").value == 1.5
    refused = ros2("param", "set", "/tester", "speed", "5.0")
    assert refused.returncode == 1
    assert refused.stderr.startswith("Setting parameter failed: ")
    described = ros2("param", "describe", "/tester", "speed").stdout
    assert "  Type: double\n  Description: speed [m/s]\n  Constraints:\n    Min value: 0.0\n" in described
    assert "    speed: 1.5\n" in ros2("param", "dump", "/tester").stdout
    assert ros2("param", "list", "tester", "--filter", "^s.e+d$").stdout == "  speed\n"
    assert ros2("param", "list", "tester", "--param-prefixes", "none").stdout == ""
    assert ros2("param", "get", "/tester", "nothing").stderr == "Parameter not set.\n"
    assert ros2("param", "get", "/nobody", "x").stderr == "Node not found\n"


def test_parameters_are_loaded_from_a_file_and_deleted(graph: Any, ros2: Command, tmp_path: Path) -> None:
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
    done = ros2("param", "load", "/tester", str(file))
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "Set parameter speed successful\nSet parameter grip.names successful\n"
    assert graph.node.get_parameter("speed").value == 1.5
    assert list(graph.node.get_parameter("grip.names").value) == ["c"]
    file.write_text("/tester: {ros__parameters: {speed: 9.0}}\n")
    refused = ros2("param", "load", "/tester", str(file))
    assert (refused.returncode, refused.stderr.startswith("Set parameter speed failed: ")) == (1, True)
    file.write_text("/other: {ros__parameters: {speed: 0.1}}\n")
    assert "has no parameters for '/tester'" in ros2("param", "load", "/tester", str(file)).stderr
    assert ros2("param", "delete", "/tester", "loose").stdout == "Deleted parameter successfully\n"
    assert ros2("param", "get", "/tester", "loose").stderr == "Parameter not set.\n"
    kept = ros2("param", "delete", "/tester", "speed")
    assert (kept.returncode, kept.stderr.startswith("Deleting parameter failed: ")) == (1, True)


def test_managed_nodes_are_taken_from_state_to_state(graph: Any, ros2: Command) -> None:
    managed = LifecycleNode("managed", context=graph.context)
    graph.executor.add_node(managed)
    try:
        assert ros2("lifecycle", "nodes").stdout == "/managed\n"
        assert ros2("lifecycle", "get", "/managed").stdout == "unconfigured [1]\n"
        listed = ros2("lifecycle", "list", "managed").stdout
        assert listed.startswith("- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n")
        assert "activate" not in listed
        assert "\n- activate [3]\n" in ros2("lifecycle", "list", "managed", "-a").stdout
        refused = ros2("lifecycle", "set", "managed", "activate")
        assert (refused.returncode, refused.stdout) == (1, "")
        assert refused.stderr.startswith(
            "Unknown transition requested, available ones are:\n- configure [1]\n"
        )
        assert ros2("lifecycle", "set", "managed", "configure").stdout == "Transitioning successful\n"
        assert ros2("lifecycle", "set", "managed", "3").returncode == 0
        assert ros2("lifecycle", "get").stdout == "/managed: active [3]\n"
        assert ros2("lifecycle", "get", "/tester").stderr == "Node '/tester' has no lifecycle\n"
    finally:
        graph.executor.remove_node(managed)
        managed.destroy_node()


def test_services_are_listed_and_called(graph: Any, ros2: Command) -> None:
    def answer(request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success = request.data
        response.message = "hecho"
        return response

    graph.node.create_service(SetBool, "switch", answer)
    assert "/switch [std_srvs/srv/SetBool]\n" in ros2("service", "list", "-t").stdout
    assert ros2("service", "type", "/switch").stdout == "std_srvs/srv/SetBool\n"
    done = ros2("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}")
    assert done.returncode == 0
    assert done.stdout.endswith(
        "requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n"
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='hecho')\n\n"
    )
    assert ros2("service", "info", "/switch").stdout == (
        "Type: std_srvs/srv/SetBool\nClients count: 0\nServices count: 1\n"
    )
    assert ros2("service", "info", "/nothing").stderr == "Unknown service '/nothing'\n"
    piped = ros2("service", "call", "/switch", "std_srvs/srv/SetBool", "--stdin", input="data: true\n")
    assert "success=True" in piped.stdout
    refused = ros2("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: 7}")
    assert "field 'data' takes true or false" in refused.stderr


def test_goals_are_sent_and_their_results_printed(graph: Any, ros2: Command) -> None:
    messages = pytest.importorskip("teo_sign_msgs.action")
    from rclpy.action import ActionServer

    def execute(handle: Any) -> Any:
        handle.publish_feedback(messages.ExecuteSentence.Feedback(gloss="HOLA"))
        handle.succeed()
        return messages.ExecuteSentence.Result(message="hecho")

    server = ActionServer(graph.node, messages.ExecuteSentence, "sign", execute)
    kind = "teo_sign_msgs/action/ExecuteSentence"
    assert ros2("action", "list", "-t").stdout == f"/sign [{kind}]\n"
    info = ros2("action", "info", "/sign").stdout
    assert info == "Action: /sign\nAction clients: 0\nAction servers: 1\n    /tester\n"
    done = ros2("action", "send_goal", "-f", "/sign", kind, "{}")
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
