# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bounds of acceleration and jerk that make a segment no harder than its time asks for."""

from __future__ import annotations

import numpy as np

from teo_motion.trajectory.ruckig_segment import Bounds, State

# Least share of the limits that a segment is given: a joint that hardly moves would otherwise get none.
_LEAST_SHARE = 0.02

# A little more jerk than exactly enough [1]: rounding must not make it too little.
_SPARE = 1.01

_SAMPLES = np.linspace(0.0, 1.0, 9)[:, None]


def relaxed_bounds(begin: State, end: State, duration: float, bounds: Bounds, *, ease: float) -> Bounds:
    """Bounds a little above what a smooth segment in this time reaches.

    A segment with time to spare would otherwise jump to a low speed, keep it and stop as hard as the limits
    allow. People's hands speed up and slow down over the whole way: the least-jerk quintic of T. Flash and
    N. Hogan (J. Neurosci. 5, 1985) is the measure here.

    Args:
        begin: State at the beginning.
        end: State at the end.
        duration: Time that the segment has [s].
        bounds: Limits, which the result keeps.
        ease: Times the quintic's greatest acceleration and jerk [1].
    """
    distance = end.position - begin.position
    # p(s) = p0 + v0 T s + c3 s^3 + c4 s^4 + c5 s^5 with s = t / T; Ruckig sees to the accelerations.
    reach, swing = distance - begin.velocity * duration, (end.velocity - begin.velocity) * duration
    c3, c4, c5 = 10.0 * reach - 4.0 * swing, -15.0 * reach + 7.0 * swing, 6.0 * reach - 3.0 * swing
    s = _SAMPLES
    acceleration = np.abs(6.0 * c3 * s + 12.0 * c4 * s**2 + 20.0 * c5 * s**3).max(axis=0) / duration**2
    jerk = np.abs(6.0 * c3 + 24.0 * c4 * s + 60.0 * c5 * s**2).max(axis=0) / duration**3
    least_acceleration = _LEAST_SHARE * bounds.acceleration
    least_jerk = _LEAST_SHARE * bounds.jerk
    for state in (begin, end):
        # The joint must be able to end its acceleration below its greatest velocity: v + a^2 / 2 j.
        room = np.maximum(bounds.velocity - np.abs(state.velocity), 1e-9)
        least_jerk = np.maximum(least_jerk, _SPARE * state.acceleration**2 / (2.0 * room))
        least_acceleration = np.maximum(least_acceleration, np.abs(state.acceleration))
    return Bounds(
        lower=bounds.lower,
        upper=bounds.upper,
        velocity=bounds.velocity,
        acceleration=np.minimum(np.maximum(ease * acceleration, least_acceleration), bounds.acceleration),
        jerk=np.minimum(np.maximum(ease * jerk, least_jerk), bounds.jerk),
    )
