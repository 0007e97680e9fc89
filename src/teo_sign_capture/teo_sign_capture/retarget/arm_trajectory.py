# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures and motions of the arms that come nearest to what is wanted.

What is wanted of a hand has several nearest arms: six joints reach a pose of the hand in few ways, and fall
short of one in as many; seven reach one in as many families. `search_arms` seeks single postures: Newton's
method with Gauss and Newton's curvature, projected onto the bounds (Bertsekas, SIAM J. Control 1982), runs
from all starts of all postures together. It serves captured motions, sign scores, letters and numbers.

`solve_arms` finds a motion as one whole. Each arm is sought by itself in every third frame, and of what is
found the cheapest path through time is taken (Viterbi). Then all frames and both arms are solved together,
with a price on speed that ties the frames to each other, by the same method: a frame's joints are coupled
only to the next frame's, so that a step costs one banded Cholesky decomposition.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from teo_common.arrays import Array
from teo_common.dynamic_programming import cheapest_path
from teo_sign_capture.retarget.arm_kinematics import Bounds
from teo_sign_capture.retarget.arm_residuals import ArmProblem, Quadratic
from teo_sign_capture.retarget.collision_terms import CollisionTerms

# A joint so near to its bound is at it [rad].
_ON_BOUND = 1e-9
# Steps after which the search for a posture that nothing refines ends, and the step that ends it [rad].
_POSTURE_STEPS, _POSTURE_ENOUGH = 40, 1e-6
# Added to the curvature at first, and its factors after a step that helps and one that does not; a posture
# whose damping grows beyond the last has no step that helps.
_POSTURE_DAMPING, _BETTER, _WORSE, _MOST = 1e-2, 0.3, 8.0, 1e8


