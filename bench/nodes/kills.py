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

import numpy as np
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from report import Figure
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus, SignSentence, TranslationStatus

from teo_bringup.graph import NODES, executable_of
from teo_description import ALL_JOINTS, COMMANDED_JOINTS, joint_limits
from teo_motion.sentence.rest_posture import REST_POSITIONS

KILLS = 20
_TEXT = "Hola. Sí."
_LONGEST = 8.0  # [s] until the text is signed, about
_VICTIMS = ("translator", "executor", "planner", "driver")
_SEED = 13
_TIMEOUT = 120.0  # [s] until all is at rest again
_RESTART = 1.0  # [s] after which a supervisor starts a process again
_AT_REST = 0.02  # [rad]


class _Witness(Node):
    """Sees what was published, what became of it, and how the robot moved."""

    def __init__(self) -> None:
        super().__init__("witness")
        self.sentences: set[tuple[str, int]] = set()
        self.accounted: dict[tuple[str, int], str] = {}
        self.answered: set[str] = set()  # utterances that the translator has made of texts
        self.heard: set[str] = set()  # nodes that have told how they are
        self.state: int | None = None
        self.states: list[tuple[float, np.ndarray]] = []
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(SignSentence, "sign_tokens", self._on_sentence, 100)
        self.create_subscription(DiagnosticArray, "diagnostics", self._on_diagnostics, 100)
        self.create_subscription(TranslationStatus, "translation_status", self._on_answer, 100)
        self.create_subscription(ExecutorStatus, "executor_status", self._on_status, latched)
        self.create_subscription(JointState, "joint_states", self._on_joints, 100)
        self.texts = self.create_publisher(String, "text", 10)

    def _on_sentence(self, message: SignSentence) -> None:
        self.answered.add(message.utterance_id)
        self.sentences.add((message.utterance_id, message.sentence_index))

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.heard |= {status.name.split(":")[0] for status in message.status}

    def _on_answer(self, message: TranslationStatus) -> None:
        self.answered.add(message.utterance_id)

    def _on_status(self, message: ExecutorStatus) -> None:
        self.state = message.state
        if message.sentence_count and message.state == ExecutorStatus.STATE_SIGNING:
            self.accounted[message.utterance_id, message.sentence_index] = "signed"
        elif message.sentence_count and message.state == ExecutorStatus.STATE_REFUSED:
            self.accounted[message.utterance_id, message.sentence_index] = message.code

    def _on_joints(self, message: JointState) -> None:
        stamp = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
        self.states.append((stamp, np.array(message.position)))

    def forget(self) -> None:
        """Know nothing of sentences any more."""
        self.answered.clear()
        self.sentences.clear()
        self.accounted.clear()

    @property
    def at_rest(self) -> bool:
        """Whether all nodes are there, the robot is at rest and the executor says that all is done."""
        if len(self.heard) < len(NODES):
            return False
        columns = [ALL_JOINTS.index(name) for name in COMMANDED_JOINTS]
        there = bool(self.states) and any(
            np.abs(self.states[-1][1][columns] - rest).max() < _AT_REST for rest in REST_POSITIONS.values()
        )
        return there and self.state == ExecutorStatus.STATE_IDLE

    def fastest(self) -> float:
        """Greatest speed of a joint over its limit since this was asked last [1], restarts aside."""
        times = np.array([stamp for stamp, _ in self.states])
        positions = np.array([position for _, position in self.states])
        self.states = self.states[-1:]
        steps = np.diff(times)
        regular = (steps > 0.005) & (steps < 0.1)  # stamps jitter; a restarted driver begins at home
        speeds = np.abs(np.diff(positions, axis=0))[regular] / steps[regular, None]
        return float((speeds / joint_limits(ALL_JOINTS).velocity).max()) if speeds.size else 0.0


def measure(kills: int = KILLS, seed: int = _SEED) -> list[Figure]:
    """Kill processes at random moments, each as often as the others, and count what is lost."""
    os.environ.setdefault("ROS_DOMAIN_ID", "18")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    rclpy.init()
    witness, executor, dice = _Witness(), SingleThreadedExecutor(), random.Random(seed)
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
    fastest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        journal = Path(folder)
        try:
            for name in NODES:
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
                if not wait(lambda: witness.at_rest, _TIMEOUT):
                    restless.append(f"{victim} after {moment:.1f} s")
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
