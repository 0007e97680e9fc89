# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The points that a driver is sent: what it interpolates between them keeps every limit, jerk included.

A driver joins points by the quintic that meets position, velocity and acceleration at both ends. Between
samples of a motion whose jerk changes in between, that quintic reaches 2.2 times the motion's jerk. The
points are therefore those of the uniform cubic B-spline whose control points are the motion's positions, one
a period (I. J. Schoenberg's variation diminishing approximation, "On spline functions", 1967). Each of its
derivatives is a mean of the motion's own, over at most four periods, and so within the same limits; the
quintics between its points are the spline itself. It passes a point of the motion at a distance of a sixth of
acceleration times period squared. At the limits of TEO these are 0.5 mrad, a third of an encoder's count, and
1.9 mrad of a hand's axes, 0.2 mm at the tip of a finger.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_motion.trajectory.joint_motion import JointMotion, take


class Samples(NamedTuple):
    """A motion at instants, of joints in columns.

    Attributes:
        times: [s], strictly increasing from 0. Shape (n,).
        positions: [rad]. Shape (n, m), as the two below.
        velocities: [rad/s].
        accelerations: [rad/s^2].
    """

    times: Array
    positions: Array
    velocities: Array
    accelerations: Array

    def frozen(self) -> Samples:
        """The same, read-only."""
        for array in self:
            array.setflags(write=False)
        return self


def driver_points(motions: Sequence[JointMotion], times: Array) -> Samples:
    """The points of some joints.

    A joint that stands still for a period after the first time and before the last begins and ends exactly
    where its motion does. One that moves at the first time begins as far beside it as said above.

    Args:
        motions: The joints' motions.
        times: Evenly spaced [s]. Shape (n,), n >= 2.
    """
    period = float(times[1] - times[0])
    # Motions hold their end; before its beginning a motion is what its first piece would have come from.
    later = np.concatenate((times, times[-1:] + period))
    controls = np.empty((len(times) + 2, len(motions)))
    for column, motion in enumerate(motions):
        controls[1:, column] = motion.at(later)[0]
        controls[0, column] = take(motion.pieces, 0).after(np.array(-period))[0]
    return spline_points(controls, times)


def spline_points(controls: Array, times: Array) -> Samples:
    """The points of the spline with these control points.

    Args:
        controls: [rad]. Shape (n + 2, m): one before the first point and one after the last.
        times: Of the points, evenly spaced [s]. Shape (n,), n >= 2.
    """
    period = float(times[1] - times[0])
    before, here, after = controls[:-2], controls[1:-1], controls[2:]
    # From differences, which lose fewer digits than the sums, and are exactly 0 at a standstill.
    first, second = here - before, after - here
    return Samples(
        times=times,
        positions=here + (second - first) / 6.0,
        velocities=(first + second) / (2.0 * period),
        accelerations=(second - first) / period**2,
    )


def point_times(duration: float, period: float) -> Array:
    """Evenly spaced times over a motion and at least a period after it [s]. Shape (n,)."""
    count = int(np.ceil(duration / period - 1e-9)) + 2
    return np.arange(count, dtype=np.float64) * period
