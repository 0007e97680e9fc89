# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depths along a limb as an optimisation problem: known lengths, fixed rays, bounded depths.

Source: `LimbOptimizer` of the original skeletonRetriever. With y_i(z) = z ray_i the depths minimise

    sum_i (|y_i - y_(i+1)|^2 - L_i^2)^2,    lower_i <= z_i <= upper_i.

It is solved by one unrolled expression, tens of times as fast as Ipopt and with the same solution: a
primal-dual interior point method on the problem divided by the mean squared length. The problem needs its
barrier: where a limb can reach its lengths it can do so at many depths, and it is the barrier that picks
one, the same that Ipopt's barrier picks. The Hessian is tridiagonal, so a step costs O(n); it is
Gauss-Newton's plus the curvature of lengths that are too long (squared distances are convex in the depths),
hence never indefinite. The number of steps is fixed, so that all of them are one CasADi function without a
loop, called through its raw buffers.
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError

_NEAREST = 0.01  # [m] no depth is bounded below this
_END_FREEDOM = 0.01  # [m] how far the first and last keypoint may move away from the camera
# [m] How far the ones between may: the sensor sees the skin, or something before the joint.
_JOINT_FREEDOM = 0.30


@dataclass(frozen=True, eq=False, kw_only=True)
class LimbChain:
    """One limb of one person in one image.

    Attributes:
        rays: x/z, y/z of each keypoint. Shape (n, 2), n >= 2.
        lengths: From each keypoint to the next [m]. Shape (n - 1,).
        start: Depths to start from [m]. Shape (n,).
        lower: Least depths [m]. Shape (n,).
        upper: Greatest depths [m]. Shape (n,).

    Raises:
        RetrieverError: Shapes that do not fit, a number that is not finite, a length not above zero or bounds
            that leave no room.
    """

    rays: FloatArray
    lengths: FloatArray
    start: FloatArray
    lower: FloatArray
    upper: FloatArray

    def __post_init__(self) -> None:
        n = len(self.rays)
        shapes = {"rays": (n, 2), "lengths": (n - 1,), "start": (n,), "lower": (n,), "upper": (n,)}
        for name, shape in shapes.items():
            array = frozen(getattr(self, name))
            if n < 2 or array.shape != shape:
                raise RetrieverError(
                    "wrong_shape", f"{name}: expected shape {shape} with n of 2 or more, got {array.shape}"
                )
            if not np.isfinite(array).all():
                raise RetrieverError("not_finite", f"{name}: expected finite numbers, got {array}")
            object.__setattr__(self, name, array)
        if not (self.lengths > 0.0).all():
            raise RetrieverError("bad_length", f"expected lengths above 0 m, got {self.lengths}")
        if not ((self.lower > 0.0) & (self.lower < self.upper)).all():
            raise RetrieverError(
                "bad_bounds", f"expected 0 < lower < upper, got {self.lower} and {self.upper}"
            )

    @classmethod
    def original(cls, points: FloatArray, lengths: FloatArray, *, anchor_depth: float) -> LimbChain:
        """Build the problem that the original solves.

        Args:
            points: Filtered keypoints from the body outwards [m]. Shape (n, 3).
            lengths: [m]. Shape (n - 1,).
            anchor_depth: Depth of the centre that the limb hangs from (shoulders or hips) [m]: the limb's
                first keypoint is put at this depth, whatever its own.
        """
        points = np.asarray(points, dtype=np.float64)
        measured = points[:, 2].copy()
        measured[0] = anchor_depth
        lower = np.maximum(measured, _NEAREST)
        freedom = np.full(len(points), _JOINT_FREEDOM)
        freedom[[0, -1]] = _END_FREEDOM
        return cls(
            rays=points[:, :2] / points[:, 2:],
            lengths=np.asarray(lengths, dtype=np.float64),
            start=measured,
            lower=lower,
            upper=lower + freedom,
        )

    def points(self, depths: FloatArray) -> FloatArray:
        """Give the keypoints at these depths [m]. Shape (n, 3)."""
        return np.column_stack([self.rays * depths[:, None], depths])


class LimbSolution(NamedTuple):
    """Solution for the depths of a limb."""

    depths: FloatArray
    """[m]. Shape (n,)"""
    converged: bool
    """if not, the depths are to be left as they were"""


_STEPS = 25
_FIRST_BARRIER, _LAST_BARRIER = 1e-2, 1e-9  # of the divided problem; the last moves depths by under 0.1 mm
_SETTLING_STEPS = 4  # with the last barrier
_BACK_OFF = 0.99  # of the way to a bound, at most
_START_INSIDE = 0.01  # of the width between the bounds
_ROUNDING = 1e-9  # [m] beyond a bound is rounding


class FastLimbSolver:
    """Moves the depths of limbs of one number of keypoints so that their lengths hold.

    Not safe to share between threads: the buffers are the solver's.
    """

    def __init__(self, joints: int) -> None:
        """Compile for limbs of so many keypoints; the first solver of a number takes half a second."""
        sizes = (2 * joints, joints - 1, joints, joints, joints)
        self._arguments = [np.zeros(size) for size in sizes]
        self._result = np.zeros(joints)
        self._function = _unrolled(joints)
        self._buffer, self._call = self._function.buffer()
        for i, argument in enumerate(self._arguments):
            self._buffer.set_arg(i, memoryview(argument.data))
        self._buffer.set_res(0, memoryview(self._result.data))

    def solve(self, chain: LimbChain) -> LimbSolution:
        """Solve one limb. Takes about 0.03 ms."""
        values = (chain.rays.ravel(), chain.lengths, chain.start, chain.lower, chain.upper)
        for argument, value in zip(self._arguments, values, strict=True):
            argument[:] = value
        self._call()
        depths = self._result.copy()
        inside = (depths >= chain.lower - _ROUNDING) & (depths <= chain.upper + _ROUNDING)  # NaN is not
        return LimbSolution(depths, bool(inside.all()))


