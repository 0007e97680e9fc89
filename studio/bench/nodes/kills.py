# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What becomes of sentences when a process is killed with SIGKILL at a random moment, and started again.

Each time a text of two short sentences is typed; at a random moment translator, executor, its planner or the
driver is killed, and started again a second later, as a supervisor would. Another text is typed meanwhile,
unless it is the translator that is dead. Then the robot must come to rest, having kept its speed limits, and
every sentence that the translator published must have been signed or named. A text that dies with the
translator before it was answered can be named by nobody: it is counted.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String

from nodes.witness import Witness
from report import Figure
from teo_bringup.graph import NODES, SIGNING, executable_of

KILLS = 20
_TEXT = "Hola. Sí."
_LONGEST = 8.0  # [s] until the text is signed, about
_VICTIMS = ("translator", "executor", "planner", "driver")
_SEED = 13
# [s] until all is at rest again: an executor and its planner load for 7 s of a core, which are minutes where
# seven processes of higher priority wait for each.
_TIMEOUT = 900.0
_RESTART = 1.0  # [s] after which a supervisor starts a process again


def measure(kills: int = KILLS, seed: int = _SEED) -> list[Figure]:
    """Kill processes at random moments, each as often as the others, and count what is lost."""
    os.environ.setdefault("ROS_DOMAIN_ID", "18")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    rclpy.init()
    witness, executor, dice = Witness(), SingleThreadedExecutor(), random.Random(seed)
    executor.add_node(witness)
    processes: dict[str, subprocess.Popen[bytes]] = {}

    def wait(condition: Callable[[], bool], most: float) -> bool:
        deadline = time.monotonic() + most
        while not condition() and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=0.05)
        return condition()

    def start(name: str, journal: Path) -> None:
        command = [str(executable_of(*NODES[name]))]
        if name == "executor":
            command += ["--ros-args", "-p", f"journal:={journal}"]
        processes[name] = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    lost: list[str] = []
    restless: list[str] = []
    unanswered = 0
    outcomes: Counter[str] = Counter()
    fastest = longest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        journal = Path(folder)
        try:
            for name in SIGNING:
                start(name, journal)
            for index in range(kills):
                wait(lambda: witness.at_rest, _TIMEOUT)
                victim, moment = _VICTIMS[index % len(_VICTIMS)], dice.uniform(0.0, _LONGEST)
                witness.texts.publish(String(data=_TEXT))
                typed = 1
                wait(lambda: False, moment)
                _kill(victim, processes)
                if victim != "translator":
                    witness.texts.publish(String(data=_TEXT))
                    typed += 1
                wait(lambda: False, _RESTART)
                witness.heard.clear()  # what was restarted is there when it is heard again
                if victim != "planner":
                    start(victim, journal)
                began = time.monotonic()
                if not wait(lambda: witness.at_rest, _TIMEOUT):
                    restless.append(f"{victim} after {moment:.1f} s: {witness.unrest}")
                longest = max(longest, time.monotonic() - began)
                unanswered += typed - len(witness.answered)
                lost += [
                    f"{victim} after {moment:.1f} s" for _ in witness.sentences - witness.accounted.keys()
                ]
                outcomes.update(witness.accounted.values())
                fastest = max(fastest, witness.fastest())
                witness.forget()
        finally:
            for process in processes.values():
                process.kill()
                process.wait()
    witness.destroy_node()
    rclpy.shutdown()
    told = ", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common())
    return [
        Figure(f"sentences after {kills} kills", told),
        Figure("sentences neither signed nor named", f"{len(lost)} {'; '.join(lost)}".strip()),
        Figure("texts that died with the translator, unanswered", str(unanswered)),
        Figure("kills after which the robot did not come to rest", f"{len(restless)} {'; '.join(restless)}"),
        Figure("longest from a restart until all is signed and at rest", f"{longest:.0f} s"),
        Figure("greatest speed over the limit", f"{fastest:.3f}"),
    ]


def _kill(victim: str, processes: dict[str, subprocess.Popen[bytes]]) -> None:
    if victim == "planner":  # the executor's only child
        parent = processes["executor"].pid
        for child in Path(f"/proc/{parent}/task/{parent}/children").read_text().split():
            os.kill(int(child), signal.SIGKILL)
        return
    processes[victim].kill()
    processes[victim].wait()
