# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

import numpy as np
import pytest

from teo_sim_driver.goal_monitor import GoalMonitor, ResultCode, result_code
from teo_sim_driver.motion.trajectory import MotionState
from teo_sim_driver.rules import Refusal, TrajectoryError

JOINTS = ("neck", "elbow")


@dataclass
class Tolerance:
    name: str
    position: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0


def state(neck, elbow, speed=0.0):
    return MotionState(np.array([neck, elbow]), np.array([speed, 0.0]), np.zeros(2))


def monitor(path=(), goal=(), goal_time=0.0):
    return GoalMonitor(JOINTS, path, goal, goal_time)


@pytest.mark.parametrize(
    ("tolerance", "within", "beyond", "said"),
    [
        (Tolerance("elbow", position=0.1), state(5.0, 0.09), state(5.0, -0.11), "elbow within 0.1 rad"),
        (Tolerance("neck", velocity=0.1), state(5.0, 5.0, 0.09), state(0.0, 0.0, 0.2), "velocity of neck"),
    ],
)
def test_a_joint_beyond_its_path_tolerance_is_named_with_its_error(tolerance, within, beyond, said):
    watch = monitor(path=[tolerance])
    assert watch.step(state(0.0, 0.0), within, 0.0, ended=False) is None
    verdict = watch.step(state(0.0, 0.0), beyond, 0.0, ended=False)
    assert verdict.code is ResultCode.PATH_TOLERANCE_VIOLATED
    assert said in verdict.sentence


def test_a_joint_may_come_late_to_its_goal_by_the_goal_time():
    far, near = state(0.0, 0.2), state(0.0, 0.05)
    watch = monitor(goal=[Tolerance("elbow", position=0.1)], goal_time=0.5)
    assert watch.step(state(0.0, 0.0), far, 10.0, ended=True) is None
    assert watch.step(state(0.0, 0.0), near, 10.4, ended=True).code is ResultCode.SUCCESSFUL
    late = monitor(goal=[Tolerance("elbow", position=0.1)], goal_time=0.5)
    assert late.step(state(0.0, 0.0), far, 10.0, ended=True) is None
    assert late.step(state(0.0, 0.0), far, 10.6, ended=True).code is ResultCode.GOAL_TOLERANCE_VIOLATED


def test_a_goal_time_of_0_waits_for_as_long_as_it_takes():
    watch = monitor(goal=[Tolerance("elbow", position=0.1)])
    for time in (0.0, 1e6):
        assert watch.step(state(0.0, 0.0), state(0.0, 0.2), time, ended=True) is None


def test_minus_one_and_0_leave_a_joint_free():
    watch = monitor(goal=[Tolerance("elbow", position=-1.0), Tolerance("neck")])
    assert watch.step(state(0.0, 0.0), state(5.0, 5.0), 0.0, ended=True).code is ResultCode.SUCCESSFUL


@pytest.mark.parametrize(
    ("tolerance", "goal_time"),
    [
        (Tolerance("knee", position=0.1), 0.0),
        (Tolerance("neck", position=-2.0), 0.0),
        (Tolerance("neck", velocity=float("nan")), 0.0),
        (Tolerance("neck", acceleration=1.0), 0.0),
        (Tolerance("neck"), -1.0),
    ],
)
def test_tolerances_that_make_no_sense_are_refused(tolerance, goal_time):
    with pytest.raises(TrajectoryError) as refusal:
        monitor(path=[tolerance], goal_time=goal_time)
    assert refusal.value.code == "bad_tolerance"


def test_every_refusal_has_a_result_code():
    codes = {refusal: result_code(refusal) for refusal in Refusal}
    assert codes[Refusal.UNKNOWN_JOINT] is ResultCode.INVALID_JOINTS
    assert codes[Refusal.ENDS_IN_THE_PAST] is ResultCode.OLD_HEADER_TIMESTAMP
    assert codes[Refusal.POSITION_LIMIT] is ResultCode.INVALID_GOAL
