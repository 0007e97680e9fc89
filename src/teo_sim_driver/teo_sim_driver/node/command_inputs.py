# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is asked of the robot: trajectories of the whole body or a limb; to stop, pause or go slower."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from builtin_interfaces.msg import Time
from control_msgs.msg import SpeedScalingFactor
from control_msgs.srv import QueryTrajectoryState
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory

from teo_description.humanoid import Humanoid
from teo_sim_driver.checking.reading import check_count, frame_id
from teo_sim_driver.checking.validation import MOST_WAITING, Checked, Intake
from teo_sim_driver.follower_report import Mode, Source
from teo_sim_driver.goal_monitor import ResultCode
from teo_sim_driver.joint_follower import JointFollower
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.node.follow_action import End, FollowAction, Goal
from teo_sim_driver.node.state_topics import doubles
from teo_sim_driver.rules import DriverError, JointGroup, Refusal, TrajectoryError, joint_groups

# rclpy looks at every event of every topic each time it waits, a hundred times a second: for the topics of
# limbs that took 8 % of the driver's processor time. A publisher whose QoS does not fit is told of on the
# topic of the whole body alone.
_UNWATCHED = SubscriptionEventCallbacks(use_default_callbacks=False)


def clock_time(node: Node) -> int:
    """Time on a node's clock [ns]."""
    time: int = node.get_clock().now().nanoseconds
    return time


class _Sender(NamedTuple):
    """Where a trajectory came from."""

    group: JointGroup
    goal: Goal | None
    """None for the topic."""
    frame_id: str
    """Of the trajectory's header."""


