"""Where an arm is when the camera sees something before its elbow or wrist.

What is seen at a keypoint is either the arm itself, or something nearer that hides it. Which of the two, for
elbow and wrist, follows from the lengths of the limbs: every combination is solved with the fast limb solver
and the likeliest is taken, among those that an elbow can bend to.
"""

from __future__ import annotations

import math
from itertools import product
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.limb_chain import LimbChain
from teo_skeleton_retriever.limb_fast import FastLimbSolver

MAX_FLEXION = math.radians(150.0)
"""[rad] How far an elbow bends, from straight.
Source: AAOS, "Joint Motion: Method of Measuring and Recording" (1965)."""
_REACH = 0.45  # [m] how far behind what hides it a joint may be: a long forearm and half a hand
_TIGHT = 2.0  # [sigma] to either side of a measured depth that the solver may use
_HIDING = 8.0  # what it costs to suppose that a joint is hidden: as much as lengths off by 2.8 sigma
_FREE = 25.0  # beyond it an expectation does not speak against a depth any more: arms move fast
_ACCEPTED = 6.0  # a cost below it is no reason to suppose anything: 95 % of unhidden arms (chi-squared, 2)


class Arm(NamedTuple):
    """What one image shows of an arm: shoulder, elbow, wrist."""

    rays: FloatArray
    """x/z, y/z. Shape (3, 2)"""
    measured: FloatArray
    """depths if nothing hides the joints [m]; NaN where nothing was measured. Shape (3,)"""
    sigma: FloatArray
    """their standard deviations [m]; NaN likewise. Shape (3,)"""
    expected: FloatArray
    """depths by the images before [m]; NaN where there were none. Shape (3,)"""
    expected_sigma: FloatArray
    """their standard deviations [m]. Shape (3,)"""
    lengths: FloatArray
    """of upper arm and forearm [m]. Shape (2,)"""
    length_sigma: FloatArray
    """their standard deviations, errors of the pixels included [m]. Shape (2,)"""


class ArmSolution(NamedTuple):
    """Where an arm was put."""

    depths: FloatArray
    """[m]. Shape (3,)"""
    hidden: BoolArray
    """joints whose depth follows from the lengths, not from what is seen there. Shape (3,)"""
    cost: float
    """how unlikely it is: about the sum of two squared standard normal variables if all is well"""


class ArmSolver:
    """Solves arms. Not safe to share between threads, as the limb solver."""

    def __init__(self) -> None:
        self._solver = FastLimbSolver()

    def solve(self, arm: Arm) -> ArmSolution | None:
        """Find the likeliest depths of an arm; None if its shoulder has none, or nothing fits."""
        shoulder = arm.measured[0] if np.isfinite(arm.measured[0]) else arm.expected[0]
        if not (np.isfinite(shoulder) and np.isfinite(arm.rays).all()):
            return None
        seen = np.isfinite(arm.measured)
        if seen.all():
            cost = self._cost(arm, arm.measured, np.zeros(3, dtype=bool))
            if cost <= _ACCEPTED:
                return ArmSolution(arm.measured.copy(), np.zeros(3, dtype=bool), cost)
        best: ArmSolution | None = None
        for elbow_hidden, wrist_hidden in product((False, True), repeat=2):
            hidden = np.array([not seen[0], elbow_hidden, wrist_hidden])
            if not (seen | hidden).all():
                continue
            for depths in self._candidates(arm, hidden, float(shoulder)):
                cost = self._cost(arm, depths, hidden)
                if best is None or cost < best.cost:
                    best = ArmSolution(depths, hidden, cost)
        return best

    def _candidates(self, arm: Arm, hidden: BoolArray, shoulder: float) -> list[FloatArray]:
        """Solve with each hidden joint on either side of where its limb is shortest."""
        if not hidden[1:].any():
            return [arm.measured.copy()] if not hidden[0] else []
        found = []
        boxes = []
        for i in range(3):
            if not hidden[i]:
                half = _TIGHT * float(arm.sigma[i])
                boxes.append([(float(arm.measured[i]) - half, float(arm.measured[i]) + half)])
            elif i == 0:
                half = _TIGHT * float(arm.expected_sigma[0])
                boxes.append([(shoulder - half, shoulder + half)])
            else:
                boxes.append(self._halves(arm, i, hidden, shoulder))
        for box in product(*boxes):
            lower = np.array([low for low, _ in box])
            upper = np.array([high for _, high in box])
            if not ((lower > 0.0) & (upper - lower > 1e-4)).all():
                continue
            start = np.where(hidden & np.isfinite(arm.expected), arm.expected, (lower + upper) / 2.0)
            chain = LimbChain(
                rays=arm.rays,
                lengths=arm.lengths,
                start=np.clip(start, lower, upper),
                lower=lower,
                upper=upper,
            )
            solution = self._solver.solve(chain)
            if solution.converged:
                found.append(solution.depths)
        return found

    def _halves(self, arm: Arm, i: int, hidden: BoolArray, shoulder: float) -> list[tuple[float, float]]:
        """Give the depths of a hidden joint that are nearer and farther than closest to its neighbour."""
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

    @staticmethod
    def _cost(arm: Arm, depths: FloatArray, hidden: BoolArray) -> float:
        points = np.column_stack([arm.rays, np.ones(3)]) * depths[:, None]
        limbs = np.diff(points, axis=0)
        lengths = np.sqrt((limbs**2).sum(axis=1))
        cost = float((((lengths - arm.lengths) / arm.length_sigma) ** 2).sum())
        folded = float(
            -(limbs[0] @ limbs[1]) / max(lengths[0] * lengths[1], 1e-9)
        )  # cosine between the limbs
        beyond = max(folded - math.cos(math.pi - MAX_FLEXION), 0.0)
        cost += (
            beyond / 0.05
        ) ** 2  # 0.05 of the cosine is 5 deg there: goniometers and keypoints are no better
        for i in range(3):
            if not hidden[i]:
                cost += float((depths[i] - arm.measured[i]) / arm.sigma[i]) ** 2
            elif i > 0:
                cost += _HIDING
            if math.isfinite(arm.expected[i]):
                off = float((depths[i] - arm.expected[i]) / arm.expected_sigma[i]) ** 2
                cost += off * _FREE / (off + _FREE) if i else 0.0
        return cost
