# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Single postures of an arm, each sought from every start at once.

What is wanted of a hand has several nearest arms: TEO's six joints reach a pose of the hand in few ways, and
fall short of one in as many. Newton's method with Gauss and Newton's curvature, projected onto the bounds
(Bertsekas, SIAM J. Control 1982), runs from all starts of all postures together. This one search serves
captured motions, sign scores, letters and numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_capture.retarget.arm_bounds import Bounds
from teo_sign_capture.retarget.arm_residuals import EASY_ARM, JOINTS, ArmProblem

# [rad] Right arms that sign, one in each valley. 64 starts more, spread evenly over the bounds, find nothing
# better for any posture of the shipped scores; an arm that hangs finds nothing better for captured motions.
# Shape (8, 6).
STARTS = np.vstack(
    [
        EASY_ARM,
        np.radians(
            [
                [-74.0, 11.2, 11.1, -80.5, 48.9, 1.1],  # spelling
                [-75.0, -12.0, 45.0, -89.0, -55.0, 20.0],  # hand at the chest
                [-42.0, -74.0, 50.0, -95.0, 20.0, -20.0],  # elbow out
                [-30.0, -10.0, -20.0, -80.0, 70.0, 10.0],  # palm up
                [-55.0, -5.0, 52.0, -95.0, -56.0, 7.0],  # forearm across
                [-90.0, -20.0, 30.0, -95.0, 60.0, -30.0],  # hand at the head
                [-68.0, -9.0, 54.0, -99.0, 89.0, 44.0],  # palm to the front
            ]
        ),
    ]
)
# A joint so near to its bound is at it [rad].
ON_BOUND = 1e-9
# Steps after which the search for a posture that nothing refines ends, and the step that ends it [rad].
_STEPS, _ENOUGH = 40, 1e-6
# Added to the curvature at first, and its factors after a step that helps and one that does not; a posture
# whose damping grows beyond the last has no step that helps.
_DAMPING, _BETTER, _WORSE, _MOST = 1e-2, 0.3, 8.0, 1e8


def search_arms(
    problem: ArmProblem,
    hand: int,
    frames: NDArray[np.intp],
    bounds: Bounds,
    *,
    starts: Array = STARTS,
    steps: int = _STEPS,
) -> tuple[Array, Array]:
    """Find the postures at which the search ends, from each start for each frame.

    Args:
        problem: What is wanted.
        hand: Which of its hands.
        frames: Frames of the problem. Shape (n,).
        bounds: Lower and upper bounds of the arm [rad]. Shapes (6,).
        starts: Where the search begins [rad]. Shape (s, 6).
        steps: Most steps of the search.

    Returns:
        Positions [rad], shape (n, s, 6), and their costs, shape (n, s).
    """
    lower, upper = bounds
    count, every = len(frames) * len(starts), np.arange(JOINTS)
    where = np.repeat(frames, len(starts))
    positions = np.clip(np.tile(starts, (len(frames), 1)), lower, upper)
    here = problem.of_hand(hand, positions, where)
    cost, gradient, curvature = here.cost.copy(), here.gradient.copy(), here.curvature.copy()
    damping, active = np.full(count, _DAMPING), np.arange(count)
    for _ in range(steps):
        at, slope = positions[active], gradient[active]
        free = ~(((at <= lower + ON_BOUND) & (slope > 0.0)) | ((at >= upper - ON_BOUND) & (slope < 0.0)))
        bent = curvature[active] * (free[:, :, None] & free[:, None])
        bent[:, every, every] += np.where(free, damping[active, None], 1.0)
        step = np.linalg.solve(bent, np.where(free, -slope, 0.0)[..., None])[..., 0]
        moved = np.clip(at + step, lower, upper)
        there = problem.of_hand(hand, moved, where[active])
        better = there.cost < cost[active]
        done = np.abs(moved - at).max(axis=1) < _ENOUGH
        taken = active[better]
        positions[taken], cost[taken] = moved[better], there.cost[better]
        gradient[taken], curvature[taken] = there.gradient[better], there.curvature[better]
        damping[active] *= np.where(better, _BETTER, _WORSE)
        active = active[~done & (damping[active] < _MOST)]
        if not active.size:
            break
    return positions.reshape(len(frames), len(starts), JOINTS), cost.reshape(len(frames), len(starts))
