# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import signal
import subprocess
import sys
from importlib.metadata import distribution

import pytest

NODE = """
import rclpy
from rclpy.node import Node
from teo_common.node_process import run_node

class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_timer(0.1, lambda: print("spins", flush=True))

    def destroy_node(self):
        print("destroyed, can publish:", rclpy.ok(), flush=True)
        super().destroy_node()

run_node(Talker, None)
print("returned", flush=True)
"""
TOLD_WHILE_MADE = """
import os, signal, time
import rclpy
from rclpy.node import Node
from teo_common.node_process import run_node

class Slow(Node):
    def __init__(self):
        super().__init__("slow")
        os.kill(os.getpid(), signal.SIGTERM)
        while rclpy.ok():
            time.sleep(0.01)

run_node(Slow, None)
print("returned", flush=True)
"""
REFUSED = """
import rclpy
from teo_common.node_process import run_node

def refuse():
    raise ValueError("no table")

try:
    run_node(refuse, None)
except ValueError as error:
    print(error, rclpy.ok())
"""


@pytest.mark.parametrize(
    ("package", "executable", "parameter"),
    [
        ("teo_sign_translator", "translator_node", "max_sentences (100, 1 to 100"),
        ("teo_lut_executor", "executor_node", "path_time (0.5, 0 to 10"),
        ("teo_sim_driver", "driver_node", "update_rate (100, 10 to 500, fixed at the start)"),
        ("teo_skeleton_retriever", "retriever_node", "detector ("),
    ],
)
def test_every_node_has_help_and_does_not_run_for_it(
    package: str,
    executable: str,
    parameter: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("sys.argv", [executable, "--help"])
    (point,) = distribution(package).entry_points.select(name=executable)
    point.load()()
    said = capsys.readouterr()
    assert said.err == ""
    assert said.out.startswith(f"usage: {executable} [--ros-args -p PARAMETER:=VALUE")
    assert parameter in said.out


@pytest.mark.parametrize("told", [signal.SIGINT, signal.SIGTERM])
def test_a_node_that_is_told_to_end_is_destroyed_and_ends_well(told: int, domain_id: int) -> None:
    environment = os.environ | {"ROS_DOMAIN_ID": str(domain_id)}
    command = [sys.executable, "-c", NODE]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "spins\n"
            process.send_signal(told)
            rest, _ = process.communicate(timeout=20.0)
        finally:
            process.kill()
        assert rest.endswith("destroyed, can publish: True\nreturned\n")
        assert process.returncode == 0


@pytest.mark.parametrize(
    ("program", "said"),
    [(REFUSED, "no table False\n"), (TOLD_WHILE_MADE, "returned\n")],
    ids=["it cannot be made", "told to end while it is made"],
)
def test_a_node_that_never_spins_leaves_ros_ended_and_says_no_word_of_it(
    program: str, said: str, domain_id: int
) -> None:
    environment = os.environ | {"ROS_DOMAIN_ID": str(domain_id)}
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=20.0, check=True)
    assert (done.stdout, done.stderr) == (said, "")
