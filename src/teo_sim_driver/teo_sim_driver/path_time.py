# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time along a path: it never goes back or leaps (`PathClock`), and a stop slows it down (`PathStop`).

A joint at q(s) moves at q'(s) ds/dt. Letting ds/dt fall from 1 to 0 stops all joints together and on the
very path that was found good, so that no position limit and no velocity limit can be broken by stopping,
and no pose is taken that the sender did not plan. Here ds/dt = 1 - 3 u^2 + 2 u^3 with u = t / T: velocity
and acceleration are continuous.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_sim_driver.bezier import FloatArray
from teo_sim_driver.message import SECOND
from teo_sim_driver.trajectory import Trajectory

# Longest gap between two steps that the motion follows [s]: longer than checking the longest message takes. A
# greater one is a clock that was set or a process that stood still, and no path is cut short for either.
LONGEST_GAP = 0.5

# Greatest slope of 1 - 3 u^2 + 2 u^3, at u = 1/2, and its integral from 0 to 1.
_STEEPEST = 1.5
_DISTANCE = 0.5


class PathClock:
    """Turns clock readings into steps of time."""

    def __init__(self, period: float) -> None:
        """Start without a reading.

        Args:
            period: Usual time between steps [s].
        """
        self._period = period
        self._last: int | None = None
        self.jumps = 0
        """Readings that went back, or too far ahead."""

    def advance(self, now: int) -> float:
        """Time since the last reading [s]; one period where the clock jumped, as a step was made.

        Args:
            now: Reading [ns].
        """
        last, self._last = self._last, now
        if last is None:
            return 0.0
        gap = (now - last) / SECOND
        if 0.0 <= gap <= LONGEST_GAP:
            return gap
        self.jumps += 1
        return self._period


class PathTime(NamedTuple):
    """Where on the trajectory a stopping robot is."""

    time: float
    """Trajectory time [s]."""
    rate: float
    """Trajectory time per time, 1..0."""


class PathStop:
    """Slows a trajectory down to a standstill, beginning at a given trajectory time."""

    def __init__(
        self, trajectory: Trajectory, start: float, velocity_limits: FloatArray, deceleration: float
    ) -> None:
        """Choose how long stopping takes.

        Args:
            trajectory: What is being executed.
            start: Trajectory time at which stopping begins [s].
            velocity_limits: Of each joint [rad/s]. Shape (joints,).
            deceleration: Greatest that stopping adds to what the path itself asks of a joint [rad/s^2].
        """
        longest = _STEEPEST * float(velocity_limits.max()) / deceleration
        fastest = _fastest(trajectory, start, start + _DISTANCE * longest, velocity_limits)
        self._start = start
        self.duration = min(_STEEPEST * fastest / deceleration, longest)
        """Time until the robot stands still [s]."""

    def at(self, elapsed: float) -> PathTime:
        """Trajectory time and its rate, so long after stopping began [s]."""
        if elapsed >= self.duration:
            return PathTime(self._start + _DISTANCE * self.duration, 0.0)
        u = elapsed / self.duration
        return PathTime(
            self._start + self.duration * (u - u**3 + _DISTANCE * u**4),
            1.0 - 3.0 * u**2 + 2.0 * u**3,
        )


def _fastest(trajectory: Trajectory, start: float, end: float, limits: FloatArray) -> float:
    """Upper bound of all joints' speeds on a span of the trajectory [rad/s], from the control points."""
    segments = trajectory.segments_within(start, end)
    if segments.start >= segments.stop:
        return 0.0
    speeds = np.abs(trajectory.velocity_control(segments)).max(axis=(0, 1))
    return float(np.minimum(speeds, limits).max())
