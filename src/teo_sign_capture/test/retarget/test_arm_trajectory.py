# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from robot_person import goals_of
from scipy.optimize import minimize

from teo_description.humanoid import load_humanoid
from teo_sign_capture.retarget.arm_kinematics import arm_bounds, search_starts
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.arm_trajectory import refine_arms, solve_arms
from teo_sign_capture.retarget.collision_terms import WANTED, CollisionTerms
from teo_sign_capture.retarget.hand_goals import PairGoals
from teo_sign_capture.signing_space import MIRROR

TIMES = np.arange(40) / 30.0
at_palm = partial(goals_of, local=(0.05, 0.0, 0.01))
BOUNDS = [arm_bounds(load_humanoid(), "right"), arm_bounds(load_humanoid(), "left")]
STARTS = search_starts(load_humanoid())


def swing(first, last):
    """A movement of an arm between two postures [deg] and back."""
    share = 0.5 - 0.5 * np.cos(2.0 * np.pi * TIMES / TIMES[-1])
    return np.radians(first) + share[:, None] * np.radians(np.subtract(last, first))


ARMS = swing([-50, -15, 10, -80, 20, 0], [-72, 5, 20, -60, 45, 8])


def test_a_motion_that_an_arm_has_made_is_found_again(chain):
    found = solve_arms(ArmProblem(chain, (at_palm(chain, ARMS),), None), TIMES, BOUNDS[:1], STARTS)
    reached, wanted = chain.poses(found), chain.poses(ARMS)
    assert 1000.0 * np.linalg.norm(reached.place - wanted.place, axis=1).max() < 8.0
    assert np.degrees(np.abs(found - ARMS)).max() < 6.0


@pytest.mark.slow
def test_no_frame_by_frame_search_finds_anything_clearly_better(chain):
    problem = ArmProblem(chain, (at_palm(chain, ARMS, shift=(-0.15, 0.1, -0.2), contact=0.0),), None)
    found = solve_arms(problem, TIMES, BOUNDS[:1], STARTS)
    limits = list(zip(*BOUNDS[0], strict=True))
    cost = 0.0
    for frame in range(len(TIMES)):

        def value(arm, at=np.array([frame])):  # noqa: B008  a frame of its own for each search
            here = problem.of_hand(0, arm[None], at)
            return float(here.cost[0]), here.gradient[0]

        searches = [
            minimize(value, start, jac=True, bounds=limits, method="L-BFGS-B")
            for start in (found[frame], ARMS[frame])
        ]
        cost += min(search.fun for search in searches)
    # What is more is the price of going from one frame to the next.
    assert problem.whole(found).cost.sum() < 1.1 * cost


def test_in_the_air_before_the_face_a_hand_is_nearer_to_its_height_and_side(chain):
    """Where it cannot go, straight before which it stays, and its palm gives way a little."""

    def misses(at_face):
        hand = at_palm(chain, ARMS, shift=(-0.15, 0.1, -0.2), contact=0.0, at_face=at_face)
        found = solve_arms(ArmProblem(chain, (hand,), None), TIMES, BOUNDS[:1], STARTS)
        off = chain.poses(found).points(hand.local) - hand.place
        return np.linalg.norm(off[:, 1:], axis=1).max()

    assert misses(at_face=1.0) < 0.85 * misses(at_face=0.0)


def test_bounds_are_kept_where_a_hand_is_out_of_reach(chain):
    problem = ArmProblem(chain, (at_palm(chain, ARMS, shift=(0.0, 0.6, 0.8)),), None)
    found = solve_arms(problem, TIMES, BOUNDS[:1], STARTS)
    lower, upper = BOUNDS[0]
    assert (found >= lower - 1e-12).all()
    assert (found <= upper + 1e-12).all()


def test_hands_that_belong_together_stay_together(chain):
    right, left = (
        at_palm(chain, ARMS, shift=(0.0, 0.04, 0.0)),
        at_palm(chain, ARMS, shift=(0.0, 0.06, 0.03)),
    )
    way = np.tile((0.0, -0.05, 0.02), (len(TIMES), 1))
    pair = PairGoals(right=right.local, left=left.local, way=way, nearness=np.ones(len(TIMES)), order=way)
    apart, together = (
        solve_arms(ArmProblem(chain, (right, left), one), TIMES, BOUNDS, STARTS) for one in (None, pair)
    )

    def misses(arms):
        points = [chain.poses(arms[:, at : at + 6]).points(right.local) for at in (0, 6)]
        return np.linalg.norm(points[0] - points[1] * MIRROR - way, axis=1)

    assert np.median(misses(together)) < 0.6 * np.median(misses(apart))


def test_slopes_of_what_is_wanted_are_true(chain):
    rows = np.random.default_rng(0).uniform(-1.0, 0.5, (3, 12))
    goals = at_palm(chain, ARMS[:3], shift=(0.1, 0.0, -0.1), contact=0.4, at_face=0.7)
    way = goals.palm * 0.1
    nearness = np.array([0.0, 0.5, 1.0])
    pair = PairGoals(right=goals.local, left=goals.local, way=way, nearness=nearness, order=way)
    problem = ArmProblem(chain, (goals, goals), pair)
    step = 1e-6
    for joint in range(12):
        ahead, behind = (problem.whole(rows + sign * step * np.eye(12)[joint]).cost for sign in (1.0, -1.0))
        assert problem.whole(rows).gradient[:, joint] == pytest.approx(
            (ahead - behind) / (2 * step), rel=1e-9, abs=1e-4
        )


def test_an_arm_whose_goal_jumps_takes_some_frames_for_it(chain):
    arms = np.tile(ARMS[0], (len(TIMES), 1))
    arms[20:] = np.radians([-30.0, -10.0, -20.0, -80.0, 70.0, 10.0])
    jump = np.abs(np.diff(arms, axis=0)).max()
    found = solve_arms(ArmProblem(chain, (at_palm(chain, arms),), None), TIMES, BOUNDS[:1], STARTS)
    steps = np.degrees(np.abs(np.diff(found, axis=0))).max()
    assert np.degrees(jump) > 45.0
    assert steps < 20.0  # 15 deg are free, at 30 frames a second
    assert np.degrees(np.abs(found - arms)[[0, -1]]).max() < 6.0


def test_touches_on_ways_are_pushed_apart_in_one_go(chain):
    """Two frames, a distance half way that grows with the first joint of either: both give half of it."""
    problem = ArmProblem(chain, (at_palm(chain, ARMS[:2]),), None)
    start = solve_arms(problem, TIMES[:2], BOUNDS[:1], STARTS)
    terms = CollisionTerms(
        frames=np.array([0]),
        shares=np.array([0.5]),
        distances=np.array([WANTED - 0.02]),
        slopes=np.eye(1, 6) * 0.5,
        positions=start.mean(axis=0)[None],
    )
    found = refine_arms(problem, TIMES[:2], BOUNDS[:1], start, terms=terms)
    assert (found - start)[:, 0].mean() * 0.5 == pytest.approx(0.02, abs=0.002)
    assert (found - start)[0, 0] == pytest.approx((found - start)[1, 0], abs=0.01)
