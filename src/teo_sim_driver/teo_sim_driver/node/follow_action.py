# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The action `follow_joint_trajectory`, with the meanings of ros2_control's joint_trajectory_controller."""

from __future__ import annotations

import time
from collections.abc import Callable
from enum import Enum
from typing import Any, NamedTuple

from builtin_interfaces.msg import Time
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionServer, CancelResponse
from rclpy.node import Node
from rclpy.task import Future

from teo_description import COMMANDED_JOINTS
from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.follower_report import FollowerReport, Mode
from teo_sim_driver.goal_monitor import GoalMonitor, ResultCode, Tolerances, result_code
from teo_sim_driver.message import SECOND
from teo_sim_driver.node.state_topics import difference, point
from teo_sim_driver.trajectory import MotionState

# How often a goal's progress is told [Hz]: action_monitor_rate of joint_trajectory_controller.
_FEEDBACK_RATE = 20

# Modes that end a goal at once.
_ENDING = (Mode.STOPPED, Mode.INACTIVE, Mode.FAULT)


class End(Enum):
    """How a goal ends, as the action's status says it."""

    SUCCEEDED = "succeed"
    ABORTED = "abort"
    CANCELED = "canceled"


class Outcome(NamedTuple):
    """What the client is told."""

    end: End
    code: ResultCode
    sentence: str


class Goal:
    """A goal from its arrival to its end."""

    def __init__(self, handle: Any) -> None:
        """Read its tolerances.

        Raises:
            TrajectoryError: ``bad_tolerance`` or ``multi_dof``.
        """
        request = handle.request
        if (
            request.multi_dof_trajectory.joint_names
            or request.multi_dof_trajectory.points
            or request.component_path_tolerance
            or request.component_goal_tolerance
        ):
            raise TrajectoryError(
                Refusal.MULTI_DOF, "expected joints of one degree of freedom alone: TEO has no others"
            )
        goal_time = request.goal_time_tolerance
        self.handle = handle
        self.monitor = GoalMonitor(
            COMMANDED_JOINTS,
            Tolerances.read(
                COMMANDED_JOINTS,
                request.path_tolerance,
                request.goal_tolerance,
                goal_time.sec + goal_time.nanosec / SECOND,
            ),
        )
        self.outcome = Future()

    def finish(self, end: End, code: ResultCode, sentence: str = "") -> None:
        """End it, unless it has ended."""
        if not self.outcome.done():
            self.outcome.set_result(Outcome(end, code, sentence))

    def refuse(self, refusal: TrajectoryError) -> None:
        """End it because its trajectory is not executed."""
        self.finish(End.ABORTED, result_code(refusal.code), str(refusal))


class FollowAction:
    """Serves the action: at most one goal is executed, the newest."""

    def __init__(
        self,
        node: Node,
        *,
        step_rate: int,
        receive: Callable[[Goal], None],
        refused: Callable[[TrajectoryError], None],
        cancel: Callable[[], object],
    ) -> None:
        """Serve.

        Args:
            node: Which serves.
            step_rate: How often `step` is called [Hz].
            receive: Takes in a goal's trajectory; raises `TrajectoryError`.
            refused: Counts a refusal.
            cancel: Slows the robot down.
        """
        self._receive, self._refused, self._cancel = receive, refused, cancel
        self._every = max(step_rate // _FEEDBACK_RATE, 1)
        self._steps = 0
        self._active: Goal | None = None
        self._cancelling = False
        self._server = ActionServer(
            node,
            FollowJointTrajectory,
            "follow_joint_trajectory",
            execute_callback=self._execute,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def take_over(self, goal: Goal | None) -> None:
        """End the goal that was being executed: a new trajectory is, this goal's or one of the topic."""
        if self._active is not None:
            by = "goal" if goal else "trajectory on the topic joint_trajectory"
            self._end(End.ABORTED, ResultCode.INVALID_GOAL, f"preempted: a newer {by} took over")
        self._active, self._cancelling = goal, False

    def step(
        self, desired: MotionState, measured: MotionState, report: FollowerReport, ended: bool, stamp: Time
    ) -> None:
        """Watch the goal that is being executed.

        Args:
            desired: What was sent to the joints.
            measured: Where they are.
            report: Of the follower.
            ended: Whether the follower holds again.
            stamp: Of this step.
        """
        goal = self._active
        if goal is None:
            return
        if report.mode in _ENDING:
            self._end(End.ABORTED, ResultCode.INVALID_GOAL, f"{report.mode}: {report.reason}")
        elif goal.handle.is_cancel_requested:
            if not self._cancelling:
                self._cancelling = True
                self._cancel()
            elif ended:
                self._end(End.CANCELED, ResultCode.SUCCESSFUL, "canceled: slowed down on the path and holds")
        elif verdict := goal.monitor.step(desired, measured, time.monotonic(), ended):
            if verdict.code is ResultCode.SUCCESSFUL:
                self._end(End.SUCCEEDED, verdict.code)
            else:
                self._cancel()
                self._end(End.ABORTED, verdict.code, verdict.sentence)
        self._steps += 1
        if self._active is goal and self._steps % self._every == 0:
            self._tell(goal, desired, measured, stamp)

    def destroy(self) -> None:
        """Serve no longer."""
        self._server.destroy()

    def _end(self, end: End, code: ResultCode, sentence: str = "") -> None:
        if self._active is not None:
            self._active.finish(end, code, sentence)
        self._active = None

    def _tell(self, goal: Goal, desired: MotionState, measured: MotionState, stamp: Time) -> None:
        feedback = FollowJointTrajectory.Feedback(
            joint_names=list(COMMANDED_JOINTS),
            desired=point(desired),
            actual=point(measured),
            error=difference(desired, measured),
        )
        feedback.header.stamp = stamp
        goal.handle.publish_feedback(feedback)

    async def _execute(self, handle: Any) -> FollowJointTrajectory.Result:
        # Every goal is accepted first, as only a result can carry the reason of a refusal.
        try:
            goal = Goal(handle)
            self._receive(goal)
        except TrajectoryError as refusal:
            self._refused(refusal)
            outcome = Outcome(End.ABORTED, result_code(refusal.code), str(refusal))
        else:
            outcome = await goal.outcome
        getattr(handle, outcome.end.value)()
        return FollowJointTrajectory.Result(error_code=int(outcome.code), error_string=outcome.sentence)