class CommandInputs:
    """Has trajectories checked beside the steps, and hands them to the follower between two steps."""

    def __init__(
        self,
        node: Node,
        follower: JointFollower,
        humanoid: Humanoid,
        *,
        step_rate: int,
        report: Callable[[TrajectoryError], None],
    ) -> None:
        """Listen.

        Args:
            node: Which listens.
            follower: Executes them, and has the rules for them.
            humanoid: Whose joints they are for.
            step_rate: How often `step` is called [Hz].
            report: Tells people of a refusal.
        """
        self._node, self._follower, self._report = node, follower, report
        self._intake: Intake[_Sender] = Intake(follower.limits, humanoid.standing)
        self._actions = {}
        for group in joint_groups(humanoid):
            node.create_subscription(
                JointTrajectory,
                f"{group.prefix}joint_trajectory",
                partial(self._on_trajectory, group),
                MOST_WAITING,
                raw=True,
                event_callbacks=_UNWATCHED if group.name else None,
            )
            self._actions[group.name] = FollowAction(
                node,
                group,
                joints=humanoid.commanded_joints,
                step_rate=step_rate,
                most_points=lambda: self._follower.rules.max_points,
                receive=partial(self._on_goal, group),
                refused=self._on_refused,
                cancel=lambda command: self._follower.cancel(clock_time(self._node), command),
            )

    def take_checked(self, now: int) -> None:
        """Let what has been checked take over [ns]."""
        for checked in self._intake.take():
            try:
                self._take(checked, now)
            except TrajectoryError as refusal:
                refusal.frame_id = checked.sender.frame_id
                if checked.sender.goal is not None:
                    checked.sender.goal.refuse(refusal)
                self._report(refusal)

    def step(self, desired: MotionState, measured: MotionState, stamp: Time) -> None:
        """Watch the goals that are being executed; arguments as those of `FollowAction.step`."""
        report = self._follower.report()
        for action in self._actions.values():
            action.step(desired, measured, report, stamp)

    def close(self) -> None:
        """End the thread that checks, and serve no longer."""
        self._intake.close()
        for action in self._actions.values():
            action.destroy()

    def _on_trajectory(self, group: JointGroup, message: bytes) -> None:
        sender = _Sender(group, None, frame_id(message))
        try:
            self._intake.put(message, self._follower.rules, sender, group)
        except TrajectoryError as refusal:
            refusal.frame_id = sender.frame_id
            self._on_refused(refusal)

    def _on_goal(self, group: JointGroup, goal: Goal) -> None:
        check_count(goal.points, self._follower.rules)
        sender = _Sender(group, goal, frame_id(goal.trajectory))
        self._intake.put(goal.trajectory, self._follower.rules, sender, group)

    def _on_refused(self, refusal: TrajectoryError) -> None:
        self._follower.count_refusal(refusal)
        self._report(refusal)

    def _take(self, checked: Checked[_Sender], now: int) -> None:
        """Let a checked trajectory take over.

        Raises:
            TrajectoryError: refused, and counted.
        """
        group, goal, _ = checked.sender
        if goal is not None and goal.handle.is_cancel_requested:
            goal.finish(End.CANCELED, ResultCode.SUCCESSFUL, "canceled before it began")
            return
        try:
            points = checked.result.result()
        except TrajectoryError as refusal:
            self._follower.count_refusal(refusal)
            raise
        except Exception as error:
            # A fault of the driver's own; the robot must go on holding, whatever a message brought to light.
            self._node.get_logger().error("".join(traceback.format_exception(error)))
            fault = TrajectoryError(Refusal.INTERNAL, f"fault in the driver: {type(error).__name__}: {error}")
            self._follower.count_refusal(fault)
            raise fault from error
        source = Source.TOPIC if goal is None else Source.ACTION
        command = self._follower.take(points, now, source, group.name)
        if goal is not None:
            self._actions[group.name].begin(goal, command)
        self._node.get_logger().info(
            f"executing {len(points.times)} points ({command.name}), at rest in {command.end:.2f} s"
        )


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
        self._waiting: list[Future] = []  # to be re-armed; each is done when the robot is at rest or stopped
        beside = ReentrantCallbackGroup()  # the steps go on while it waits
        node.create_service(Trigger, "rearm", self._on_rearm, callback_group=beside)
        for name, callback in (
            ("stop", self._stop),
            ("pause", self._pause),
            ("resume", self._resume),
        ):
            node.create_service(Trigger, name, lambda _, response, do=callback: self._answer(do, response))
        node.create_subscription(SpeedScalingFactor, "speed_scaling_input", self._on_scaling, 10)
        node.create_service(QueryTrajectoryState, "query_state", self._on_query)

    def step(self) -> None:
        """Re-arm a robot that has come to rest, where somebody waits for it."""
        if not self._follower.slows_down:
            self._end_waiting(stopped=False)

    def _end_waiting(self, *, stopped: bool) -> None:
        for waiting in self._waiting:
            waiting.set_result(stopped)
        self._waiting.clear()

    async def _on_rearm(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        stopped = False
        if self._follower.slows_down:
            self._waiting.append(at_rest := Future())
            stopped = await at_rest
        return self._answer(self._stopped_again if stopped else self._rearm, response)

    def _stopped_again(self) -> str:
        raise DriverError("stopped_again", "expected it to come to rest, it was stopped again: re-arm it")

    def _answer(self, do: Callable[[], str], response: Trigger.Response) -> Trigger.Response:
        try:
            response.message = do()
            response.success = True
        except DriverError as error:
            response.message = str(error)
        self._node.get_logger().info(response.message)
        return response

    def _stop(self) -> str:
        self._end_waiting(stopped=True)
        remaining = self._follower.block(
            Mode.STOPPED, "stopped by the service `stop`", clock_time(self._node)
        )
        where = f"at rest in {remaining:.2f} s" if remaining > 0.0 else "at rest"
        return f"stopped: {where}; call `rearm` before the next trajectory"

    def _rearm(self) -> str:
        self._rearm_joints()
        return f"armed: {self._follower.mode}"

    def _pause(self) -> str:
        remaining = self._follower.pause(clock_time(self._node))
        return f"paused: at rest in {remaining:.2f} s"

    def _resume(self) -> str:
        if not self._follower.resume(clock_time(self._node)):
            report = self._follower.report()
            instead = f": {report.reason}" if report.reason else ""
            if report.mode in (Mode.STOPPED, Mode.FAULT):
                instead += ": call `rearm`"
            raise DriverError("not_paused", f"expected a pause to end, it is {report.mode}{instead}")
        return f"resumed: {self._follower.mode}"

    def _on_scaling(self, message: SpeedScalingFactor) -> None:
        try:
            self._follower.scale(message.factor, clock_time(self._node))
        except DriverError as error:
            self._node.get_logger().warning(f"speed_scaling_input ignored: {error}")

    def _on_query(
        self, request: QueryTrajectoryState.Request, response: QueryTrajectoryState.Response
    ) -> QueryTrajectoryState.Response:
        ahead = (request.time.sec * SECOND + request.time.nanosec - clock_time(self._node)) / SECOND
        if ahead < 0.0:
            response.message = f"expected a time from now on, got one {-ahead:.3f} s ago"
            return response
        state = self._follower.state_at(ahead)
        response.success = True
        response.name = list(self._follower.limits.names)
        response.position, response.velocity = doubles(state.positions), doubles(state.velocities)
        response.acceleration = doubles(state.accelerations)
        return response
