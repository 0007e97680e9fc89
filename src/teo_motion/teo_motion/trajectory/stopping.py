# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the robot is brought to a standstill in the middle of a sentence."""

from __future__ import annotations

import numpy as np

from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State

# Between the last joint state and the robot's answer [s]: a period of joint states, planning, and transport.
_LATENCY = 0.03

# Stops take this much longer than the limits ask for [1], which pays for what is not known of the state.
_EASE = 1.3

# Least duration of a stop [s].
_LEAST_STOP = 0.1


def stop(state: State, limits: MotionLimits) -> tuple[State, float]:
    """A standstill that the robot can reach smoothly, and the time that it takes.

    From position p, velocity v and acceleration a the smoothest stop in a time T, of least integral of jerk
    squared, ends at p + v T / 2 + a T^2 / 12; without acceleration its greatest deceleration is 1.5 v / T and
    its greatest jerk 6 v / T^2. A robot that is a tenth of T before or behind still makes it without going
    faster.

    Args:
        state: Latest known state of the joints.
        limits: Their limits.

    Returns:
        State at the end, within the position limits, and the time to it [s].
    """
    speed = np.abs(state.velocity)
    needed = np.maximum(1.5 * speed / limits.acceleration, np.sqrt(6.0 * speed / limits.jerk))
    time = max(_LEAST_STOP, _EASE * float(needed.max()))
    distance = state.velocity * (_LATENCY + time / 2.0) + state.acceleration * time**2 / 12.0
    still = np.zeros_like(speed)
    position = np.clip(state.position + distance, limits.lower, limits.upper)
    return State(position=position, velocity=still, acceleration=still), time + _LATENCY
