# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node: joint trajectories in, joint states out. Owns no motion: see `joint_follower.JointFollower`."""

from __future__ import annotations

import sys
import time
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, DiagnosticsPublisher, RateMeter
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid, load_humanoid
from teo_sim_driver.follower_report import FollowerReport, Mode, RefusalLog, assess
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.motion.path_time import Braking
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.node.command_inputs import CommandInputs, OperatorServices, clock_time
from teo_sim_driver.node.state_topics import (
    ControllerStatePublisher,
    DriverStatePublisher,
    HandPublisher,
    JointStatePublisher,
)
from teo_sim_driver.parameters import FAULT_PARAMETERS, IDEAL, MUJOCO, PARAMETERS, RULE_PARAMETERS
from teo_sim_driver.plants.plant import (
    Faults,
    FaultyPlant,
    IdealPlant,
    Plant,
    StateLine,
    fault,
    where_to_hold,
)
from teo_sim_driver.rules import DriverError, Rules, TrajectoryError

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

_FAULT_PREFIX = "fault_"

# How long a thread of Python may keep the others waiting [s]; a tenth of a step, that checking delays none.
_SWITCH_INTERVAL = 0.001


class DriverNode(LifecycleNode):
    """Executes trajectories as the robot would, and publishes where its joints are.

    It publishes in every state of its lifecycle, and moves in `active` alone.
    """

    def __init__(self, **node_arguments: Any) -> None:
        """Stand at home. The arguments are those of `rclpy.node.Node`, after its name."""
        super().__init__("teo_sim_driver", **node_arguments)
        declare_parameters(self, PARAMETERS)
        self._rate = self.get_parameter("update_rate").value
        hand_drive = self.get_parameter("hand_drive").value
        self._humanoid = humanoid = load_humanoid(self.get_parameter("robot").value)
        limits, home = humanoid.limits(hand_drive=hand_drive), humanoid.hanging
        self._follower = JointFollower(limits=limits, start=home, period=1.0 / self._rate)
        self._follower.block(Mode.INACTIVE, "not active", clock_time(self))
        self._plant = FaultyPlant(_plant(self.get_parameter("plant").value, humanoid), limits, home)
        self._state_line = StateLine()
        self._asked = self._measured = MotionState.at_rest(home)
        self._astray = False  # whether a joint did not follow, and the robot is not at rest since
        self.add_on_set_parameters_callback(self._check_parameters)
        self._apply_parameters()
        self.add_post_set_parameters_callback(lambda _: self._apply_parameters())

        self._meter, self._refusal_log = RateMeter(), RefusalLog()
        self._regularity = self._meter.report()
        self._reported: FollowerReport | None = None
        self._limited_steps = 0

        self._joint_states = JointStatePublisher(self, humanoid)
        self._controller_state = ControllerStatePublisher(self, humanoid.commanded_joints)
        self._driver_state = DriverStatePublisher(self, _LATCHED, self._rate)
        self._hands = HandPublisher(self, _LATCHED, humanoid) if humanoid.file.controllers else None
        self._description = self.create_publisher(String, "robot_description", _LATCHED)
        self._description.publish(String(data=humanoid.urdf_text(hand_drive)))
        self._diagnostics = DiagnosticsPublisher(self, "joints")
        self._inputs = CommandInputs(
            self, self._follower, humanoid, step_rate=self._rate, report=self._report
        )
        self._operator = OperatorServices(self, self._follower, rearm=self._rearm)
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
        self._follower.block(Mode.INACTIVE, "deactivated", clock_time(self))
        return super().on_deactivate(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Slow down and hold, and take nothing any more."""
        self._follower.block(Mode.INACTIVE, "shut down", clock_time(self))
        return super().on_shutdown(state)

    def destroy_node(self) -> None:
        """End the thread that checks, then the node."""
        self._inputs.close()
        super().destroy_node()

    def _report(self, refusal: TrajectoryError) -> None:
        line = self._refusal_log.line(refusal, time.monotonic())
        if line is not None:
            self.get_logger().warning(line)
            self._publish_diagnostics(self._reported)

    def _rearm(self) -> None:
        if pressed := self._plant.faults.limit_switches:
            raise DriverError("limit_switch", f"the limit switch of {', '.join(pressed)} is pressed")
        for mode in (Mode.STOPPED, Mode.FAULT):
            self._follower.release(mode)

    def _on_step(self) -> None:
        begin = time.monotonic()
        clock = self.get_clock().now()
        now, stamp = clock.nanoseconds, clock.to_msg()
        self._inputs.take_checked(now)
        self._asked = asked = self._follower.step(now)
        self._measured = self._plant.step(asked, self._follower.step_duration)
        self._watch(now)
        self._inputs.step(asked, self._measured, stamp)
        self._operator.step()
        report = self._follower.report()
        for measured_at, state in self._state_line.send(self._measured, now, self._plant.faults):
            self._joint_states.publish(state, measured_at)
        self._controller_state.publish(asked, self._measured, report.speed_scaling, stamp)
        self._driver_state.step(report, stamp)
        if self._hands is not None:
            self._hands.step(self._measured.positions)
        self._meter.step(begin, time.monotonic())

    def _watch(self, now: int) -> None:
        """Stop when a joint does not do what it was told, and then let it hold where it is.

        It would otherwise set out for where it was told to be as soon as nothing hinders it any more.
        """
        if self._astray and self._follower.trajectory is None:
            self._astray = False
            where = where_to_hold(self._asked, self._measured, self._following_error)
            if where is not None:
                self._follower.move_rest(where)
        pressed = self._plant.faults.limit_switches
        if (self._measured is self._asked and not pressed) or self._follower.mode is Mode.FAULT:
            return
        joints = self._humanoid.commanded_joints
        reason = fault(joints, self._asked, self._measured, self._following_error, pressed)
        if reason:
            self._follower.block(Mode.FAULT, reason, now)
            self._astray = True
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
        unknown = sorted(asked - set(self._humanoid.commanded_joints))
        return SetParametersResult(
            successful=not unknown,
            reason=f"no commanded joint is called {', '.join(unknown)}" if unknown else "",
        )

    def _apply_parameters(self) -> None:
        values = {row.name: self.get_parameter(row.name).value for row in PARAMETERS}
        self._follower.rules = Rules(**{row.name: values[row.name] for row in RULE_PARAMETERS})
        self._follower.braking = Braking(values["stop_deceleration"], values["stop_jerk"])
        self._following_error = values["following_error"]
        faults: dict[str, Any] = {
            row.name.removeprefix(_FAULT_PREFIX): values[row.name] for row in FAULT_PARAMETERS
        }
        for name in ("frozen", "limit_switches"):
            faults[name] = _names(faults[name])
        self._plant.faults = Faults(**faults)


def _plant(name: str, humanoid: Humanoid) -> Plant:
    """The joints that were asked for.

    Raises:
        DriverError: ``unknown_plant``, ``mujoco_missing``.
    """
    if name == IDEAL:
        return IdealPlant()
    if name != MUJOCO:
        raise DriverError("unknown_plant", f"plant: expected {IDEAL!r} or {MUJOCO!r}, got {name!r}")
    try:
        from teo_sim_driver.plants.physics import PhysicsPlant  # a driver of ideal joints does without MuJoCo
    except ModuleNotFoundError as error:
        raise DriverError(
            "mujoco_missing",
            f"plant: {MUJOCO!r} needs MuJoCo: python -m pip install -r requirements/physics.txt ({error})",
        ) from error
    return PhysicsPlant(humanoid)


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    sys.setswitchinterval(_SWITCH_INTERVAL)
    try:
        run_node(DriverNode, arguments, PARAMETERS)
    except DescriptionError as error:  # of a parameter that is read at the start
        sys.exit(f"driver_node: {error.code}: {error}")
    except DriverError as error:  # likewise
        sys.exit(f"driver_node: {error}")
