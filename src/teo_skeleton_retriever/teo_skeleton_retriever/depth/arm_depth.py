# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Depths of an arm's joints, from measured depths and the lengths of the limbs.

What is seen at a keypoint is either the arm itself, or something nearer that hides it. Which of the two, for
elbow and wrist, follows from the lengths of the limbs: every combination is solved with the fast limb solver,
balanced, and the likeliest is taken, among those that an elbow can bend to.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.depth.limb_solver import FastLimbSolver, LimbChain

# [rad] How far an elbow bends, from straight. Source: AAOS, "Joint Motion: Method of Measuring and Recording"
# (1965).
MAX_FLEXION = math.radians(150.0)
_FLEXION_SIGMA = 0.05  # of the cosine between the limbs: 5 deg there, goniometers and keypoints are no better
_REACH = 0.35  # [m] how far behind what hides it a joint may be: a forearm and half a hand
_TIGHT = 2.0  # [sigma] to either side of a measured depth that the solver may use
_HIDING = 6.0  # what it costs to suppose that a joint is hidden: as much as lengths off by 2.4 sigma
_BEHIND_SIGMA = 0.12  # [m] and how far behind what hides it: a hand or an arm lies on what it hides
_FREE = 9.0  # beyond it an expectation does not speak against a depth any more: arms move fast
_ACCEPTED = 6.0  # a cost below it is no reason to suppose anything: 95 % of unhidden arms (chi-squared, 2)
# Of Gauss-Newton. Elbows may be seen far off along the upper arm: after 2 steps those of known takes were
# 36 mm off the truth, after 3 as after 8 steps 30 mm.
_STEPS = 3
_GUESSED = 2.0  # errors over sigma of hidden joints, on rendered people: the lengths are estimates, too
_HIDDEN_ACROSS = 2.5  # a detector guesses hidden joints so many times worse


class Arm(NamedTuple):
    """What one image shows of an arm: shoulder, elbow, wrist."""

    rays: FloatArray
    """x/z, y/z. Shape (3, 2)"""
    across: FloatArray
    """standard deviations of the joints across the ray [m]. Shape (3,)"""
    elbow_along: float | FloatArray
    """standard deviation of the elbow along the upper arm, in the image [m]; as far as `across` or more"""
    measured: FloatArray
    """depths if nothing hides the joints [m]; NaN where nothing was measured. Shape (3,)"""
    sigma: FloatArray
    """their standard deviations [m]; NaN likewise. Shape (3,)"""
    certain: BoolArray
    """joints that are surely not hidden: a wrist whose hand was measured. Shape (3,)"""
    expected: FloatArray
    """depths by the images before [m]; NaN where there were none. Shape (3,)"""
    expected_sigma: FloatArray
    """their standard deviations [m]. Shape (3,)"""
    lengths: FloatArray
    """of upper arm and forearm [m]. Shape (2,)"""
    length_sigma: FloatArray
    """their standard deviations [m]. Shape (2,)"""


class ArmSolution(NamedTuple):
    """Where an arm was put."""

    points: FloatArray
    """[m]. Shape (3, 3)"""
    sigma: FloatArray
    """standard deviations across the ray and along the optical axis [m]. Shape (3, 2)"""
    hidden: BoolArray
    """joints whose depth follows from the lengths, not from what is seen there. Shape (3,)"""
    cost: float
    """how unlikely it is: about the sum of two squared standard normal variables if all is well"""


class _Candidate(NamedTuple):
    arm: Arm
    depths: FloatArray
    hidden: BoolArray