def search_arms(
    problem: ArmProblem,
    hand: int,
    frames: NDArray[np.intp],
    bounds: Bounds,
    *,
    starts: Array,
    steps: int = _POSTURE_STEPS,
) -> tuple[Array, Array]:
    """Find the postures at which the search ends, from each start for each frame.

    Args:
        problem: What is wanted.
        hand: Which of its hands.
        frames: Frames of the problem. Shape (n,).
        bounds: Lower and upper bounds of the arm [rad]. Shapes (j,).
        starts: Where the search begins [rad], as of `search_starts`. Shape (s, j).
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
    damping, active = np.full(count, _POSTURE_DAMPING), np.arange(count)
    for _ in range(steps):
        at, slope = positions[active], gradient[active]
        free = _free(at, slope, lower, upper)
        bent = curvature[active] * (free[:, :, None] & free[:, None])
        bent[:, every, every] += np.where(free, damping[active, None], 1.0)
        step = np.linalg.solve(bent, np.where(free, -slope, 0.0)[..., None])[..., 0]
        moved = np.clip(at + step, lower, upper)
        there = problem.of_hand(hand, moved, where[active])
        better = there.cost < cost[active]
        done = np.abs(moved - at).max(axis=1) < _POSTURE_ENOUGH
        taken = active[better]
        positions[taken], cost[taken] = moved[better], there.cost[better]
        gradient[taken], curvature[taken] = there.gradient[better], there.curvature[better]
        damping[active] *= np.where(better, _BETTER, _WORSE)
        active = active[~done & (damping[active] < _MOST)]
        if not active.size:
            break
    return positions.reshape(len(frames), len(starts), joints), cost.reshape(len(frames), len(starts))


def _free(positions: Array, gradient: Array, lower: Array, upper: Array) -> NDArray[np.bool_]:
    """Which joints do not stand on a bound that they are drawn to. Shape (n, j)."""
    held = (positions <= lower + _ON_BOUND) & (gradient > 0.0)
    held |= (positions >= upper - _ON_BOUND) & (gradient < 0.0)
    free: NDArray[np.bool_] = ~held
    return free


# [s] From one frame to the next that is sought from all starts: valleys change slower than hands move.
_EVERY = 0.1
# The search from all starts ends after so many steps: what follows refines what it finds.
_SEARCH_STEPS = 12
# [1/rad^2] Price of the way from one of these frames to the next: to change the valley, 2 rad away, costs as
# much as a palm turned by 60 deg for 0.4 s; at 50 deg/s TEO takes 2 s for it.
_JUMP = 0.5
# [s] A way from valley to valley begins and ends so much before and after in all.
_SPREAD = 0.15
# [s] Price of speed: over a joint that moves the hand as much as the shoulder does it smooths over half of
# this, less than a frame of a camera, so that a beat of 3 Hz keeps nine tenths of its height; over one that
# hardly matters it smooths more.
_SPEED = 0.04
# [rad/s] A person's wrist at its fastest, 2 m/s, 0.25 m from the elbow: no joint need turn faster, which is
# 15 deg from one of 30 images a second to the next.
_SWIFT = np.radians(450.0)
# [1/rad^2] What is beyond this from frame to frame costs, to the square: 15 deg too much as a palm turned by
# 70 deg, so that an arm that changes the valley takes some frames for it.
_HASTE = 20.0
# The search ends after so many steps, or when no joint moves by this any more [rad].
_STEPS, _ENOUGH = 40, 1e-4
# Most steps and least step [rad] with collision terms, which are measured anew after it: their slopes are
# wrong by more.
_STEPS_OFF, _ENOUGH_OFF = 20, 3e-4
# At least this is added to the curvature, so that a step exists where a joint has no say.
_DAMPING = 1e-4
# Ten times what the price of collisions bends the sum by: where no smaller step helps, none does.
_MOST_DAMPING = 1e6
# [rad] How far from where a distance was measured its slope is believed.
TRUSTED = np.radians(12.0)


def solve_arms(problem: ArmProblem, times: Array, bounds: list[Bounds], starts: Array) -> Array:
    """Find the joints of one arm or two over a motion, as if nothing could touch.

    Args:
        problem: What is wanted.
        times: [s]. Shape (T,).
        bounds: Lower and upper bounds of each arm [rad]. Shapes (j,).
        starts: Where the search begins [rad]. Shape (s, j).

    Returns:
        Shape (T, j or 2 j) [rad].
    """
    frames = _searched_frames(times)
    arms = []
    for hand, arm_bounds in enumerate(bounds):
        found, cost = search_arms(problem, hand, frames, arm_bounds, starts=starts, steps=_SEARCH_STEPS)
        farthest = _SWIFT * (np.diff(times[frames]) + _SPREAD)
        lasting = np.gradient(times[frames]) / _EVERY if len(frames) > 1 else np.ones(1)
        chosen = cheapest_path(cost * lasting[:, None], found, _JUMP, farthest=farthest, haste=_HASTE)
        path = found[np.arange(len(found)), chosen]
        arms.append(np.stack([np.interp(times, times[frames], joint) for joint in path.T], axis=1))
    return refine_arms(problem, times, bounds, np.concatenate(arms, axis=1))


def _searched_frames(times: Array) -> NDArray[np.intp]:
    """Frames that are sought from all starts, the first and the last among them."""
    steps = np.arange(0.0, times[-1] - times[0], _EVERY)
    found: NDArray[np.intp] = np.unique(np.append(np.searchsorted(times - times[0], steps), len(times) - 1))
    return found


def refine_arms(
    problem: ArmProblem,
    times: Array,
    bounds: list[Bounds],
    start: Array,
    *,
    terms: CollisionTerms | None = None,
    shares: Array | None = None,
    trusted: float | Array = TRUSTED,
    held: NDArray[np.bool_] | None = None,
) -> Array:
    """Find the joints nearest to a motion at which what is wanted, speed and collisions cost least.

    Args:
        problem: What is wanted.
        times: [s]. Shape (T,).
        bounds: Of each arm [rad]. Shapes (j,).
        start: Shape (T, j or 2 j) [rad].
        terms: What must not touch; None if nothing can.
        shares: What is wanted counts by so much in each frame, 0 to 1; None if it counts in full. Shape (T,).
        trusted: With collision terms, how far from the start each joint may go [rad]; one for all, or shape
            (T, 1).
        held: Frames that stay as they are; None if all may move. Shape (T,).
    """
    lower, upper = (np.concatenate([arm[end] for arm in bounds]) for end in (0, 1))
    if terms is not None:
        lower, upper = np.maximum(lower, start - trusted), np.minimum(upper, start + trusted)
    if held is not None:
        lower, upper = (np.where(held[:, None], start, end) for end in (lower, upper))
    prices, farthest = _speed_prices(times), _SWIFT * np.diff(times)[:, None]

    def worth(positions: Array) -> tuple[Quadratic, float]:
        here = problem.whole(positions)
        if shares is not None:
            here = Quadratic(
                here.cost * shares, here.gradient * shares[:, None], here.curvature * shares[:, None, None]
            )
        if terms is not None:
            here = terms.added(here, positions)
        steps = np.diff(positions, axis=0)
        hasty = np.maximum(np.abs(steps) - farthest, 0.0)
        speed = 0.5 * float((prices * steps**2 + _HASTE * hasty**2).sum())
        return here, float(here.cost.sum()) + speed

    positions = np.clip(start, lower, upper)
    here, cost = worth(positions)
    damping = _DAMPING
    steps, enough = (_STEPS, _ENOUGH) if terms is None else (_STEPS_OFF, _ENOUGH_OFF)
    for _ in range(steps):
        step = _newton_step(here, positions, prices, farthest, lower, upper, damping)
        moved = np.clip(positions + step, lower, upper)
        there, lower_cost = worth(moved)
        if lower_cost > cost:
            damping *= 10.0
            if damping > _MOST_DAMPING:
                break
            continue
        way = float(np.abs(moved - positions).max())
        positions, here, cost = moved, there, lower_cost
        damping = max(damping * 0.3, _DAMPING)
        if way < enough:
            break
    return positions


def _speed_prices(times: Array) -> Array:
    """Price of the square of each step from frame to frame [1/rad^2]. Shape (T - 1, 1)."""
    if len(times) < 2:
        return np.empty((0, 1))
    steps = np.diff(times)[:, None]
    prices: Array = _SPEED**2 / (steps * np.median(steps))
    return prices


def _newton_step(
    here: Quadratic,
    positions: Array,
    prices: Array,
    farthest: Array,
    lower: Array,
    upper: Array,
    damping: float,
) -> Array:
    count, size = positions.shape
    gradient = here.gradient.copy()
    steps = np.diff(positions, axis=0)
    hasty = np.abs(steps) > farthest
    pull = prices * steps + _HASTE * hasty * (steps - np.sign(steps) * farthest)
    prices = prices + _HASTE * hasty
    gradient[:-1] -= pull
    gradient[1:] += pull
    free = _free(positions, gradient, lower, upper)
    curvature = here.curvature * (free[:, :, None] & free[:, None])
    diagonal = np.full((count, size), damping)
    diagonal[:-1] += prices
    diagonal[1:] += prices
    curvature[:, np.arange(size), np.arange(size)] += np.where(free, diagonal, 1.0)
    # Upper form of a symmetric band matrix: row `width - k` holds what is k columns right of the diagonal.
    width = size if here.coupling is None else 2 * size - 1
    band = np.zeros((width + 1, count * size))
    for row in range(size):
        for column in range(row, size):
            band[width - (column - row), column::size] = curvature[:, row, column]
    if here.coupling is not None:
        coupling = here.coupling[:-1] * (free[:-1, :, None] & free[1:, None])
        for row in range(size):
            for column in range(size):
                band[width - (size + column - row), size + column :: size] = coupling[:, row, column]
    if count > 1:
        band[width - size, size:] -= np.where(free[:-1] & free[1:], prices, 0.0).ravel()
    step: Array = solveh_banded(band, np.where(free, -gradient, 0.0).ravel(), check_finite=False)
    return step.reshape(count, size)
