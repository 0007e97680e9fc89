# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Interpolation between trajectory points as Bezier curves of degree five, and sure bounds of such curves.

A segment of duration T [s] from (p0, v0, a0) to (p1, v1, a1) is the one polynomial of degree five that
has these values at its ends. Its control points follow from them: a Bezier curve of degree n has the
slope n (b1 - b0) / T and the curvature n (n - 1) (b2 - 2 b1 + b0) / T^2 at its start, and likewise,
reversed, at its end. A straight line and a cubic are the same curve with the derivatives that they have
at their own ends, so that one formula serves all three. The curve lies within the hull of its control
points: this is what bounds it surely (G. Farin, Curves and Surfaces for CAGD, chapters 4 to 6).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

DEGREE = 5
LINEAR, CUBIC, QUINTIC = 1, 3, 5

# Halving a piece brings its hull about four times nearer to the curve: after this many, nearer than rounding.
_HALVINGS = 24


class Excess(NamedTuple):
    """Where a curve leaves its bounds."""

    segment: int
    joint: int
    fraction: float
    """Part of the segment's duration, 0..1."""
    value: float
    """The curve there, in the unit of the control points."""


def _end_derivatives(
    durations: FloatArray,
    degrees: NDArray[np.int8],
    positions: FloatArray,
    velocities: FloatArray,
    accelerations: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Velocities and accelerations at both ends of each segment, given or implied by the segment's degree.

    Args:
        durations: [s]. Shape (n,), all > 0.
        degrees: LINEAR, CUBIC or QUINTIC. Shape (n, joints).
        positions: Of the points [rad]. Shape (n + 1, joints).
        velocities: Of the points [rad/s], read where the degree is CUBIC or QUINTIC. Shape (n + 1, joints).
        accelerations: Of the points [rad/s^2], read where the degree is QUINTIC. Shape (n + 1, joints).

    Returns:
        v0, v1 [rad/s], a0, a1 [rad/s^2]. Shape (n, joints) each.
    """
    v0, v1 = velocities[:-1], velocities[1:]
    a0, a1 = accelerations[:-1], accelerations[1:]
    if not (degrees == QUINTIC).all():
        time = durations[:, None]
        slope = (positions[1:] - positions[:-1]) / time
        v0 = np.where(degrees == LINEAR, slope, v0)
        v1 = np.where(degrees == LINEAR, slope, v1)
        # Second derivatives of the cubic Hermite polynomial at its ends; zero for the straight line.
        a0 = np.where(degrees == QUINTIC, a0, (6.0 * slope - 4.0 * v0 - 2.0 * v1) / time)
        a1 = np.where(degrees == QUINTIC, a1, (-6.0 * slope + 2.0 * v0 + 4.0 * v1) / time)
    return v0, v1, a0, a1


def control_points(
    durations: FloatArray,
    degrees: NDArray[np.int8],
    positions: FloatArray,
    velocities: FloatArray,
    accelerations: FloatArray,
) -> FloatArray:
    """Control points [rad] of every segment between n + 1 points; arguments as in `_end_derivatives`.

    Returns:
        Shape (6, n, joints).
    """
    v0, v1, a0, a1 = _end_derivatives(durations, degrees, positions, velocities, accelerations)
    time = durations[:, None]
    reach = time / DEGREE
    bend = time * time / (DEGREE * (DEGREE - 1))
    control = np.empty((DEGREE + 1, *v0.shape))
    control[0] = positions[:-1]
    control[1] = control[0] + v0 * reach
    control[2] = control[0] + 2.0 * v0 * reach + a0 * bend
    control[5] = positions[1:]
    control[4] = control[5] - v1 * reach
    control[3] = control[5] - 2.0 * v1 * reach + a1 * bend
    return control


def derivative(control: FloatArray, durations: FloatArray) -> FloatArray:
    """Control points of the time derivative: one fewer, per second. Shapes (k + 1, n, joints) and (n,)."""
    degree = len(control) - 1
    return np.asarray(degree * np.diff(control, axis=0) / durations[:, None])


def bernstein(degree: int, fraction: float | FloatArray) -> FloatArray:
    """Weights of a curve's control points at parts 0..1 of its duration. Shape (degree + 1, ...)."""
    rest = 1.0 - fraction
    weights = np.empty((degree + 1, *np.shape(fraction)))
    binomial = 1.0
    for k in range(degree + 1):
        weights[k] = binomial * fraction**k * rest ** (degree - k)
        binomial = binomial * (degree - k) / (k + 1)
    return weights


@np.errstate(invalid="ignore", over="ignore")
def first_excess(control: FloatArray, lower: FloatArray, upper: FloatArray) -> Excess | None:
    """Find a place where a curve leaves [lower, upper], or None if no curve does.

    Curves whose hull is inside are safe at once. The others are halved until a point of the curve is outside
    or all the pieces' hulls are inside, so that nothing is missed between samples.

    Args:
        control: Control points of n segments. Shape (k + 1, n, joints). Not finite counts as outside.
        lower: Per joint, in the unit of the control points. Shape (joints,).
        upper: Per joint. Shape (joints,).
    """
    outside = ~((control >= lower) & (control <= upper)).all(axis=0)
    if not outside.any():
        return None
    segments, joints = np.nonzero(outside)
    pieces = control[:, segments, joints]
    starts = np.zeros(len(segments))
    width = 1.0
    for _ in range(_HALVINGS):
        low, high = lower[joints], upper[joints]
        for end, offset in ((0, 0.0), (-1, width)):
            # Written so that a NaN, which is never >=, counts as outside; halving brings it to an end.
            inside = (pieces[end] >= low) & (pieces[end] <= high)
            if not inside.all():
                return _excess(int(np.argmin(inside)), pieces[end], segments, joints, starts + offset)
        hull_outside = ~((pieces >= low) & (pieces <= high)).all(axis=0)
        if not hull_outside.any():
            return None
        segments, joints = segments[hull_outside], joints[hull_outside]
        left, right = _halve(pieces[:, hull_outside])
        width /= 2.0
        starts = starts[hull_outside]
        pieces = np.concatenate([left, right], axis=1)
        starts = np.concatenate([starts, starts + width])
        segments, joints = np.concatenate([segments, segments]), np.concatenate([joints, joints])
    # Undecided to the last digit: the safe answer.
    return _excess(0, pieces[0], segments, joints, starts)


def _excess(
    index: int,
    values: FloatArray,
    segments: NDArray[np.intp],
    joints: NDArray[np.intp],
    fractions: FloatArray,
) -> Excess:
    return Excess(int(segments[index]), int(joints[index]), float(fractions[index]), float(values[index]))


def _halve(pieces: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Split curves in the middle (de Casteljau). Shape (k + 1, m) in, twice the same out."""
    left, right = np.empty_like(pieces), np.empty_like(pieces)
    rest = pieces
    last = len(pieces) - 1
    for k in range(last + 1):
        left[k] = rest[0]
        right[last - k] = rest[-1]
        rest = 0.5 * (rest[:-1] + rest[1:])
    return left, right
