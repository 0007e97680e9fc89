# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The action `follow_joint_trajectory` of the whole body or a limb.

Its meanings are those of ros2_control's joint_trajectory_controller.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from enum import Enum
from typing import Any, NamedTuple

import numpy as np
from builtin_interfaces.msg import Time
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionServer, CancelResponse
from rclpy.node import Node
from rclpy.task import Future

from teo_sim_driver.follower_report import FollowerReport, Mode, Source
from teo_sim_driver.goal_monitor import GoalMonitor, ResultCode, result_code
from teo_sim_driver.motion.commanded_path import Command
from teo_sim_driver.motion.path_time import SECOND
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.node.lean_goal import lean_action
from teo_sim_driver.node.state_topics import difference, point
from teo_sim_driver.rules import JointGroup, Refusal, TrajectoryError

# How often a goal's progress is told [Hz]: action_monitor_rate of joint_trajectory_controller.
_FEEDBACK_RATE = 20

# Modes that end a goal at once.
_ENDING = (Mode.STOPPED, Mode.INACTIVE, Mode.FAULT)


class End(Enum):
    """How a goal ends, as the action's status says it."""

    SUCCEEDED = "succeed"
    ABORTED = "abort"
    CANCELED = "canceled"


class _Outcome(NamedTuple):
    """What the client is told."""

    end: End
    code: ResultCode
    sentence: str


class Goal:
    """A goal from its arrival to its end."""

    def __init__(self, handle: Any, joints: tuple[str, ...]) -> None:
        """Read its tolerances.

        Args:
            handle: Of rclpy's; its request is a `lean_goal.LeanGoal`.
            joints: The commanded joints.

        Raises:
            TrajectoryError: ``bad_tolerance`` or ``multi_dof``.
        """
        request, self.points, self.trajectory = handle.request
        if (
            request.multi_dof_trajectory.joint_names
            or request.multi_dof_trajectory.points
            or request.component_path_tolerance
            or request.component_goal_tolerance
        ):
            raise TrajectoryError(
                Refusal.MULTI_DOF, "expected joints of one degree of freedom alone: the robot has no others"
            )
        goal_time = request.goal_time_tolerance
        self.handle = handle
        self.monitor = GoalMonitor(
            joints,
            request.path_tolerance,
            request.goal_tolerance,
            goal_time.sec + goal_time.nanosec / SECOND,
        )
        self.outcome = Future()
        self.command: Command | None = None
        """What it became when it was taken."""

    def finish(self, end: End, code: ResultCode, sentence: str = "") -> None:
        """End it, unless it has ended."""
        if not self.outcome.done():
            self.outcome.set_result(_Outcome(end, code, sentence))

    def refuse(self, refusal: TrajectoryError) -> None:
        """End it because its trajectory is not executed."""
        self.finish(End.ABORTED, result_code(refusal.code), str(refusal))


class FollowAction:
    """Serves the action of a group of joints: at most one goal is executed, the newest."""

    def __init__(
        self,
        node: Node,
        group: JointGroup,
        *,
        joints: tuple[str, ...],
        step_rate: int,
        most_points: Callable[[], int],
        receive: Callable[[Goal], None],
        refused: Callable[[TrajectoryError], None],
        cancel: Callable[[Command], object],
    ) -> None:
        """Serve.

        Args:
            node: Which serves.
            group: Joints that its goals are about.
            joints: All commanded joints.
            step_rate: How often `step` is called [Hz].
            most_points: That a goal may have.
            receive: Takes in a goal's trajectory; raises `TrajectoryError`.
            refused: Counts a refusal.
            cancel: Slows the joints of a command down.
        """
        self._receive, self._refused, self._cancel = receive, refused, cancel
        self._joints = list(group.joints)
        self._columns = np.array([joints.index(name) for name in group.joints])
        self._all_joints = joints
        self._every = max(step_rate // _FEEDBACK_RATE, 1)
        self._steps = 0
        self._active: Goal | None = None
        self._cancelling = False
        self._server = ActionServer(
            node,
            lean_action(most_points),
            f"{group.prefix}follow_joint_trajectory",
            execute_callback=self._execute,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def begin(self, goal: Goal, command: Command) -> None:
        """Watch a goal that has been taken; the one before it ends."""
        if self._active is not None and self._active.command is not None:
            self._end_preempted(self._active.command)
        goal.command = command
        self._active, self._cancelling = goal, False

    def step(self, desired: MotionState, measured: MotionState, report: FollowerReport, stamp: Time) -> None:
        """Watch the goal that is being executed.

        Args:
            desired: What was sent to the joints.
            measured: Where they are.
            report: Of the follower.
            stamp: Of this step.
        """
        goal = self._active
        if goal is None or goal.command is None:
            return
        command = goal.command
        if report.mode in _ENDING:
            self._end(End.ABORTED, ResultCode.INVALID_GOAL, f"{report.mode}: {report.reason}")
        elif command.preempted_by is not None:
            self._end_preempted(command)
        elif goal.handle.is_cancel_requested:
            if command.over:
                self._end(End.CANCELED, ResultCode.SUCCESSFUL, "canceled: slowed down on the path and holds")
            elif not self._cancelling or report.at_rest:  # at rest in a pause, nothing else would end it
                self._cancelling = True
                self._cancel(command)
        elif verdict := goal.monitor.step(desired, measured, time.monotonic(), command.over):
            if verdict.code is ResultCode.SUCCESSFUL:
                self._end(End.SUCCEEDED, verdict.code)
            else:
                self._cancel(command)
                self._end(End.ABORTED, verdict.code, verdict.sentence)
        self._steps += 1
        if self._active is goal and self._steps % self._every == 0:
            self._tell(goal, desired.of_joints(self._columns), measured.of_joints(self._columns), stamp)

    def destroy(self) -> None:
        """Serve no longer."""
        self._server.destroy()

    def _end_preempted(self, command: Command) -> None:
        newer = command.preempted_by
        by = "goal" if newer is None or newer.source is Source.ACTION else "trajectory on a topic"
        by += f" of {newer.group}" if newer is not None and newer.group else ""
        self._end(End.ABORTED, ResultCode.INVALID_GOAL, f"preempted: a newer {by} took over")

    def _end(self, end: End, code: ResultCode, sentence: str = "") -> None:
        if self._active is not None:
            self._active.finish(end, code, sentence)
        self._active = None

    def _tell(self, goal: Goal, desired: MotionState, measured: MotionState, stamp: Time) -> None:
        feedback = FollowJointTrajectory.Feedback(
            joint_names=self._joints,
            desired=point(desired),
            actual=point(measured),
            error=difference(desired, measured),
        )
        feedback.header.stamp = stamp
        goal.handle.publish_feedback(feedback)

    async def _execute(self, handle: Any) -> FollowJointTrajectory.Result:
        # Every goal is accepted first, as only a result can carry the reason of a refusal.
        try:
            goal = Goal(handle, self._all_joints)
            self._receive(goal)
        except TrajectoryError as refusal:
            self._refused(refusal)
            outcome = _Outcome(End.ABORTED, result_code(refusal.code), str(refusal))
        else:
            outcome = await goal.outcome
        getattr(handle, outcome.end.value)()
        return FollowJointTrajectory.Result(error_code=int(outcome.code), error_string=outcome.sentence)