class ArmSolver:
    """Solves arms. Not safe to share between threads, as the limb solver."""

    def __init__(self) -> None:
        self._solver = FastLimbSolver(joints=3)

    def solve(self, arms: Sequence[Arm]) -> list[ArmSolution | None]:
        """Find each arm's solution of least cost; None if its shoulder has no depth or none converges.

        All arms together, as most of the time goes into calls, not into numbers.
        """
        known = [
            i for i, arm in enumerate(arms) if math.isfinite(_shoulder(arm)) and np.isfinite(arm.rays).all()
        ]
        plain = [i for i in known if np.isfinite(arms[i].measured).all()]
        seen = _balanced([_Candidate(arms[i], arms[i].measured, np.zeros(3, dtype=bool)) for i in plain])
        found = {i: solution for i, solution in zip(plain, seen, strict=True) if solution.cost <= _ACCEPTED}
        others = [(i, candidate) for i in known if i not in found for candidate in self._candidates(arms[i])]
        for (i, _), solution in zip(others, _balanced([candidate for _, candidate in others]), strict=True):
            if i not in found or solution.cost < found[i].cost:
                found[i] = solution
        return [found.get(i) for i in range(len(arms))]

    def _candidates(self, arm: Arm) -> list[_Candidate]:
        seen = np.isfinite(arm.measured)
        candidates = []
        for elbow_hidden, wrist_hidden in product((False, True), repeat=2):
            hidden = np.array([not seen[0], elbow_hidden, wrist_hidden])
            if (seen | hidden).all() and not (hidden & arm.certain).any():
                solutions = self._solutions(arm, hidden, _shoulder(arm))
                candidates += [_Candidate(arm, depths, hidden) for depths in solutions]
        return candidates

    def _solutions(self, arm: Arm, hidden: BoolArray, shoulder: float) -> list[FloatArray]:
        """Solve for each combination of the bounds of hidden joints. Shapes (3,) [m]."""
        if not hidden.any():
            return [arm.measured]
        boxes: list[list[tuple[float, float]]] = []
        for i in range(3):
            if not hidden[i]:
                middle, half = float(arm.measured[i]), _TIGHT * float(arm.sigma[i])
                boxes.append([(middle - half, middle + half)])
            elif i == 0:
                half = _TIGHT * float(arm.expected_sigma[0])
                boxes.append([(shoulder - half, shoulder + half)])
            else:
                boxes.append(_halves(arm, i, hidden, shoulder))
        found = []
        for box in product(*boxes):
            lower, upper = (np.array(bounds) for bounds in zip(*box, strict=True))
            if not ((lower > 0.0) & (upper - lower > 1e-4)).all():
                continue
            start = np.where(hidden & np.isfinite(arm.expected), arm.expected, (lower + upper) / 2.0)
            start = np.clip(start, lower, upper)
            chain = LimbChain(rays=arm.rays, lengths=arm.lengths, start=start, lower=lower, upper=upper)
            solution = self._solver.solve(chain)
            if solution.converged:
                found.append(solution.depths)
        return found


def _halves(arm: Arm, i: int, hidden: BoolArray, shoulder: float) -> list[tuple[float, float]]:
    """Depth bounds of a hidden joint [m], a pair for each of its two possible solutions.

    The two places on its ray at the limb's length lie before and behind the one closest to the neighbour.
    """
    before = shoulder if i == 1 else float(arm.expected[1] if hidden[1] else arm.measured[1])
    if not math.isfinite(before):
        before = shoulder
    own, other = np.append(arm.rays[i], 1.0), np.append(arm.rays[i - 1], 1.0)
    closest = before * float(own @ other) / float(own @ own)
    # Hidden is only what lies behind what is seen.
    nearest = float(arm.measured[i]) if np.isfinite(arm.measured[i]) else closest - _REACH
    farthest = max(nearest, closest) + _REACH
    if nearest >= closest:
        return [(nearest, farthest)]
    return [(nearest, closest), (closest, farthest)]


def _shoulder(arm: Arm) -> float:
    return float(arm.measured[0] if np.isfinite(arm.measured[0]) else arm.expected[0])


