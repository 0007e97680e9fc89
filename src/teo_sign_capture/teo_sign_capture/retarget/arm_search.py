# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Single postures of an arm, each sought from every start at once.

What is wanted of a hand has several nearest arms: six joints reach a pose of the hand in few ways, and fall
short of one in as many; seven reach one in as many families. Newton's method with Gauss and Newton's
curvature, projected onto the bounds (Bertsekas, SIAM J. Control 1982), runs from all starts of all postures
together. This one search serves captured motions, sign scores, letters and numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_capture.retarget.arm_bounds import Bounds
from teo_sign_capture.retarget.arm_residuals import ArmProblem

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
    starts: Array,
    steps: int = _STEPS,
) -> tuple[Array, Array]:
    """Find the postures at which the search ends, from each start for each frame.

    Args:
        problem: What is wanted.
        hand: Which of its hands.
        frames: Frames of the problem. Shape (n,).
        bounds: Lower and upper bounds of the arm [rad]. Shapes (j,).
        starts: Where the search begins [rad], as of `arm_bounds.search_starts`. Shape (s, j).
        steps: Most steps of the search.

    Returns:
        Positions [rad], shape (n, s, j), and their costs, shape (n, s).
    """
    lower, upper = bounds
    joints = starts.shape[1]
    count, every = len(frames) * len(starts), np.arange(joints)
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
    return positions.reshape(len(frames), len(starts), joints), cost.reshape(len(frames), len(starts))
