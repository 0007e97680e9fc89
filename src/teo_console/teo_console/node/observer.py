# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Follows the nodes: what they publish, and whether they are there."""

from __future__ import annotations

from collections.abc import Callable
from xml.etree import ElementTree

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from teo_sign_msgs.msg import DriverState, ExecutorStatus, SignSentence, TranslationStatus

from teo_common.diagnostics import Level
from teo_console.errors import ConsoleError
from teo_console.node import messages
from teo_console.protocol import NodeRole
from teo_console.situation import ROLES, SharedSituation, diagnosed_node

# The topic by whose publisher a node is known, whatever it is called.
_TOPICS: dict[NodeRole, str] = {
    "translator": "translation_status",
    "executor": "executor_status",
    "driver": "joint_states",
}
# How often the graph is asked who is there [Hz]: a node that ended is noticed within a quarter of a second.
_GRAPH_RATE = 4.0


class Observer:
    """Enters into the situation what comes from the graph, and keeps the newest pose."""

    def __init__(
        self, node: Node, situation: SharedSituation, *, now: Callable[[], float], changed: Callable[[], None]
    ) -> None:
        """Listen.

        Args:
            node: Owns the subscriptions.
            situation: What pages show.
            now: The time [s].
            changed: Called when the executor has a new status.
        """
        self._node = node
        self._situation = situation
        self._now = now
        self._changed = changed
        self._joint_state = b""
        self.urdf = ""
        self.robot = ""
        """Name of the robot that the driver moves; empty while none is known."""
        self.language = ""
        """Code of the sign language that is translated into; likewise."""
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        # Best effort takes reliable publishers as well; only the newest state counts.
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        # A text's worth of sentences that come while a callback runs.
        many = 100
        # Latched too, but each counts: what was refused is told just before what is done now.
        statuses = QoSProfile(depth=many, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        subscribe = node.create_subscription
        # As bytes: a hundred come a second, of which some thirty are looked at.
        subscribe(JointState, "joint_states", self._on_joint_state, newest, raw=True)
        subscribe(SignSentence, "sign_tokens", self._on_tokens, many)
        subscribe(ExecutorStatus, "executor_status", self._on_executor_status, statuses)
        subscribe(DriverState, "driver_state", self._on_driver_state, latched)
        subscribe(TranslationStatus, "translation_status", self._on_translation_status, many)
        subscribe(DiagnosticArray, "diagnostics", self._on_diagnostics, many)
        subscribe(String, "robot_description", self._on_description, latched)
        subscribe(String, "speech", self._on_speech, many)
        node.create_timer(1.0 / _GRAPH_RATE, self._look_at_graph)

    def take_joint_state(self) -> JointState | None:
        """The newest joint state, if one has come since this was called last."""
        if not self._joint_state:
            return None
        raw, self._joint_state = self._joint_state, b""
        return deserialize_message(raw, JointState)

    def _look_at_graph(self) -> None:
        for role in ROLES:
            present = self._node.count_publishers(_TOPICS[role]) > 0
            self._situation.publishers(role, present=present)

    def _on_joint_state(self, message: bytes) -> None:
        self._joint_state = message
        self._situation.joints(self._now())

    def _on_tokens(self, message: SignSentence) -> None:
        self._situation.tokens(messages.to_sentence(message))

    def _on_executor_status(self, message: ExecutorStatus) -> None:
        self._situation.executor(messages.to_signing_report(message))
        self._changed()

    def _on_driver_state(self, message: DriverState) -> None:
        mode, path = messages.to_mode(message), messages.to_path_report(message)
        self._situation.driver(mode, message.message, path)

    def _on_translation_status(self, message: TranslationStatus) -> None:
        refusal = messages.to_refusal(message)
        if refusal is not None:
            self._situation.refused_text(refusal)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            level = Level(min(int.from_bytes(status.level), Level.STALE))
            self._situation.diagnosis(status.name, level, status.message, self._now())
            if diagnosed_node(status.name) == "translator":
                self.language = {each.key: each.value for each in status.values}.get("language", "")

    def _on_description(self, message: String) -> None:
        self.urdf = message.data
        try:
            self.robot = ElementTree.fromstring(message.data).get("name", "")
        except ElementTree.ParseError:
            self.robot = ""  # the page says that it has no robot

    def _on_speech(self, message: String) -> None:
        try:
            self._situation.spoken.hear(message.data)
        except ConsoleError as error:
            self._node.get_logger().warning(f"speech not taken: [{error.code}] {error}")
