# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the driver is sent where one motion continues another without a standstill between them.

What a driver is sent passes a motion at a small distance (see `driver_points`), by where the motion is a
period before and after. A continuation that began with points of its own would thus begin a little beside
the points in force, and a driver makes that good within one period, at several times the limit of jerk.
Instead both motions, one up to the seam and the other from there on, are made points of together. In the
period before the seam these depend already on what comes after it, and before that they are those in force:
the continuation is sent to begin there.
"""

from __future__ import annotations

import numpy as np

from teo_motion.sentence.plan import Plan, Samples, sample_at
from teo_motion.trajectory.driver_points import spline_points

# With less time than this the driver might get a continuation too late [s]: a period of points, and the
# message's way.
LEAST_AHEAD = 0.07

# Times of points are products, those of signs are sums: so much apart they are the same [s].
_ROUNDING = 1e-9


def last_seam(plan: Plan, time: float) -> float:
    """The last time up to another at which a plan may be continued: that of one of its points [s]."""
    return float(plan.times[np.searchsorted(plan.times, time + _ROUNDING) - 1])


def continued(plan: Plan, seam: float, continuation: Plan) -> Samples:
    """What the driver is sent of a motion that continues another.

    Args:
        plan: The motion before, sampled with the same period.
        seam: When the continuation takes over [s], as `last_seam` found it.
        continuation: The motion from there on, planned from the state of the one before.

    Returns:
        The continuation's samples behind one more, a period before the seam; times count from that one.
    """
    period = float(continuation.times[1])
    before = sample_at(plan.motions, np.array([seam - 2.0 * period, seam - period])).positions
    after = sample_at(continuation.motions, np.array([0.0, period])).positions
    seams = spline_points(np.concatenate((before, after)), period)
    samples = continuation.samples
    return Samples(
        times=np.concatenate(([0.0], samples.times + period)),
        positions=np.concatenate((seams.positions, samples.positions[1:])),
        velocities=np.concatenate((seams.velocities, samples.velocities[1:])),
        accelerations=np.concatenate((seams.accelerations, samples.accelerations[1:])),
    )
