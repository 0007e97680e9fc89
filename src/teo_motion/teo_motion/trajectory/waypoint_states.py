# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Velocities and accelerations with which joints pass their knots."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array

# A cubic between two knots is monotone if its end slopes are at most three times the chord's: C. de Boor and
# B. Swartz, "Piecewise monotone interpolation" (J. Approx. Theory 21, 1977).
_MONOTONE = 3.0

# Where a joint turns back, its velocity at the knot is at most the slower chord's: it turns a little before
# or after the knot, as hands do, instead of stopping dead in it.
_TURNING = 1.0

# A cubic between two equal knots that begins with velocity v swings out by at most v h / 4 with the step h.
_SWING = 4.0


def waypoint_states(times: Array, positions: Array, brake: Array, *, swing: float) -> tuple[Array, Array]:
    """How joints pass their knots: as a smooth spline does that hardly leaves their interval.

    Velocities are those of the cubic spline with continuous acceleration, which follows densely recorded
    motion with the least jerk; where that spline would swing out far between two knots, its velocity is
    limited there, and a joint that stands still before or after a knot has none.

    Args:
        times: Times of the knots [s], strictly increasing. Shape (n,), n >= 2.
        positions: Positions [rad]. Shape (n, m).
        brake: Factor on the velocity of each knot, 0 to 1. Shape (n, m).
        swing: How far a joint may leave the interval between two knots [rad].

    Returns:
        Velocities [rad/s] and accelerations [rad/s^2]; zero at the first and last knot. Shape (n, m) each.
    """
    steps = np.diff(times)[:, None]
    chords = np.diff(positions, axis=0) / steps
    bound = np.zeros_like(positions)
    before, after = chords[:-1], chords[1:]
    slower = np.minimum(np.abs(before), np.abs(after))
    bound[1:-1] = np.where(before * after > 0.0, _MONOTONE, _TURNING) * slower
    # Among dense knots the spline is to be trusted: it cannot swing out far.
    bound[1:-1] = np.maximum(bound[1:-1], _SWING * swing / np.maximum(steps[:-1], steps[1:]))
    bound[1:-1] *= (before != 0.0) & (after != 0.0)
    bound *= brake

    fixed = bound == 0.0
    velocities = _spline(steps, chords, fixed, np.zeros_like(positions))
    limited = np.abs(velocities) > bound
    if (limited & ~fixed).any():
        # A second spline through the limited knots: their neighbours must know how they are passed.
        velocities = _spline(steps, chords, fixed | limited, np.clip(velocities, -bound, bound))
        velocities = np.clip(velocities, -bound, bound)

    from_left = np.zeros_like(positions)
    from_right = np.zeros_like(positions)
    from_left[1:] = (2.0 * velocities[:-1] + 4.0 * velocities[1:] - 6.0 * chords) / steps
    from_right[:-1] = (6.0 * chords - 4.0 * velocities[:-1] - 2.0 * velocities[1:]) / steps
    # The two sides agree where the spline is free; elsewhere the lesser one is safe for both, if they agree
    # on the direction.
    lesser = np.where(np.abs(from_left) < np.abs(from_right), from_left, from_right)
    accelerations = np.where((from_left * from_right > 0.0) & (bound > 0.0), lesser, 0.0)
    return velocities, accelerations


def _spline(steps: Array, chords: Array, fixed: NDArray[np.bool_], values: Array) -> Array:
    """Knot velocities of a cubic spline with continuous acceleration, some of them given.

    Solves, for each free knot i, v[i-1]/h[i-1] + 2 (1/h[i-1] + 1/h[i]) v[i] + v[i+1]/h[i] =
    3 (c[i-1]/h[i-1] + c[i]/h[i]) with steps h and chords c, by elimination (L. H. Thomas) for all joints at
    once. The first and the last knot must be fixed.
    """
    count = len(values)
    inverse = 1.0 / steps
    below = np.zeros_like(values)
    above = np.zeros_like(values)
    below[1:-1] = inverse[:-1]
    above[1:-1] = inverse[1:]
    middle = 2.0 * (below + above)
    right = np.zeros_like(values)
    right[1:-1] = 3.0 * (chords[:-1] * inverse[:-1] + chords[1:] * inverse[1:])
    below[fixed] = 0.0
    above[fixed] = 0.0
    middle[fixed] = 1.0
    right[fixed] = values[fixed]
    for index in range(1, count):
        factor = below[index] / middle[index - 1]
        middle[index] -= factor * above[index - 1]
        right[index] -= factor * right[index - 1]
    found = np.empty_like(values)
    found[-1] = right[-1] / middle[-1]
    for index in range(count - 2, -1, -1):
        found[index] = (right[index] - above[index] * found[index + 1]) / middle[index]
    return found
