# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Time along a path: it never goes back or leaps (`PathClock`), and changes its pace smoothly (`PathPace`).

A joint at q(s) moves at q'(s) ds/dt. Letting ds/dt change between 0 and 1 slows all joints together and on
the very path that was found good, so that no position limit and no velocity limit can be broken by it, and no
pose is taken that the sender did not plan. What it adds to a joint's acceleration is q' d2s/dt2, and to its
jerk q' d3s/dt3 and terms of second order; both derivatives are bounded by what the joints of this part of the
path allow.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import ruckig

from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.trajectory import Trajectory
from teo_sim_driver.rules import REST_VELOCITY

# [ns]
SECOND = 1_000_000_000

# Longest gap between two steps that the motion follows [s]: longer than receiving the longest message takes.
# A greater one is a clock that was set or a process that stood still, and no path is cut short for either.
_LONGEST_GAP = 0.5


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
        if 0.0 <= gap <= _LONGEST_GAP:
            return gap
        self.jumps += 1
        return self._period


class Braking(NamedTuple):
    """What a change of pace may add to the motion of the fastest joint."""

    deceleration: float
    """[rad/s^2]"""
    jerk: float
    """[rad/s^3]"""

    def longest(self, speed: float) -> float:
        """Time between full pace and standing still, if this is the greatest joint speed [rad/s]; [s]."""
        if speed * self.jerk > self.deceleration**2:
            return speed / self.deceleration + self.deceleration / self.jerk
        return 2.0 * float(np.sqrt(speed / self.jerk))  # the greatest deceleration is not reached


# Deceleration of a stop [rad/s^2], 300 deg/s^2: about that of signs. No limit of the real joints is public.
DEFAULT_STOP_DECELERATION = 5.2

# Jerk of a stop [rad/s^3], that of the planner's motions: the deceleration builds up in 0.05 s. From 50 deg/s
# a stop takes 0.22 s and at most 0.1 rad.
DEFAULT_STOP_JERK = 105.0
DEFAULT_BRAKING = Braking(DEFAULT_STOP_DECELERATION, DEFAULT_STOP_JERK)


class PathPace:
    """How fast time passes on the path: 1 as it was sent, 0 at rest."""

    def __init__(self) -> None:
        """Full pace."""
        self._target = 1.0
        # Path time since the change began [s], its rate [1], its second derivative [1/s].
        self._at = (0.0, 1.0, 0.0)
        self._change: ruckig.Trajectory | None = None
        self._elapsed = 0.0

    @property
    def rate(self) -> float:
        """Path time per time, 0..1."""
        return self._at[1]

    @property
    def acceleration(self) -> float:
        """Of the path time [1/s]."""
        return self._at[2]

    @property
    def remaining(self) -> float:
        """Time until the pace is constant again [s]."""
        return 0.0 if self._change is None else self._change.duration - self._elapsed

    def jump(self, rate: float) -> None:
        """Take this pace at once: for joints that stand still."""
        self._at, self._change = (0.0, rate, 0.0), None

    def turn(self, target: float, fastest: float, braking: Braking) -> None:
        """Begin to change to this pace, from whatever goes on.

        Args:
            target: New pace, 0..1.
            fastest: Upper bound of the path's speed of any joint while the pace changes [rad/s].
            braking: What the change may add.
        """
        _, rate, acceleration = self._at
        if fastest < REST_VELOCITY or (rate == target and acceleration == 0.0):
            self.jump(target)
            return
        # A change that is under way ends within 0..1 by its own bounds; gentler ones could carry it beyond.
        room = rate if acceleration < 0.0 else 1.0 - rate
        needed = 0.5 * acceleration**2 / room if room > 0.0 else 0.0
        step = ruckig.InputParameter(1)
        step.control_interface = ruckig.ControlInterface.Velocity
        step.current_position, step.current_velocity = [0.0], [rate]
        step.current_acceleration = [acceleration]
        step.target_velocity, step.target_acceleration = [target], [0.0]
        step.max_acceleration = [max(braking.deceleration / fastest, abs(acceleration))]
        step.max_jerk = [max(braking.jerk / fastest, needed)]
        self._change, self._elapsed = ruckig.Trajectory(1), 0.0
        ruckig.Ruckig(1).calculate(step, self._change)
        self._at = (0.0, rate, acceleration)
        self._target = target

    def progress(self, duration: float) -> float:
        """Path time that will pass in so much time from now [s]."""
        return self._after(duration)[0] - self._at[0]

    def advance(self, duration: float) -> float:
        """Let time pass [s] and return the path time that passed [s]."""
        if self._change is None:
            return duration * self._at[1]
        before, self._at = self._at[0], self._after(duration)
        self._elapsed += duration
        passed = self._at[0] - before
        if self._elapsed >= self._change.duration:
            self.jump(self._target)
        return passed

    def _after(self, duration: float) -> tuple[float, float, float]:
        place, rate, acceleration = self._at
        if self._change is None:
            return place + duration * rate, rate, acceleration
        time, end = self._elapsed + duration, self._change.duration
        (place,), (rate,), (acceleration,) = self._change.at_time(min(time, end))
        rate = min(max(rate, 0.0), 1.0)  # rounding
        return place + max(time - end, 0.0) * self._target, rate, acceleration


def fastest_ahead(trajectory: Trajectory, start: float, limits: FloatArray, braking: Braking) -> float:
    """Upper bound of all joints' speeds on the span in which a change of pace ends [rad/s].

    Args:
        trajectory: What is being executed.
        start: Trajectory time at which the change begins [s].
        limits: Velocity limit of each joint [rad/s]. Shape (joints,).
        braking: What the change may add.
    """
    segments = trajectory.segments_within(start, start + braking.longest(float(limits.max())))
    if segments.start >= segments.stop:
        return 0.0
    # From the control points, which bound the curve surely.
    speeds = np.abs(trajectory.velocity_control(segments)).max(axis=(0, 1))
    return float(np.minimum(speeds, limits).max())