def _balanced(candidates: Sequence[_Candidate]) -> list[ArmSolution]:
    """Refine each candidate by least squares over lengths, rays and depths.

    Gauss-Newton steps on the misfits over their sigmas, of all candidates at once. Unknown are the places in
    space: a keypoint is off its joint across the ray, too, and known lengths put that right.
    """
    if not candidates:
        return []
    k = len(candidates)
    hidden = np.stack([candidate.hidden for candidate in candidates])
    arm = Arm(*(np.array(values) for values in zip(*(c.arm for c in candidates), strict=True)))
    points = np.concatenate([arm.rays, np.ones((k, 3, 1))], axis=2)
    points *= np.stack([candidate.depths for candidate in candidates])[..., None]
    target = np.where(hidden, points[..., 2], arm.measured)
    depth_weight = np.where(hidden, 1.0 / _BEHIND_SIGMA, 1.0 / arm.sigma)
    across = _across_weights(arm, hidden)
    slope = np.zeros((k, 11, 9))
    for i in range(3):
        slope[:, 3 * i : 3 * i + 2, 3 * i : 3 * i + 2] = across[:, i]
        slope[:, 3 * i : 3 * i + 2, 3 * i + 2] = -(across[:, i] @ arm.rays[:, i, :, None])[..., 0]
        slope[:, 3 * i + 2, 3 * i + 2] = depth_weight[:, i]
    missed = np.zeros((k, 11))
    for step in range(_STEPS + 1):
        limbs = points[:, 1:] - points[:, :-1]
        lengths = np.sqrt((limbs**2).sum(axis=2))
        unit = limbs / (lengths * arm.length_sigma)[..., None]
        slope[:, 9, 0:3], slope[:, 9, 3:6] = -unit[:, 0], unit[:, 0]
        slope[:, 10, 3:6], slope[:, 10, 6:9] = -unit[:, 1], unit[:, 1]
        off = points[..., :2] - arm.rays * points[..., 2:]
        missed[:, :9].reshape(k, 3, 3)[..., :2] = (across @ off[..., None])[..., 0]
        missed[:, 2:9:3] = (points[..., 2] - target) * depth_weight
        missed[:, 9:] = (lengths - arm.lengths) / arm.length_sigma
        turned = slope.transpose(0, 2, 1)
        normal = turned @ slope
        if step < _STEPS:
            points = points - np.linalg.solve(normal, turned @ missed[..., None]).reshape(k, 3, 3)
    cost = (missed**2).sum(axis=1) + _penalties(arm, points, hidden, limbs, lengths)
    spread = np.sqrt(np.linalg.inv(normal)[:, np.arange(9), np.arange(9)]).reshape(k, 3, 3)
    sigma = np.stack([spread[..., :2].mean(axis=2), spread[..., 2]], axis=2)
    sigma[hidden] *= _GUESSED
    return [ArmSolution(points[i], sigma[i], hidden[i], float(cost[i])) for i in range(k)]


def _across_weights(arms: Arm, hidden: BoolArray) -> FloatArray:
    """Inverse standard deviations across the ray, by which x and y are weighed [1/m]. Shape (k, 3, 2, 2).

    The elbow's differ along the upper arm, as the image shows it, and beside it.

    Args:
        arms: Of k candidates, each field with one axis more.
        hidden: Shape (k, 3).
    """
    plain = 1.0 / (arms.across * np.where(hidden, _HIDDEN_ACROSS, 1.0))
    weights = np.eye(2) * plain[..., None, None]
    upper_arm = arms.rays[:, 1] - arms.rays[:, 0]
    squared = np.maximum((upper_arm**2).sum(axis=1), 1e-12)
    lessened = plain[:, 1] * (1.0 - np.minimum(1.0, arms.across[:, 1] / arms.elbow_along)) / squared
    weights[:, 1] -= lessened[:, None, None] * upper_arm[:, :, None] * upper_arm[:, None, :]
    return weights


def _penalties(
    arms: Arm, points: FloatArray, hidden: BoolArray, limbs: FloatArray, lengths: FloatArray
) -> FloatArray:
    """Cost of each candidate beside its misfits: priors on elbow and movement. Shape (k,)."""
    folded = -(limbs[:, 0] * limbs[:, 1]).sum(axis=1) / np.maximum(lengths[:, 0] * lengths[:, 1], 1e-9)
    beyond = np.maximum(folded - math.cos(math.pi - MAX_FLEXION), 0.0)
    cost = (beyond / _FLEXION_SIGMA) ** 2
    cost += _HIDING * hidden[:, 1:].sum(axis=1)
    with np.errstate(invalid="ignore"):
        behind = ((points[..., 2] - arms.measured) / _BEHIND_SIGMA) ** 2
        surprise = ((points[..., 2] - arms.expected) / arms.expected_sigma) ** 2
    behind[np.isnan(behind)] = 0.0
    surprise[np.isnan(surprise)] = 0.0
    cost += np.where(hidden, behind, 0.0).sum(axis=1)
    cost += (surprise * _FREE / (surprise + _FREE))[:, 1:].sum(axis=1)
    total: FloatArray = cost
    return total
