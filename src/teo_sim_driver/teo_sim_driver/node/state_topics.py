# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver publishes: joint states, controller state, its own state, set-points of real hands."""

from __future__ import annotations

from array import array
from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Time
from control_msgs.msg import JointTrajectoryControllerState
from rclpy.node import Node
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout
from teo_sign_msgs.msg import DriverState
from trajectory_msgs.msg import JointTrajectoryPoint

from teo_description.hand_setpoints import hand_setpoints, setpoint_axes
from teo_description.humanoid import SIDES, Humanoid
from teo_description.robot_schema import AXES
from teo_sim_driver.follower_report import FollowerReport, Mode, Source
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.motion.trajectory import MotionState

# How often the driver's state is published while the joints move [Hz]: often enough to show progress.
_PROGRESS_RATE = 10

# The message's constants have the names of our own.
_MODES = {mode: getattr(DriverState, f"MODE_{mode.name}") for mode in Mode}
_SOURCES = {source: getattr(DriverState, f"SOURCE_{source.name}") for source in Source}


def doubles(values: FloatArray) -> array[float]:
    """The one type that a message takes without looking at every number."""
    return array("d", values.tobytes())


def point(state: MotionState) -> JointTrajectoryPoint:
    """A state as a message."""
    return JointTrajectoryPoint(
        positions=doubles(state.positions),
        velocities=doubles(state.velocities),
        accelerations=doubles(state.accelerations),
    )


def difference(desired: MotionState, measured: MotionState) -> JointTrajectoryPoint:
    """The error as a message; accelerations are not measured."""
    return JointTrajectoryPoint(
        positions=doubles(desired.positions - measured.positions),
        velocities=doubles(desired.velocities - measured.velocities),
    )


class JointStatePublisher:
    """Publishes measured states; joints that stand are at home."""

    def __init__(self, node: Node, humanoid: Humanoid) -> None:
        self._publisher = node.create_publisher(JointState, "joint_states", 10)
        self._message = JointState(name=list(humanoid.all_joints))
        self._standing = np.array([humanoid.home[name] for name in humanoid.standing])
        self._last: MotionState | None = None

    def publish(self, state: MotionState, measured_at: int) -> None:
        """Publish a state that was measured at this time [ns]."""
        if state is not self._last:
            self._last = state
            self._message.position = doubles(np.concatenate([state.positions, self._standing]))
            still = np.zeros_like(self._standing)
            self._message.velocity = doubles(np.concatenate([state.velocities, still]))
        self._message.header.stamp.sec, self._message.header.stamp.nanosec = divmod(measured_at, SECOND)
        self._publisher.publish(self._message)


class ControllerStatePublisher:
    """Publishes what a joint_trajectory_controller would, while anybody listens."""

    def __init__(self, node: Node, joints: Sequence[str]) -> None:
        self._joints = list(joints)
        self._publisher = node.create_publisher(JointTrajectoryControllerState, "controller_state", 10)

    def publish(self, desired: MotionState, measured: MotionState, scaling: float, stamp: Time) -> None:
        """Publish a step."""
        if not self._publisher.get_subscription_count():
            return
        message = JointTrajectoryControllerState(
            joint_names=self._joints,
            reference=point(desired),
            feedback=point(measured),
            error=difference(desired, measured),
            output=point(desired),
            speed_scaling_factor=scaling,
        )
        message.header.stamp = stamp
        self._publisher.publish(message)


class DriverStatePublisher:
    """Publishes what the driver is doing on every change, and its progress now and then."""

    def __init__(self, node: Node, qos: QoSProfile, step_rate: int) -> None:
        self._publisher = node.create_publisher(DriverState, "driver_state", qos)
        self._every = max(step_rate // _PROGRESS_RATE, 1)
        self._steps = 0
        self._last: tuple[object, ...] = ()

    def step(self, report: FollowerReport, stamp: Time) -> None:
        """Enter a step."""
        self._steps += 1
        refused = sum(report.refused.values())
        # While the joints move, a pace that changes is progress.
        settled = report.speed_scaling if report.at_rest else None
        now = (report.mode, report.at_rest, report.source, settled, refused)
        if now == self._last and (report.at_rest or self._steps % self._every):
            return
        self._last = now
        last = report.last_refusal
        message = DriverState(
            mode=_MODES[report.mode],
            at_rest=report.at_rest,
            source=_SOURCES[report.source],
            speed_scaling=report.speed_scaling,
            path_time=report.path_time,
            path_duration=report.path_duration,
            refused=refused,
            refusal_code=last.code if last else "",
            refused_frame_ids=[refusal.frame_id for refusal in report.refusals],
            refusals=[f"[{refusal.code}] {refusal.sentence}" for refusal in report.refusals],
            message=report.reason or (last.sentence if last else ""),
        )
        message.header.stamp = stamp
        self._publisher.publish(message)


# Steps between hand set-points [1]: 50 Hz at the usual rate, as often as TEO's CAN bus is synchronised.
_EVERY = 2


class HandPublisher:
    """Publishes the hands' set-points when they change, on `dextra_setpoints`."""

    def __init__(self, node: Node, qos: QoSProfile, humanoid: Humanoid) -> None:
        """Publish those of a humanoid whose hands have `setpoint_axes`."""
        self._publisher = node.create_publisher(Float64MultiArray, "dextra_setpoints", qos)
        self._humanoid = humanoid
        self._columns = humanoid.columns(humanoid.hand("left") + humanoid.hand("right"))
        count = len(self._columns)
        units = (axis.unit for axis in setpoint_axes(humanoid, "left"))
        axes = ", ".join(f"{name} [{unit}]" for name, unit in zip(AXES, units, strict=True))
        self._layout = MultiArrayLayout(
            dim=[
                MultiArrayDimension(label=f"hand: {', '.join(SIDES)}", size=len(SIDES), stride=count),
                MultiArrayDimension(label=f"axis: {axes}", size=count // 2, stride=count // 2),
            ]
        )
        self._last: FloatArray | None = None
        self._steps = 0

    def step(self, positions: FloatArray) -> None:
        """Enter the positions of the commanded joints [rad]. Shape (joints,)."""
        self._steps += 1
        hands = positions[self._columns]
        if self._steps % _EVERY != 1 or (self._last is not None and np.array_equal(hands, self._last)):
            return
        self._last = hands
        setpoints = hand_setpoints(self._humanoid, hands)
        self._publisher.publish(Float64MultiArray(layout=self._layout, data=doubles(setpoints)))
