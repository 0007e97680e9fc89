# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The last line of defence: whatever was computed, no step is faster than the robot or outside its limits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_description import JointLimits
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.rules import POSITION_TOLERANCE, VELOCITY_TOLERANCE

# Rounding of one step [rad].
_ROUNDING = 1e-9


class GuardedStep(NamedTuple):
    """What is sent."""

    positions: FloatArray
    """[rad]. Shape (joints,)."""
    limited: tuple[str, ...]
    """Joints that were not sent where they were asked to go."""


class StepGuard:
    """Limits a step. Trajectories are checked before, so a guard that limits has found a fault."""

    def __init__(self, limits: JointLimits) -> None:
        self._names = limits.names
        self._low = limits.lower - POSITION_TOLERANCE
        self._high = limits.upper + POSITION_TOLERANCE
        self._speed = limits.velocity * (1.0 + VELOCITY_TOLERANCE)

    def limit(self, asked: FloatArray, last: FloatArray, duration: float) -> GuardedStep:
        """Return the nearest positions to those asked that can be reached.

        Args:
            asked: Positions [rad]. Shape (joints,). A joint asked to go to NaN stays.
            last: Positions of the last step [rad], inside the limits. Shape (joints,).
            duration: Since the last step [s].
        """
        reach = self._speed * duration + _ROUNDING
        low, high = np.maximum(self._low, last - reach), np.minimum(self._high, last + reach)
        inside = (asked >= low) & (asked <= high)
        if inside.all():
            return GuardedStep(asked, ())
        sent = np.where(np.isnan(asked), last, np.clip(asked, low, high))
        return GuardedStep(
            sent, tuple(name for name, good in zip(self._names, inside, strict=True) if not good)
        )
