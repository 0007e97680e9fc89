# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from refusals import refused
from robot_person import goals_of

from teo_description.humanoid import load_humanoid
from teo_description.robot import Robot
from teo_names import HEAD, TRUNK
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics, arm_bounds
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.collision_clearing import clear_arms
from teo_sign_capture.retarget.collision_terms import LEAST, WATCHED, CollisionModel

# Both hands before the chest, near it and each other [deg], the left one as in a mirror.
NEAR = np.radians([-29.0, -2.0, 54.0, -61.0, 0.0, 10.0, -25.0, 0.0, 50.0, -72.0, -25.0, 11.0])
HAND = np.tile(np.radians([45.0, -15.0, 40.0, 40.0, 40.0, 40.0]), (2, 1))


@pytest.fixture(scope="module")
def model():
    robot = Robot.load()
    others = dict(zip(HEAD + TRUNK, np.radians([[20.0] * 2, [5.0] * 2, [15.0] * 2, [12.0] * 2]), strict=True))
    return CollisionModel(robot, ArmKinematics(robot), ("right", "left"), (HAND, HAND), others)


def test_slopes_say_how_each_distance_changes(model):
    def all_pairs(arm):
        return model.terms(np.array([0]), np.stack([arm, NEAR]), np.zeros(1), within=10.0)

    terms = all_pairs(NEAR)
    assert terms.distances.min() == pytest.approx(model.clearance(0, NEAR).distance, abs=1e-6)
    near = terms.distances < WATCHED
    assert near.sum() > 3
    step = 1e-3
    # Each joint of the right arm with one of the left one, so that either would be seen to be wrong.
    for ways in np.eye(6):
        turn = np.concatenate([ways, 0.7 * np.roll(ways, 1)])
        ahead, behind = all_pairs(NEAR + step * turn), all_pairs(NEAR - step * turn)
        slopes = (ahead.distances - behind.distances) / (2.0 * step)
        assert (terms.slopes @ turn)[near] == pytest.approx(slopes[near], abs=0.01)


FRAMES = 12
TIMES = np.arange(FRAMES) / 15.0
BOUNDS = [arm_bounds(load_humanoid(), "right")]
# From before the chest into the belly and back [deg].
OFF, INSIDE = np.radians([(-45.0, -12.0, 10.0, -80.0, 20.0, 0.0), (20.0, 0.0, 52.0, -98.0, 0.0, 0.0)])
SHARE = np.sin(np.pi * np.arange(FRAMES) / (FRAMES - 1.0))[:, None]
ARMS = OFF + SHARE * (INSIDE - OFF)


@pytest.fixture(scope="module")
def wanted(robot):
    """A problem that wants the hand to go into the belly, and the robot."""
    chain = ArmKinematics(robot)
    hand = np.tile(np.radians([10.0, -60.0, 7.0, 7.0, 7.0, 7.0]), (FRAMES, 1))
    problem = ArmProblem(chain, (goals_of(chain, ARMS),), None)
    return problem, CollisionModel(robot, chain, ("right",), (hand,), {})


def test_a_hand_is_moved_off_the_body_no_farther_than_it_must(wanted):
    problem, model = wanted
    assert min(model.clearance(frame, ARMS[frame]).distance for frame in range(FRAMES)) < -0.02
    arms, distances = clear_arms(problem, model, TIMES, BOUNDS, ARMS, source="belly")
    assert distances.min() >= LEAST
    measured = [model.clearance(frame, arms[frame]).distance for frame in range(FRAMES)]
    assert distances == pytest.approx(np.array(measured), abs=2e-4)
    # What was free stays where it was; what was not is near the body still.
    assert np.degrees(np.abs(arms[0] - ARMS[0])).max() < 5.0
    assert distances[FRAMES // 2] < 0.05


def test_arms_that_touch_nothing_stay_as_they_are(wanted):
    problem, model = wanted
    free = np.tile(OFF, (FRAMES, 1))
    arms, _ = clear_arms(problem, model, TIMES, BOUNDS, free, source="belly")
    assert arms is free


def test_a_posture_without_a_way_out_is_refused_with_its_time_and_parts(wanted):
    problem, model = wanted
    stuck = np.tile(INSIDE, (FRAMES, 1))
    held = (INSIDE - 1e-6, INSIDE + 1e-6)
    with refused("self_collision", r"belly: .* at 0\.\d\d s, .*Right.*Trunk_link"):
        clear_arms(problem, model, TIMES, [held], stuck, source="belly")
