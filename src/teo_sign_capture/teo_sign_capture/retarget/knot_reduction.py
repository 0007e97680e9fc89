# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Fewer knots for the same motion, by what the planner makes of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BPoly

from teo_common.arrays import Array
from teo_motion.trajectory.waypoint_chain import OVERSHOOT
from teo_motion.trajectory.waypoint_states import waypoint_states

Indices = NDArray[np.int64]

# [rad] 9 mm at the end of TEO's stretched arm for one joint, below what retargeting errs by; fewer knots
# leave the planner more room to make the motion smooth.
TOLERANCE = np.radians(1.0)


def reduce_to_knots(times: Array, positions: Array, tolerance: float = TOLERANCE) -> Indices:
    """Choose frames such that what passes through them stays near all others.

    Both the straight lines between knots, which are the recorded motion by the format of an entry, and the
    spline by which the planner passes them stay within the tolerance. The frame that is farthest off becomes
    a knot until none is (Douglas and Peucker 1973, with the spline for the line).

    Args:
        times: [s], strictly increasing. Shape (n,).
        positions: [rad]. Shape (n, m).
        tolerance: Greatest difference of any joint in any frame [rad].

    Returns:
        Indices of the knots, increasing, the first and the last among them. Shape (k,).
    """
    count = len(times)
    knots = sorted({0, count - 1})
    while len(knots) < count:
        chosen = np.array(knots)
        away = deviations(times, positions, times[chosen], positions[chosen]).max(axis=1)
        away[chosen] = 0.0
        worst = int(np.argmax(away))
        if away[worst] <= tolerance:
            break
        knots.append(worst)
        knots.sort()
    return np.array(knots, dtype=np.int64)


def deviations(times: Array, positions: Array, knot_times: Array, knots: Array) -> Array:
    """How far the lines and the spline through knots are from every frame of a motion [rad]. Shape (n, m)."""
    if len(knots) < 2:
        return np.zeros(positions.shape)
    away: Array = np.maximum(
        *(np.abs(played(knot_times, knots, times) - positions) for played in (_lines, passed))
    )
    return away


def passed(knot_times: Array, knots: Array, times: Array) -> Array:
    """The motion with which the planner passes knots where no limit is in its way.

    Args:
        knot_times: [s]. Shape (k,), k >= 2.
        knots: [rad]. Shape (k, m).
        times: [s]. Shape (n,).

    Returns:
        Positions [rad]. Shape (n, m).
    """
    velocities, accelerations = waypoint_states(knot_times, knots, np.ones_like(knots), swing=OVERSHOOT)
    states = np.stack([knots, velocities, accelerations], axis=1)
    positions: Array = BPoly.from_derivatives(knot_times, states)(times)
    return positions


def _lines(knot_times: Array, knots: Array, times: Array) -> Array:
    return np.column_stack([np.interp(times, knot_times, column) for column in knots.T])
