# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the robot is brought to a standstill in the middle of a sentence."""

from __future__ import annotations

import numpy as np

from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State

# Between the last joint state and the robot's answer [s]: a period of joint states, planning, and transport.
_LATENCY = 0.03

# Stops take so many times as long as the limits ask for [1], which pays for what is not known of the state:
# with 1.6 one of 60 random stops, known 5 to 35 ms late, was over a limit (of jerk, by 1 %). Less only where
# a joint would leave its range otherwise, which a driver refuses.
_EASES = (1.6, 1.3, 1.0)

# Least duration of a stop [s].
_LEAST_STOP = 0.1


def stop(state: State, limits: MotionLimits) -> tuple[State, float]:
    """A standstill that the robot can reach smoothly, and the time that it takes.

    From position p, velocity v and acceleration a the smoothest stop in a time T, of least integral of jerk
    squared, ends at p + v T / 2 + a T^2 / 12; without acceleration its greatest deceleration is 1.5 v / T.
    Its greatest jerk is 6 v / T^2 + 4 a / T. A robot that is a tenth of T before or behind still makes it
    without going faster.

    Args:
        state: Latest known state of the joints.
        limits: Their limits.

    Returns:
        State at the end, within the position limits, and the time to it [s].
    """
    speed, acceleration, jerk = np.abs(state.velocity), np.abs(state.acceleration), limits.jerk
    # The second is the root of jerk T^2 - 4 a T - 6 v.
    needed = np.maximum(
        1.5 * speed / limits.acceleration,
        (2.0 * acceleration + np.sqrt(4.0 * acceleration**2 + 6.0 * speed * jerk)) / jerk,
    )
    for ease in _EASES:
        time = max(_LEAST_STOP, ease * float(needed.max()))
        end = state.position + state.velocity * (_LATENCY + time / 2.0) + state.acceleration * time**2 / 12.0
        within = np.clip(end, limits.lower, limits.upper)
        if (within == end).all():
            break
    return State.still(within), time + _LATENCY
