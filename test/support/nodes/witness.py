# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Somebody who sees what is published, what becomes of it, and how the robot moves.

As a process, `python -m witness`, it prints what it knows five times a second as a line of JSON, for
those who cannot be where it is: in another machine's network.
"""

from __future__ import annotations

import json
from typing import NamedTuple

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import ExecutorStatus, SignSentence, TranslationStatus

from teo_bringup.graph import SIGNING
from teo_common.node_process import run_node
from teo_description.humanoid import load_humanoid
from teo_names import ALL_JOINTS, COMMANDED_JOINTS, joint_limits

_AT_REST = 0.02  # [rad]
_PERIOD = 0.2  # [s]


class Seen(NamedTuple):
    """What a witness knows, as its process tells it."""

    sentences: int
    """Published ones."""
    outcomes: list[str]
    """Of those of which the executor has told: `signed`, or why not."""
    named: dict[str, int]
    """Reasons that the executor gave since the start, and how often."""
    signing: bool
    unrest: str
    """As `Witness.unrest`."""
    fastest: float
    """Greatest speed of a joint over its limit since the start [1]."""
    outside: float
    """Greatest way of a joint past its limit since the start [rad]; below 0: none."""
    trunk: float
    """Greatest turn of the trunk since the start [rad], which no sign asks for."""
    trajectory_publishers: int
    """Most publishers of `joint_trajectory` at once."""
    gap: float
    """Longest time between joint states since the start [s]."""

    @property
    def at_rest(self) -> bool:
        """As `Witness.at_rest`."""
        return not self.unrest


class Witness(Node):
    """Sees what was published, what became of it, and how the robot moved."""

    def __init__(self) -> None:
        super().__init__("witness")
        self.sentences: set[tuple[str, int]] = set()
        self.accounted: dict[tuple[str, int], str] = {}
        self.answered: set[str] = set()  # utterances that the translator has made of texts
        self.heard: set[str] = set()  # nodes that have told how they are
        self.named: dict[str, int] = {}  # reasons that the executor gave, and how often
        self.told: ExecutorStatus | None = None
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
        self.told = message
        if message.code:
            self.named[message.code] = self.named.get(message.code, 0) + 1
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
        return not self.unrest

    @property
    def unrest(self) -> str:
        """What is not as it should be once all is done; empty when nothing is amiss."""
        if len(self.heard) < len(SIGNING):
            return f"heard of {', '.join(sorted(self.heard)) or 'nobody'} alone"
        if self.told is None or self.told.state != ExecutorStatus.STATE_IDLE:
            return f"the executor is not idle: {self.told and self.told.message}"
        if not self.states:
            return "no joint states"
        columns = [ALL_JOINTS.index(name) for name in COMMANDED_JOINTS]
        rests = load_humanoid().hanging, load_humanoid().ready
        off = min(np.abs(self.states[-1][1][columns] - rest).max() for rest in rests)
        return "" if off < _AT_REST else f"{off:.2f} rad from rest"

    def fastest(self) -> float:
        """Greatest speed of a joint over its limit since this was asked last [1], restarts aside."""
        times = np.array([stamp for stamp, _ in self.states])
        positions = np.array([position for _, position in self.states])
        self.states = self.states[-1:]
        steps = np.diff(times)
        regular = (steps > 0.005) & (steps < 0.1)  # stamps jitter; a restarted driver begins at home
        speeds = np.abs(np.diff(positions, axis=0))[regular] / steps[regular, None]
        return float((speeds / joint_limits(ALL_JOINTS).velocity).max()) if speeds.size else 0.0


class _Teller(Witness):
    """Prints what it knows."""

    def __init__(self) -> None:
        super().__init__()
        self._limits = joint_limits(ALL_JOINTS)
        self._greatest = {"fastest": 0.0, "outside": -np.inf, "trunk": 0.0, "gap": 0.0, "publishers": 0.0}
        self.create_timer(_PERIOD, self._tell)

    def _tell(self) -> None:
        if self.states:
            positions = np.array([position for _, position in self.states])
            beyond = np.maximum(positions - self._limits.upper, self._limits.lower - positions)
            gaps = np.diff([stamp for stamp, _ in self.states], prepend=self.states[0][0])
            self._raise("outside", float(beyond.max()))
            self._raise("trunk", float(np.abs(positions[:, ALL_JOINTS.index("AxialTrunk")]).max()))
            self._raise("gap", float(gaps.max()))
            self._raise("fastest", self.fastest())
        self._raise("publishers", float(self.count_publishers("joint_trajectory")))
        seen = Seen(
            sentences=len(self.sentences),
            outcomes=list(self.accounted.values()),
            named=self.named,
            signing=self.told is not None and self.told.state == ExecutorStatus.STATE_SIGNING,
            unrest=self.unrest,
            fastest=self._greatest["fastest"],
            outside=self._greatest["outside"],
            trunk=self._greatest["trunk"],
            trajectory_publishers=int(self._greatest["publishers"]),
            gap=self._greatest["gap"],
        )
        print(json.dumps(seen._asdict()), flush=True)

    def _raise(self, name: str, value: float) -> None:
        self._greatest[name] = max(self._greatest[name], value)


if __name__ == "__main__":
    run_node(_Teller, None)
