# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_names import HEAD, TRUNK
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.collision_terms import WATCHED, CollisionModel

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
        return model.terms(np.array([0]), np.stack([arm, NEAR]), within=10.0)

    terms = all_pairs(NEAR)
    near = terms.distances < WATCHED
    assert near.sum() > 3
    step = 1e-3
    for joint, turn in enumerate(step * np.eye(12)):
        ahead, behind = all_pairs(NEAR + turn), all_pairs(NEAR - turn)
        slopes = (ahead.distances - behind.distances) / (2.0 * step)
        assert terms.slopes[near, joint] == pytest.approx(slopes[near], abs=0.01)


def test_the_nearest_of_them_is_the_clearance(model):
    arms = np.stack([NEAR, NEAR])
    assert model.terms(np.array([1]), arms).distances.min() == pytest.approx(
        model.clearance(1, NEAR).distance, abs=1e-6
    )


def test_the_way_of_the_hands_is_no_shorter_than_that_of_their_knuckles(model):
    arms = NEAR + np.random.default_rng(2).uniform(-0.2, 0.2, (2, 12))
    robot = Robot.load()
    ends = [robot.configuration(model.pose(frame, arms[frame])) for frame in (0, 1)]
    moved = 0.0
    for side in ("Right", "Left"):
        places = [robot.placement(q, f"{side}MiddleFinger_link")[:3, 3] for q in ends]
        moved += float(np.linalg.norm(places[1] - places[0]))
    assert moved < model.ways(arms)[0] < 1.5 * moved