@cache
def _unrolled(joints: int) -> Any:
    casadi: Any = importlib.import_module("casadi")
    rays = casadi.SX.sym("rays", 2 * joints)
    lengths = casadi.SX.sym("lengths", joints - 1)
    start, lower, upper = (casadi.SX.sym(name, joints) for name in ("start", "lower", "upper"))
    problem = _Divided(casadi, joints, rays, lengths)
    margin = _START_INSIDE * (upper - lower)
    first = casadi.fmin(casadi.fmax(start, lower + margin), upper - margin)
    z = [first[i] for i in range(joints)]
    below = [_FIRST_BARRIER / (z[i] - lower[i]) for i in range(joints)]  # multipliers of the lower bounds
    above = [_FIRST_BARRIER / (upper[i] - z[i]) for i in range(joints)]
    for barrier in _barriers():
        gap_below = [z[i] - lower[i] for i in range(joints)]
        gap_above = [upper[i] - z[i] for i in range(joints)]
        gradient, diagonal, off_diagonal = problem.expand(z)
        diagonal = [diagonal[i] + below[i] / gap_below[i] + above[i] / gap_above[i] for i in range(joints)]
        right = [barrier / gap_below[i] - barrier / gap_above[i] - gradient[i] for i in range(joints)]
        dz = _solve_tridiagonal(diagonal, off_diagonal, right)
        d_below = [(barrier - below[i] * dz[i]) / gap_below[i] - below[i] for i in range(joints)]
        d_above = [(barrier + above[i] * dz[i]) / gap_above[i] - above[i] for i in range(joints)]
        primal = _longest_step(casadi, gap_below + gap_above, dz + [-step for step in dz])
        dual = _longest_step(casadi, below + above, d_below + d_above)
        z = [z[i] + primal * dz[i] for i in range(joints)]
        below = [below[i] + dual * d_below[i] for i in range(joints)]
        above = [above[i] + dual * d_above[i] for i in range(joints)]
    arguments = [rays, lengths, start, lower, upper]
    return casadi.Function("limb", arguments, [casadi.vertcat(*z)], {"cse": True})


def _barriers() -> list[float]:
    """Give the barrier parameter of each step: geometric, then settling."""
    falling = np.geomspace(_FIRST_BARRIER, _LAST_BARRIER, _STEPS - _SETTLING_STEPS + 1)
    return [*map(float, falling), *[_LAST_BARRIER] * (_STEPS - len(falling))]


class _Divided:
    """The objective, divided, with its derivatives as expressions."""

    def __init__(self, casadi: Any, joints: int, rays: Any, lengths: Any) -> None:
        def dot(i: int, k: int) -> Any:
            return rays[2 * i] * rays[2 * k] + rays[2 * i + 1] * rays[2 * k + 1] + 1.0

        self._casadi = casadi
        self._joints = joints
        self._own = [dot(i, i) for i in range(joints)]
        self._next = [dot(i, i + 1) for i in range(joints - 1)]
        self._squares = [lengths[i] ** 2 for i in range(joints - 1)]
        self._scale = sum(self._squares) / (joints - 1)

    def expand(self, z: list[Any]) -> tuple[list[Any], list[Any], list[Any]]:
        """Give the gradient, and the diagonal and off-diagonal of the Hessian."""
        gradient, diagonal = [0.0] * self._joints, [0.0] * self._joints
        off_diagonal = []
        for i in range(self._joints - 1):
            own, shared, other = self._own[i], self._next[i], self._own[i + 1]
            squared = own * z[i] ** 2 - 2.0 * shared * z[i] * z[i + 1] + other * z[i + 1] ** 2
            missed = (squared - self._squares[i]) / self._scale
            by_own = 2.0 * (own * z[i] - shared * z[i + 1]) / self._scale
            by_next = 2.0 * (other * z[i + 1] - shared * z[i]) / self._scale
            bend = 4.0 * self._casadi.fmax(missed, 0.0) / self._scale
            gradient[i] += 2.0 * missed * by_own
            gradient[i + 1] += 2.0 * missed * by_next
            diagonal[i] += 2.0 * by_own**2 + bend * own
            diagonal[i + 1] += 2.0 * by_next**2 + bend * other
            off_diagonal.append(2.0 * by_own * by_next - bend * shared)
        return gradient, diagonal, off_diagonal


def _solve_tridiagonal(diagonal: list[Any], off_diagonal: list[Any], right: list[Any]) -> list[Any]:
    """Solve a symmetric tridiagonal system by elimination."""
    diagonal, right = list(diagonal), list(right)
    for i, off in enumerate(off_diagonal):
        factor = off / diagonal[i]
        diagonal[i + 1] = diagonal[i + 1] - factor * off
        right[i + 1] = right[i + 1] - factor * right[i]
    solution = [right[-1] / diagonal[-1]]
    for i in range(len(off_diagonal) - 1, -1, -1):
        solution.insert(0, (right[i] - off_diagonal[i] * solution[0]) / diagonal[i])
    return solution


def _longest_step(casadi: Any, values: list[Any], changes: list[Any]) -> Any:
    """Longest step length, at most 1, that keeps every value positive."""
    step = 1.0
    for value, change in zip(values, changes, strict=True):
        step = casadi.fmin(step, casadi.if_else(change < 0.0, -_BACK_OFF * value / change, 1.0))
    return step
