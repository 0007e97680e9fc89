# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a person at the robot asks of it: stop, re-arm, pause, resume, slower, and where it will be."""

from __future__ import annotations

from collections.abc import Callable

from control_msgs.msg import SpeedScalingFactor
from control_msgs.srv import QueryTrajectoryState
from rclpy.node import Node
from std_srvs.srv import Trigger

from teo_sim_driver.errors import DriverError
from teo_sim_driver.follower_report import Mode
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.node.state_topics import doubles


class OperatorServices:
    """Serves them."""

    def __init__(self, node: Node, follower: JointFollower, *, rearm: Callable[[], None]) -> None:
        """Serve.

        Args:
            node: Which serves.
            follower: Does as it is told.
            rearm: Ends a stop or a fault; raises `DriverError`.
        """
        self._node, self._follower, self._rearm_joints = node, follower, rearm
        for name, callback in (
            ("stop", self._stop),
            ("rearm", self._rearm),
            ("pause", self._pause),
            ("resume", self._resume),
        ):
            node.create_service(Trigger, name, lambda _, response, do=callback: self._answer(do, response))
        node.create_subscription(SpeedScalingFactor, "speed_scaling_input", self._on_scaling, 10)
        node.create_service(QueryTrajectoryState, "query_state", self._on_query)

    def _now(self) -> int:
        now: int = self._node.get_clock().now().nanoseconds
        return now

    def _answer(self, do: Callable[[], str], response: Trigger.Response) -> Trigger.Response:
        try:
            response.message = do()
            response.success = True
        except DriverError as error:
            response.message = str(error)
        self._node.get_logger().info(response.message)
        return response

    def _stop(self) -> str:
        remaining = self._follower.block(Mode.STOPPED, "stopped by the service `stop`", self._now())
        where = f"at rest in {remaining:.2f} s" if remaining > 0.0 else "at rest"
        return f"stopped: {where}; call `rearm` before the next trajectory"

    def _rearm(self) -> str:
        self._rearm_joints()
        return f"armed: {self._follower.mode}"

    def _pause(self) -> str:
        remaining = self._follower.pause(self._now())
        return f"paused: at rest in {remaining:.2f} s"

    def _resume(self) -> str:
        if not self._follower.resume(self._now()):
            mode = self._follower.mode
            instead = ": call `rearm`" if mode in (Mode.STOPPED, Mode.FAULT) else ""
            raise DriverError("not_paused", f"expected a pause to end, it is {mode}{instead}")
        return f"resumed: {self._follower.mode}"

    def _on_scaling(self, message: SpeedScalingFactor) -> None:
        try:
            self._follower.scale(message.factor, self._now())
        except DriverError as error:
            self._node.get_logger().warning(f"speed_scaling_input ignored: {error}")

    def _on_query(
        self, request: QueryTrajectoryState.Request, response: QueryTrajectoryState.Response
    ) -> QueryTrajectoryState.Response:
        ahead = (request.time.sec * SECOND + request.time.nanosec - self._now()) / SECOND
        if ahead < 0.0:
            response.message = f"expected a time from now on, got one {-ahead:.3f} s ago"
            return response
        state = self._follower.state_at(ahead)
        response.success = True
        response.name = list(self._follower.limits.names)
        response.position, response.velocity = doubles(state.positions), doubles(state.velocities)
        response.acceleration = doubles(state.accelerations)
        return response
