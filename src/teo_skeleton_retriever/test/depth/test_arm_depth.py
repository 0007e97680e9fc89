# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from teo_skeleton_retriever.depth.arm_depth import MAX_FLEXION, Arm, ArmSolver

SHOULDER = np.array([0.17, -0.25, 1.6])
LENGTHS = np.array([0.28, 0.25])
SOLVER = ArmSolver()


def limb(azimuth: float, elevation: float, length: float) -> np.ndarray:
    """A limb of a direction: 0, 0 points at the camera; azimuth to the right, elevation down [rad]."""
    direction = [
        math.sin(azimuth) * math.cos(elevation),
        math.sin(elevation),
        -math.cos(azimuth) * math.cos(elevation),
    ]
    return length * np.array(direction)


def joints(upper: tuple[float, float], forearm: tuple[float, float]) -> np.ndarray:
    elbow = SHOULDER + limb(*upper, LENGTHS[0])
    return np.array([SHOULDER, elbow, elbow + limb(*forearm, LENGTHS[1])])


def arm(points: np.ndarray, **changes: Any) -> Arm:
    nothing = np.full(3, math.nan)
    seen = Arm(
        rays=points[:, :2] / points[:, 2:],
        across=np.array([0.005, 0.005, 0.005]),
        elbow_along=0.005,
        measured=points[:, 2].copy(),
        sigma=np.full(3, 0.008),
        certain=np.zeros(3, dtype=bool),
        expected=nothing,
        expected_sigma=nothing,
        lengths=LENGTHS,
        length_sigma=np.array([0.008, 0.008]),
    )
    return seen._replace(**changes)


HANGING = joints((0.6, 1.2), (0.3, 0.9))
SIGNING = joints((0.3, 1.3), (-0.6, -0.2))  # the forearm comes forward and in


@pytest.mark.parametrize("points", [HANGING, SIGNING])
def test_an_arm_that_is_seen_stays_where_it_is(points: np.ndarray) -> None:
    (solution,) = SOLVER.solve([arm(points)])
    assert solution is not None
    np.testing.assert_allclose(solution.points, points, atol=1e-4)
    assert not solution.hidden.any()


def test_an_elbow_that_may_be_short_along_the_upper_arm_is_put_right_along_it() -> None:
    points = joints((math.pi / 2, 0.6), (-0.2, -0.1))  # the upper arm across the view, the forearm pointing
    upper_arm = points[1] - points[0]
    short = points.copy()
    short[1] -= 0.25 * upper_arm
    rays = short[:, :2] / short[:, 2:]
    (even,) = SOLVER.solve([arm(points, rays=rays, across=np.array([0.005, 0.02, 0.005]), elbow_along=0.02)])
    (along,) = SOLVER.solve([arm(points, rays=rays, across=np.array([0.005, 0.02, 0.005]), elbow_along=0.06)])
    assert even is not None
    assert along is not None
    off = [float(np.linalg.norm(solution.points[1] - points[1])) for solution in (even, along)]
    assert off[1] < 0.7 * off[0]


def test_a_wrist_behind_the_other_arm_is_found_behind_it() -> None:
    measured = HANGING[:, 2].copy()
    measured[2] -= 0.12
    before = HANGING[:, 2] + [0.0, 0.01, -0.02]
    (solution,) = SOLVER.solve(
        [arm(HANGING, measured=measured, expected=before, expected_sigma=np.full(3, 0.05))]
    )
    assert solution is not None
    assert solution.hidden.tolist() == [False, False, True]
    assert np.linalg.norm(solution.points[2] - HANGING[2]) < 0.03


def test_a_wrist_whose_hand_was_measured_is_not_taken_for_hidden() -> None:
    measured = HANGING[:, 2].copy()
    measured[2] -= 0.12
    certain = np.array([False, False, True])
    (solution,) = SOLVER.solve([arm(HANGING, measured=measured, certain=certain)])
    assert solution is not None
    assert not solution.hidden[2]


def test_the_elbow_that_would_bend_too_far_is_not_taken() -> None:
    """Seen from the front, shoulder and wrist close together: the elbow is far behind or far in front."""
    folded = joints((0.2, 0.9), (math.pi + 0.2, 0.2))
    upper, forearm = np.diff(folded, axis=0)
    angle = math.acos(float(-upper @ forearm) / float(np.prod(LENGTHS)))
    assert math.radians(20) < math.pi - angle < MAX_FLEXION
    measured = folded[:, 2].copy()
    measured[1] = math.nan
    (solution,) = SOLVER.solve([arm(folded, measured=measured, sigma=np.array([0.008, math.nan, 0.008]))])
    assert solution is not None
    found = np.diff(solution.points, axis=0)
    cosine = float(-found[0] @ found[1]) / float(np.prod(np.linalg.norm(found, axis=1)))
    assert math.acos(cosine) > math.pi - MAX_FLEXION - math.radians(5)


def test_a_shoulder_of_unknown_depth_leaves_nothing_to_hang_an_arm_from() -> None:
    measured = SIGNING[:, 2].copy()
    measured[0] = math.nan
    assert SOLVER.solve([arm(SIGNING, measured=measured)]) == [None]


angles = st.tuples(st.floats(-1.2, 1.2), st.floats(-1.2, 1.4))


@given(angles, angles, st.floats(0.08, 0.2))
@settings(max_examples=60, deadline=None)
def test_a_hidden_elbow_is_found_where_images_before_had_it(
    upper: tuple[float, float], forearm: tuple[float, float], before_it: float
) -> None:
    points = joints(upper, forearm)
    limbs = np.diff(points, axis=0)
    assume(float(-limbs[0] @ limbs[1]) / float(np.prod(LENGTHS)) < math.cos(math.pi - MAX_FLEXION))
    measured = points[:, 2].copy()
    measured[1] -= before_it
    (solution,) = SOLVER.solve(
        [arm(points, measured=measured, expected=points[:, 2], expected_sigma=np.full(3, 0.03))]
    )
    assert solution is not None
    lengths = np.linalg.norm(np.diff(solution.points, axis=0), axis=1)
    np.testing.assert_allclose(lengths, LENGTHS, atol=0.03)
    if solution.hidden[1]:
        assert abs(solution.points[1, 2] - points[1, 2]) < 0.08
