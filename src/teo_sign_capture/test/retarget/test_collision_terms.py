# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_names import HEAD, TRUNK
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics
from teo_sign_capture.retarget.arm_residuals import Quadratic
from teo_sign_capture.retarget.collision_terms import WANTED, WATCHED, CollisionModel, CollisionTerms

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


def test_only_what_is_too_near_costs():
    terms = CollisionTerms(
        frames=np.array([0, 1]),
        shares=np.zeros(2),
        distances=np.array([WANTED - 0.01, WANTED + 0.01]),
        slopes=np.ones((2, 12)) * 0.1,
        positions=np.zeros((2, 12)),
    )
    nothing = Quadratic(np.zeros(2), np.zeros((2, 12)), np.zeros((2, 12, 12)))
    cost = terms.added(nothing, np.zeros((2, 12)))
    assert cost.cost[0] > 0.0
    assert cost.cost[1] == 0.0
    assert (cost.gradient[0] < 0.0).all()  # the joints that take it away pay off
    off = terms.added(nothing, np.full((2, 12), 0.01))
    assert off.cost[0] == pytest.approx(0.0, abs=1e-12)


def test_arms_that_hang_are_near_to_nothing_that_matters(model):
    hanging = np.tile(np.radians([0.0, -30.0, 0.0, -20.0, 0.0, 0.0] * 2), (2, 1))
    terms = model.terms(np.array([0, 1]), hanging)
    assert not len(terms.frames)
    assert terms.slopes.shape == (0, 12)


def test_what_touches_on_a_way_between_frames_moves_the_frames_before_and_after():
    random = np.random.default_rng(1)
    terms = CollisionTerms(
        frames=np.array([0, 1, 1, 2]),
        shares=np.array([0.0, 0.25, 0.5, 0.0]),
        distances=np.full(4, WANTED - 0.02),
        slopes=random.normal(0.0, 0.1, (4, 6)),
        positions=np.zeros((4, 6)),
    )
    nothing = Quadratic(np.zeros(3), np.zeros((3, 6)), np.zeros((3, 6, 6)))

    def cost(rows):
        return terms.added(nothing, rows.reshape(3, 6)).cost.sum()

    # The price is a sum of squares of what is linear: differences of it are exact.
    rows, step = random.normal(0.0, 1e-3, 18), 1e-4
    here = terms.added(nothing, rows.reshape(3, 6))
    bends = np.zeros((18, 18))
    for one in range(18):
        ahead, behind = (rows + sign * step * np.eye(18)[one] for sign in (1.0, -1.0))
        assert here.gradient.ravel()[one] == pytest.approx(
            (cost(ahead) - cost(behind)) / (2.0 * step), abs=1e-6
        )
        for other in range(18):
            turn = step * np.eye(18)[other]
            bends[one, other] = (
                cost(ahead + turn) - cost(ahead - turn) - cost(behind + turn) + cost(behind - turn)
            ) / (4.0 * step**2)
    told = np.zeros((3, 6, 3, 6))
    for frame in range(3):
        told[frame, :, frame] = here.curvature[frame]
    for frame in range(2):
        told[frame, :, frame + 1] = here.coupling[frame]
        told[frame + 1, :, frame] = here.coupling[frame].T
    assert told.reshape(18, 18) == pytest.approx(bends, abs=1e-3)


def test_a_posture_on_the_way_is_between_those_of_the_frames(model):
    arms = np.stack([NEAR, NEAR + 0.1])
    first, middle, second = (model.pose(0, NEAR + 0.1 * share, share) for share in (0.0, 0.5, 1.0))
    assert middle == pytest.approx({joint: (first[joint] + second[joint]) / 2.0 for joint in first})
    terms = model.terms(np.array([0]), arms, np.array([0.5]))
    assert terms.distances.min() == pytest.approx(model.clearance(0, NEAR + 0.05, 0.5).distance, abs=1e-6)


def test_the_way_of_the_hands_is_no_shorter_than_that_of_their_knuckles(model):
    arms = NEAR + np.random.default_rng(2).uniform(-0.2, 0.2, (2, 12))
    robot = Robot.load()
    ends = [robot.configuration(model.pose(frame, arms[frame])) for frame in (0, 1)]
    moved = 0.0
    for side in ("Right", "Left"):
        places = [robot.placement(q, f"{side}MiddleFinger_link")[:3, 3] for q in ends]
        moved += float(np.linalg.norm(places[1] - places[0]))
    assert moved < model.ways(arms)[0] < 1.5 * moved
