# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether the joints keep to a goal of follow_joint_trajectory: its tolerances, on the way and at the end."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from teo_sim_driver.checking.reading import quoted
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.rules import Refusal, TrajectoryError

if TYPE_CHECKING:  # of their fields alone
    from control_msgs.msg import JointTolerance

# A tolerance that says that the joint may be anywhere.
_ERASED = -1.0


class ResultCode(IntEnum):
    """error_code of control_msgs/action/FollowJointTrajectory."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


_RESULT = {
    Refusal.NO_JOINTS: ResultCode.INVALID_JOINTS,
    Refusal.DUPLICATE_JOINT: ResultCode.INVALID_JOINTS,
    Refusal.UNKNOWN_JOINT: ResultCode.INVALID_JOINTS,
    Refusal.HELD_JOINT: ResultCode.INVALID_JOINTS,
    Refusal.OTHER_GROUP: ResultCode.INVALID_JOINTS,
    Refusal.MISSING_JOINTS: ResultCode.INVALID_JOINTS,
    Refusal.ENDS_IN_THE_PAST: ResultCode.OLD_HEADER_TIMESTAMP,
}


def result_code(refusal: str) -> ResultCode:
    """The action's code for a refusal's: INVALID_GOAL unless there is a nearer one."""
    return _RESULT.get(Refusal(refusal), ResultCode.INVALID_GOAL)


def _table(joints: Sequence[str], tolerances: Iterable[JointTolerance], what: str) -> FloatArray:
    """Position [rad] and velocity [rad/s], infinite where it does not matter. Shape (2, joints)."""
    table = np.full((2, len(joints)), np.inf)
    for each in tolerances:
        if each.name not in joints:
            raise TrajectoryError(Refusal.BAD_TOLERANCE, f"{what}: no joint is called {quoted(each.name)}")
        if each.acceleration > 0.0:
            raise TrajectoryError(
                Refusal.BAD_TOLERANCE,
                f"{what} of {each.name}: accelerations are not measured, leave their tolerance at 0",
            )
        column = joints.index(each.name)
        for row, value in enumerate((each.position, each.velocity)):
            if value == _ERASED:
                table[row, column] = np.inf
            elif value > 0.0:
                table[row, column] = value
            elif value != 0.0:
                raise TrajectoryError(
                    Refusal.BAD_TOLERANCE,
                    f"{what} of {each.name}: expected a number > 0, 0 for the default or -1 for none, "
                    f"got {value}",
                )
    return table


class Verdict(NamedTuple):
    """How a goal ended."""

    code: ResultCode
    sentence: str
    """What was expected and what came; empty on success."""


class GoalMonitor:
    """Watches one goal."""

    def __init__(
        self,
        joints: Sequence[str],
        path: Iterable[JointTolerance],
        goal: Iterable[JointTolerance],
        goal_time: float,
    ) -> None:
        """Read the tolerances of a goal.

        Args:
            joints: Of the driver.
            path: How far they may be from where they are to be on the way.
            goal: The same at the end.
            goal_time: How long they may take to come within `goal` after the end [s]; 0: as they like.

        Raises:
            TrajectoryError: ``bad_tolerance``.
        """
        if not goal_time >= 0.0:
            raise TrajectoryError(
                Refusal.BAD_TOLERANCE, f"expected goal_time_tolerance >= 0 s, got {goal_time:g} s"
            )
        self._joints, self._goal_time = joints, goal_time
        self._path = _table(joints, path, "path_tolerance")
        self._goal = _table(joints, goal, "goal_tolerance")
        self._ended: float | None = None

    def step(self, desired: MotionState, measured: MotionState, time: float, ended: bool) -> Verdict | None:
        """Judge one step.

        Args:
            desired: What was sent to the joints.
            measured: Where they are.
            time: On a clock that nobody sets [s].
            ended: Whether the trajectory is over.

        Returns:
            How the goal ended; None while it goes on.
        """
        if not ended:
            beyond = self._beyond(self._path, desired, measured)
            return Verdict(ResultCode.PATH_TOLERANCE_VIOLATED, beyond) if beyond else None
        if self._ended is None:
            self._ended = time
        beyond = self._beyond(self._goal, desired, measured)
        if not beyond:
            return Verdict(ResultCode.SUCCESSFUL, "")
        waited = time - self._ended
        if self._goal_time == 0.0 or waited < self._goal_time:
            return None
        return Verdict(
            ResultCode.GOAL_TOLERANCE_VIOLATED, f"{beyond}, {waited:.3f} s after the end of the trajectory"
        )

    def _beyond(self, tolerances: FloatArray, desired: MotionState, measured: MotionState) -> str:
        """The joint that is farthest beyond its tolerance, and by how much; empty if none is."""
        for row, what, unit in ((0, "position", "rad"), (1, "velocity", "rad/s")):
            error = np.abs(measured[row] - desired[row])
            excess = error - tolerances[row]
            j = int(np.argmax(excess))
            if excess[j] > 0.0:
                return (
                    f"expected the {what} of {self._joints[j]} within {tolerances[row, j]:g} {unit} of "
                    f"{desired[row][j]:.4f} {unit}, got {measured[row][j]:.4f} {unit}"
                )
        return ""
