# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What goes to the driver and what it says: motions by topic or action, `driver_state`, refusals.

One executor moves a robot: two that hear the same sentences would both send their motions to it.
"""

from __future__ import annotations

import socket
import uuid
from collections.abc import Callable

from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import DriverState
from trajectory_msgs.msg import JointTrajectory

from teo_lut_executor.execution.interface import DriverReport
from teo_lut_executor.node.messages import to_report
from teo_lut_executor.node.parameters import ACTION
from teo_signs.errors import PlanError

_RESULT = FollowJointTrajectory.Result

# Results that say that a goal was not taken, or not followed.
_REFUSALS = {
    _RESULT.INVALID_GOAL: "INVALID_GOAL",
    _RESULT.INVALID_JOINTS: "INVALID_JOINTS",
    _RESULT.OLD_HEADER_TIMESTAMP: "OLD_HEADER_TIMESTAMP",
    _RESULT.PATH_TOLERANCE_VIOLATED: "PATH_TOLERANCE_VIOLATED",
    _RESULT.GOAL_TOLERANCE_VIOLATED: "GOAL_TOLERANCE_VIOLATED",
}


def claim(topic: str, domain: int) -> socket.socket:
    """Claim a topic for this process, among those of the machine.

    Args:
        topic: Its full name.
        domain: Of DDS.

    Returns:
        What holds the claim until it is closed, or the process ends, however that comes about.

    Raises:
        PlanError: Another executor sends to it ("other_executor").
    """
    # A name that is no file: Linux forgets it with the process, also with one that is killed.
    held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        held.bind(f"\0teo_lut_executor.{domain}.{topic}")
    except OSError as error:
        held.close()
        raise PlanError(
            "other_executor",
            f"expected no other executor to send to {topic}, one does, and this one signs nothing: end one "
            "of them, or give it a namespace of its own",
        ) from error
    return held


class DriverLink:
    """Sends motions to the driver.

    Attributes:
        others_refused: Trajectories of others that the driver has refused since the executor began.
    """

    def __init__(
        self,
        node: Node,
        *,
        interface: str,
        on_report: Callable[[DriverReport], None],
        on_refused: Callable[[int, str], None],
    ) -> None:
        """Connect.

        Args:
            node: Owns publisher, client and subscription.
            interface: "topic" or "action".
            on_report: Called with what the driver says of itself.
            on_refused: Called with the number of a motion that the driver did not take, and why.
        """
        self._node = node
        self._on_report = on_report
        self._on_refused = on_refused
        self._stop = node.create_client(Trigger, "stop")
        self._topic = node.create_publisher(JointTrajectory, "joint_trajectory", 10)
        self._action: ActionClient | None = None
        if interface == ACTION:
            self._action = ActionClient(node, FollowJointTrajectory, "follow_joint_trajectory")
        # By which the driver names a motion of ours: one of an executor before this one is none.
        self._name = f"{node.get_fully_qualified_name()} {uuid.uuid4()}"
        self.others_refused = 0
        self._latest = 0  # number of the motion that was sent last
        self._by_topic = False  # whether it was sent by topic
        self._refused: int | None = None  # trajectories that the driver had refused by its last report
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._states = node.create_subscription(DriverState, "driver_state", self._on_state, latched)

    @property
    def listening(self) -> bool:
        """Whether anybody takes motions."""
        return self._serves or self._topic.get_subscription_count() > 0

    def send(self, number: int, trajectory: JointTrajectory) -> None:
        """Send a motion."""
        self._latest = number
        self._by_topic = not self._serves
        trajectory.header.frame_id = f"{self._name} {number}"
        if self._by_topic:
            self._topic.publish(trajectory)
            return
        assert self._action is not None
        sent = self._action.send_goal_async(FollowJointTrajectory.Goal(trajectory=trajectory))
        sent.add_done_callback(lambda future: self._on_answer(number, future))

    def halt(self) -> None:
        """Have the driver stop the robot by itself."""
        if self._stop.service_is_ready():
            self._stop.call_async(Trigger.Request())
        else:
            self._node.get_logger().error("expected the driver to serve `stop`, it does not: stop the robot")

    def close(self) -> None:
        """Disconnect."""
        if self._action is not None:
            self._action.destroy()
        self._node.destroy_client(self._stop)
        self._node.destroy_publisher(self._topic)
        self._node.destroy_subscription(self._states)

    @property
    def _serves(self) -> bool:
        return self._action is not None and self._action.server_is_ready()

    def _on_answer(self, number: int, sent: Future) -> None:
        goal = sent.result()
        if goal is None or not goal.accepted:
            self._on_refused(number, "the goal was rejected")
            return
        goal.get_result_async().add_done_callback(lambda future: self._on_result(number, future))

    def _on_result(self, number: int, future: Future) -> None:
        response = future.result()
        if response is None:
            return
        name = _REFUSALS.get(response.result.error_code)
        # A goal that a newer one of ours took the place of ends as invalid too: that is no refusal.
        if name is not None and number == self._latest:
            self._on_refused(number, f"[{name}] {response.result.error_string}")

    def _on_state(self, message: DriverState) -> None:
        before, self._refused = self._refused, message.refused
        self._on_report(to_report(message))
        new = 0 if before is None else max(message.refused - before, 0)
        self.others_refused += new
        # The driver names the last ones: one of ours among more of others shows by the robot.
        named = zip(message.refused_frame_ids, message.refusals, strict=False)
        for frame_id, refusal in list(named)[-new:] if new else ():
            sender, _, number = frame_id.rpartition(" ")
            if sender != self._name:
                continue
            self.others_refused -= 1
            if self._by_topic:  # of a goal its result tells
                self._on_refused(int(number), refusal)
