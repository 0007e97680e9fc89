# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node: joint trajectories in, joint states out. Owns no motion: see `joint_follower.JointFollower`."""

from __future__ import annotations

import sys
import time
import traceback
from typing import Any

import numpy as np
from control_msgs.msg import SpeedScalingFactor
from control_msgs.srv import QueryTrajectoryState
from rcl_interfaces.msg import SetParametersResult
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, DiagnosticsPublisher, RateMeter
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_description import COMMANDED_JOINTS, HOME, LEG_JOINTS, DescriptionError, joint_limits, urdf_text
from teo_sim_driver.errors import DriverError, Refusal, TrajectoryError
from teo_sim_driver.follower_report import FollowerReport, Mode, Source
from teo_sim_driver.goal_monitor import ResultCode
from teo_sim_driver.health import RefusalLog, assess
from teo_sim_driver.intake import MOST_WAITING, Checked, Intake
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.message import SECOND
from teo_sim_driver.node.follow_action import End, FollowAction, Goal
from teo_sim_driver.node.hands import HandPublisher
from teo_sim_driver.node.state_topics import (
    ControllerStatePublisher,
    DriverStatePublisher,
    JointStatePublisher,
    doubles,
)
from teo_sim_driver.parameters import FAULT_PARAMETERS, PARAMETERS, RULE_PARAMETERS
from teo_sim_driver.path_time import Braking
from teo_sim_driver.plant import Faults, Plant, StateLine
from teo_sim_driver.rules import Rules
from teo_sim_driver.trajectory import MotionState

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

_FAULT_PREFIX = "fault_"

# How long a thread of Python may keep the others waiting [s]; a tenth of a step, that checking delays none.
_SWITCH_INTERVAL = 0.001


