# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node: joint trajectories in, joint states out. Owns no motion: see `joint_follower.JointFollower`."""

from __future__ import annotations

import time
import traceback
from array import array
from typing import Any

import numpy as np
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout, String
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, DiagnosticsPublisher, RateMeter
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_description import ALL_JOINTS, COMMANDED_JOINTS, HOME, LEG_JOINTS, joint_limits, urdf_text
from teo_description.tendons import HAND_AXES, hand_setpoints
from teo_sim_driver.bezier import FloatArray
from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.health import RefusalLog, assess
from teo_sim_driver.joint_follower import FollowerReport, JointFollower
from teo_sim_driver.parameters import PARAMETERS
from teo_sim_driver.rules import Rules
from teo_sim_driver.trajectory import MotionState

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

# Steps between hand set-points [1]: 50 Hz at the usual rate, as often as TEO's CAN bus is synchronised.
_HAND_EVERY = 2


class DriverNode(Node):
    """Executes trajectories as TEO would, and publishes where its joints are."""

    def __init__(self, **node_arguments: Any) -> None:
        """Stand at HOME. The arguments are those of `rclpy.node.Node`, after its name."""
        super().__init__("teo_sim_driver", **node_arguments)
        declare_parameters(self, PARAMETERS)
        self._rate = self.get_parameter("update_rate").value
        self._follower = JointFollower(
            limits=joint_limits(COMMANDED_JOINTS),
            start=np.array([HOME[name] for name in COMMANDED_JOINTS]),
            period=1.0 / self._rate,
            held=LEG_JOINTS,
        )
        self._apply_parameters()
        self.add_post_set_parameters_callback(self._on_parameters_set)

        self._meter, self._refusal_log = RateMeter(), RefusalLog()
        self._regularity = self._meter.report()
        self._reported: FollowerReport | None = None
        self._limited_steps = 0
        self._steps = 0
        self._state: MotionState | None = None
        self._legs = np.array([HOME[name] for name in LEG_JOINTS])
        self._joint_state = JointState(name=list(ALL_JOINTS))
        self._hands: FloatArray | None = None

        self._joint_states = self.create_publisher(JointState, "joint_states", 10)
        self._description = self.create_publisher(String, "robot_description", _LATCHED)
        self._description.publish(String(data=urdf_text()))
        self._hand_setpoints = self.create_publisher(Float64MultiArray, "dextra_setpoints", _LATCHED)
        self._diagnostics = DiagnosticsPublisher(self, "joints")
        self.create_subscription(JointTrajectory, "joint_trajectory", self._on_trajectory, 10)
        self.create_service(Trigger, "stop", self._on_stop)
        self.create_timer(1.0 / self._rate, self._on_step)
        self.create_timer(DIAGNOSTICS_PERIOD, self._on_diagnostics)

    def _on_trajectory(self, message: JointTrajectory) -> None:
        try:
            trajectory = self._follower.accept(message, self.get_clock().now().nanoseconds)
        except TrajectoryError as refusal:
            self._report(refusal)
        except Exception as error:
            # A fault of the driver's own; the robot must go on holding, whatever a message brought to light.
            self.get_logger().error(traceback.format_exc())
            fault = TrajectoryError(Refusal.INTERNAL, f"fault in the driver: {type(error).__name__}: {error}")
            self._follower.count_refusal(fault)
            self._report(fault)
        else:
            self.get_logger().info(
                f"executing {len(message.points)} points, at rest in {trajectory.duration:.2f} s"
            )

    def _report(self, refusal: TrajectoryError) -> None:
        line = self._refusal_log.line(refusal, time.monotonic())
        if line is not None:
            self.get_logger().warning(line)
            self._publish_diagnostics(self._reported)

    def _on_stop(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        remaining = self._follower.stop(self.get_clock().now().nanoseconds)
        response.success = True
        response.message = f"at rest in {remaining:.2f} s" if remaining > 0.0 else "at rest"
        self.get_logger().info(f"told to stop: {response.message}")
        return response

    def _on_step(self) -> None:
        begin = time.monotonic()
        now = self.get_clock().now()
        state = self._follower.step(now.nanoseconds)
        if state is not self._state:
            self._state = state
            self._joint_state.position = _doubles(np.concatenate([state.positions, self._legs]))
            self._joint_state.velocity = _doubles(
                np.concatenate([state.velocities, np.zeros_like(self._legs)])
            )
        self._joint_state.header.stamp = now.to_msg()
        self._joint_states.publish(self._joint_state)
        self._steps += 1
        if self._steps % _HAND_EVERY == 1:
            self._publish_hands(state.positions[-_HANDS:])
        self._meter.step(begin, time.monotonic())

    def _publish_hands(self, hands: FloatArray) -> None:
        if self._hands is not None and np.array_equal(hands, self._hands):
            return
        self._hands = hands
        setpoints = hand_setpoints(_HAND_JOINTS, hands)
        self._hand_setpoints.publish(Float64MultiArray(layout=_HAND_LAYOUT, data=_doubles(setpoints)))

    def _on_diagnostics(self) -> None:
        self._regularity = self._meter.report()
        self._reported, before = self._follower.report(), self._reported
        self._publish_diagnostics(before)

    def _publish_diagnostics(self, before: FollowerReport | None) -> None:
        report = self._follower.report()
        health = assess(report, self._regularity, nominal_rate=self._rate, before=before)
        if report.limited_steps > self._limited_steps:
            self._limited_steps = report.limited_steps
            self.get_logger().error(f"{health.message}: {report.limited_steps} steps since the start")
        self._diagnostics.publish(health)

    def _on_parameters_set(self, _: list[Parameter]) -> None:
        self._apply_parameters()

    def _apply_parameters(self) -> None:
        values = {row.name: self.get_parameter(row.name).value for row in PARAMETERS}
        self._follower.stop_deceleration = values.pop("stop_deceleration")
        values.pop("update_rate")
        self._follower.rules = Rules(**values)


_HAND_JOINTS = tuple(axis.joint for axis in HAND_AXES)
_HANDS = len(_HAND_JOINTS)
if COMMANDED_JOINTS[-_HANDS:] != _HAND_JOINTS:
    raise RuntimeError(
        f"expected the hand axes to be the last commanded joints, got {COMMANDED_JOINTS[-_HANDS:]}"
    )
_HAND_LAYOUT = MultiArrayLayout(
    dim=[
        MultiArrayDimension(label="hand: left, right", size=2, stride=_HANDS),
        MultiArrayDimension(
            label="axis: abductor [deg], thumb, index, middle, ring, pinky [mm]", size=6, stride=_HANDS // 2
        ),
    ]
)


def _doubles(values: FloatArray) -> array[float]:
    """The one type that a message takes without looking at every number."""
    return array("d", values.tobytes())


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    run_node(DriverNode, arguments)
