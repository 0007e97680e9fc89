# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The shape of what is printed, as a transcript of a shell in a graph that is always the same."""

from __future__ import annotations

import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import SetBool

# Lines that begin with `$ ros2` are typed; what follows is printed, `…` standing for the rest of a line, and
# a status that is not 0.
TRANSCRIPT = Path(__file__).parent / "golden" / "outputs.txt"


def same(printed: str, golden: str) -> bool:
    """Tell whether two texts are the same but for what `…` stands for."""
    lines, expected = printed.splitlines(), golden.splitlines()
    if len(lines) != len(expected):
        return False
    return all(
        line == form or ("…" in form and line.startswith(form[: form.index("…")]))
        for line, form in zip(lines, expected, strict=True)
    )


@pytest.mark.slow
def test_outputs_have_the_shape_of_the_transcript(
    graph: Any, ros2_here: Callable[..., subprocess.CompletedProcess[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    node = graph.node
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_publisher(String, "text", latched).publish(String(data="¡hola, TEO!"))
    pose = JointState(name=["a", "b"], position=[1.0, 2.0])
    node.create_publisher(JointState, "pose", latched).publish(pose)
    node.create_publisher(String, "_secret", 10)
    node.create_subscription(JointState, "state", lambda _: None, 10)
    node.create_service(SetBool, "switch", lambda _request, response: response)
    limits = FloatingPointRange(from_value=0.0, to_value=2.0)
    node.declare_parameter(
        "speed", 1.0, ParameterDescriptor(description="[m/s]", floating_point_range=[limits])
    )
    node.declare_parameter("names", ["a", "b"])
    for part in TRANSCRIPT.read_text(encoding="utf-8").split("$ ros2 ")[1:]:
        words, _, golden = part.partition("\n")
        seen: list[str] = []

        def is_golden(words: str = words, golden: str = golden, seen: list[str] = seen) -> bool:
            done = ros2_here(*shlex.split(words))
            status = f"exit {done.returncode}\n" if done.returncode else ""
            seen.append(done.stdout + done.stderr + status)
            return same(seen[-1], golden)

        # On a loaded machine a look may come before all has been announced: then another one.
        assert is_golden() or is_golden() or is_golden(), f"ros2 {words}\n{seen[-1]}"