class DriverNode(LifecycleNode):
    """Executes trajectories as TEO would, and publishes where its joints are.

    It publishes in every state of its lifecycle, and moves in `active` alone.
    """

    def __init__(self, **node_arguments: Any) -> None:
        """Stand at HOME. The arguments are those of `rclpy.node.Node`, after its name."""
        super().__init__("teo_sim_driver", **node_arguments)
        declare_parameters(self, PARAMETERS)
        self._rate = self.get_parameter("update_rate").value
        hand_drive = self.get_parameter("hand_drive").value
        limits = joint_limits(COMMANDED_JOINTS, hand_drive=hand_drive)
        home = np.array([HOME[name] for name in COMMANDED_JOINTS])
        self._follower = JointFollower(limits=limits, start=home, period=1.0 / self._rate, held=LEG_JOINTS)
        self._follower.block(Mode.INACTIVE, "not active", self._now())
        self._intake: Intake[Goal | None] = Intake(limits, LEG_JOINTS)
        self._plant, self._state_line = Plant(COMMANDED_JOINTS, home), StateLine()
        self._measured = MotionState.at_rest(home)
        self.add_on_set_parameters_callback(self._check_parameters)
        self._apply_parameters()
        self.add_post_set_parameters_callback(lambda _: self._apply_parameters())

        self._meter, self._refusal_log = RateMeter(), RefusalLog()
        self._regularity = self._meter.report()
        self._reported: FollowerReport | None = None
        self._limited_steps = 0

        self._joint_states = JointStatePublisher(self)
        self._controller_state = ControllerStatePublisher(self)
        self._driver_state = DriverStatePublisher(self, _LATCHED, self._rate)
        self._hands = HandPublisher(self, _LATCHED)
        self._description = self.create_publisher(String, "robot_description", _LATCHED)
        self._description.publish(String(data=urdf_text(hand_drive)))
        self._diagnostics = DiagnosticsPublisher(self, "joints")
        self._action = FollowAction(
            self,
            step_rate=self._rate,
            receive=lambda goal: self._intake.put(goal.handle.request.trajectory, self._rules, goal),
            refused=self._on_refused,
            cancel=lambda: self._follower.cancel(self._now()),
        )
        self.create_subscription(
            JointTrajectory, "joint_trajectory", self._on_trajectory, MOST_WAITING, raw=True
        )
        self.create_subscription(SpeedScalingFactor, "speed_scaling_input", self._on_scaling, 10)
        self.create_service(QueryTrajectoryState, "query_state", self._on_query)
        for name, callback in (
            ("stop", self._stop),
            ("rearm", self._rearm),
            ("pause", self._pause),
            ("resume", self._resume),
        ):
            self.create_service(Trigger, name, lambda _, response, do=callback: self._answer(do, response))
        self.create_timer(1.0 / self._rate, self._on_step)
        self.create_timer(DIAGNOSTICS_PERIOD, self._on_diagnostics)
        if self.get_parameter("autostart").value:
            self.trigger_configure()
            self.trigger_activate()

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Take trajectories."""
        try:
            self._follower.release(Mode.INACTIVE)
        except DriverError as error:
            self.get_logger().error(f"not activated: {error.sentence}")
            return TransitionCallbackReturn.FAILURE
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Slow down and hold, and take nothing."""
        self._follower.block(Mode.INACTIVE, "deactivated", self._now())
        return super().on_deactivate(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Slow down and hold, and take nothing any more."""
        self._follower.block(Mode.INACTIVE, "shut down", self._now())
        return super().on_shutdown(state)

    def destroy_node(self) -> None:
        """End the thread that checks, then the node."""
        self._intake.close()
        self._action.destroy()
        super().destroy_node()

    def _now(self) -> int:
        now: int = self.get_clock().now().nanoseconds
        return now

    def _on_trajectory(self, message: bytes) -> None:
        try:
            self._intake.put(message, self._rules, None)
        except TrajectoryError as refusal:
            self._on_refused(refusal)

    def _take_checked(self, now: int) -> None:
        for checked in self._intake.take():
            try:
                self._take(checked, now)
            except TrajectoryError as refusal:
                if checked.sender is not None:
                    checked.sender.refuse(refusal)
                self._report(refusal)

    def _take(self, checked: Checked[Goal | None], now: int) -> None:
        """Let a checked trajectory take over.

        Raises:
            TrajectoryError: refused, and counted.
        """
        goal = checked.sender
        if goal is not None and goal.handle.is_cancel_requested:
            goal.finish(End.CANCELED, ResultCode.SUCCESSFUL, "canceled before it began")
            return
        source = Source.TOPIC if goal is None else Source.ACTION
        try:
            points = checked.result.result()
        except TrajectoryError as refusal:
            self._follower.count_refusal(refusal)
            raise
        except Exception as error:
            # A fault of the driver's own; the robot must go on holding, whatever a message brought to light.
            self.get_logger().error("".join(traceback.format_exception(error)))
            fault = TrajectoryError(Refusal.INTERNAL, f"fault in the driver: {type(error).__name__}: {error}")
            self._follower.count_refusal(fault)
            raise fault from error
        trajectory = self._follower.take(points, now, source)
        self._action.take_over(goal)
        self.get_logger().info(
            f"executing {len(points.times)} points of the {source}, at rest in {trajectory.duration:.2f} s"
        )

    def _on_refused(self, refusal: TrajectoryError) -> None:
        self._follower.count_refusal(refusal)
        self._report(refusal)

    def _report(self, refusal: TrajectoryError) -> None:
        line = self._refusal_log.line(refusal, time.monotonic())
        if line is not None:
            self.get_logger().warning(line)
            self._publish_diagnostics(self._reported)

    def _answer(self, do: Any, response: Trigger.Response) -> Trigger.Response:
        try:
            response.message = do()
            response.success = True
        except DriverError as error:
            response.message = str(error)
        self.get_logger().info(response.message)
        return response

    def _stop(self) -> str:
        remaining = self._follower.block(Mode.STOPPED, "stopped by the service `stop`", self._now())
        where = f"at rest in {remaining:.2f} s" if remaining > 0.0 else "at rest"
        return f"stopped: {where}; call `rearm` before the next trajectory"

    def _rearm(self) -> str:
        if pressed := self._plant.faults.limit_switches:
            raise DriverError("limit_switch", f"the limit switch of {', '.join(pressed)} is pressed")
        for mode in (Mode.STOPPED, Mode.FAULT):
            self._follower.release(mode)
        self._move_rest_to_what_did_not_follow()
        return f"armed: {self._follower.mode}"

    def _pause(self) -> str:
        remaining = self._follower.pause(self._now())
        return f"paused: at rest in {remaining:.2f} s"

    def _resume(self) -> str:
        if not self._follower.resume(self._now()):
            raise DriverError("not_paused", f"expected a pause to end, it is {self._follower.mode}")
        return f"resumed: {self._follower.mode}"

    def _move_rest_to_what_did_not_follow(self) -> None:
        """A drive that is switched on again holds where it is."""
        if self._follower.trajectory is None:
            sent = self._follower.state_at(0.0).positions
            astray = np.abs(self._measured.positions - sent) > self._following_error
            if astray.any():
                self._follower.move_rest(np.where(astray, self._measured.positions, sent))

    def _on_scaling(self, message: SpeedScalingFactor) -> None:
        try:
            self._follower.scale(message.factor, self._now())
        except DriverError as error:
            self.get_logger().warning(f"speed_scaling_input ignored: {error}")

    def _on_query(
        self, request: QueryTrajectoryState.Request, response: QueryTrajectoryState.Response
    ) -> QueryTrajectoryState.Response:
        ahead = (request.time.sec * SECOND + request.time.nanosec - self._now()) / SECOND
        if ahead < 0.0:
            response.message = f"expected a time from now on, got one {-ahead:.3f} s ago"
            return response
        state = self._follower.state_at(ahead)
        response.success = True
        response.name = list(COMMANDED_JOINTS)
        response.position, response.velocity = doubles(state.positions), doubles(state.velocities)
        response.acceleration = doubles(state.accelerations)
        return response

    def _on_step(self) -> None:
        begin = time.monotonic()
        clock = self.get_clock().now()
        now, stamp = clock.nanoseconds, clock.to_msg()
        self._take_checked(now)
        asked = self._follower.step(now)
        self._measured = self._plant.step(asked, self._follower.step_duration)
        self._watch(asked, now)
        report = self._follower.report()
        self._action.step(asked, self._measured, report, self._follower.trajectory is None, stamp)
        for measured_at, state in self._state_line.send(self._measured, now, self._plant.faults):
            self._joint_states.publish(state, measured_at)
        self._controller_state.publish(asked, self._measured, report.speed_scaling, stamp)
        self._driver_state.step(report, stamp)
        self._hands.step(self._measured.positions)
        self._meter.step(begin, time.monotonic())

    def _watch(self, asked: MotionState, now: int) -> None:
        """Stop when a joint does not do what it was told."""
        if self._measured is asked and not self._plant.faults.limit_switches:
            return
        if self._follower.mode is Mode.FAULT:
            return
        error = np.abs(self._measured.positions - asked.positions)
        j = int(np.argmax(error))
        if pressed := self._plant.faults.limit_switches:
            reason = f"the limit switch of {', '.join(pressed)} is pressed"
        elif error[j] > self._following_error:
            reason = (
                f"{COMMANDED_JOINTS[j]} does not follow: expected {asked.positions[j]:.4f} rad within "
                f"{self._following_error:g} rad, it is at {self._measured.positions[j]:.4f} rad"
            )
        else:
            return
        self._follower.block(Mode.FAULT, reason, now)
        self.get_logger().error(f"fault: {reason}")

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

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        names = {f"{_FAULT_PREFIX}frozen", f"{_FAULT_PREFIX}limit_switches"}
        asked = {name for each in parameters if each.name in names for name in _names(each.value)}
        unknown = sorted(asked - set(COMMANDED_JOINTS))
        return SetParametersResult(
            successful=not unknown,
            reason=f"no commanded joint is called {', '.join(unknown)}" if unknown else "",
        )

    def _apply_parameters(self) -> None:
        values = {row.name: self.get_parameter(row.name).value for row in PARAMETERS}
        self._rules = Rules(**{row.name: values[row.name] for row in RULE_PARAMETERS})
        self._follower.rules = self._rules
        self._follower.braking = Braking(values["stop_deceleration"], values["stop_jerk"])
        self._following_error = values["following_error"]
        faults: dict[str, Any] = {
            row.name.removeprefix(_FAULT_PREFIX): values[row.name] for row in FAULT_PARAMETERS
        }
        for name in ("frozen", "limit_switches"):
            faults[name] = _names(faults[name])
        self._plant.faults = Faults(**faults)


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    sys.setswitchinterval(_SWITCH_INTERVAL)
    try:
        run_node(DriverNode, arguments)
    except DescriptionError as error:  # of a parameter that is read at the start
        sys.exit(f"driver_node: {error.code}: {error}")
