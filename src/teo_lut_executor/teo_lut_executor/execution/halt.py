# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Brings a robot in motion to a standstill."""

from __future__ import annotations

import math

from teo_lut_executor.execution.events import StopReady
from teo_lut_executor.execution.situation import Situation
from teo_motion.trajectory.ruckig_segment import State
from teo_motion.trajectory.stopping import stop

# How often a stop is sent to a robot that goes on moving: a driver may refuse one when a joint is about to
# reach a limit, and take the next.
_MOST_STOPS = 5

# Time after the end of a stop at which the next is sent [s].
_STOP_PATIENCE = 0.1

# The robot stands when joint states have shown no movement for this long [s]: ten of them.
_STANDS = 0.1


class Halt:
    """Brings a robot in motion to a standstill, with several stops if one is not taken."""

    def __init__(self, situation: Situation) -> None:
        """Begin with nothing to stop."""
        self._situation = situation
        self._stops = 0
        self._due = -math.inf

    def begin(self) -> None:
        """Expect the robot to stand from now on."""
        self._stops, self._due = 0, self._situation.now

    def shift_clock(self, by: float) -> None:
        """Follow a clock that was set by so much [s]."""
        self._due += by

    def stop(self, moving: State, number: int) -> list[StopReady]:
        """Stop a robot in this state, if it moves; the motion gets a number."""
        situation = self._situation
        if situation.robot.is_still or situation.is_stale or self._stops >= _MOST_STOPS:
            return []
        self._stops += 1
        end, lead = stop(moving, situation.limits)
        self._due = situation.now + lead
        return [StopReady(number=number, end=end, lead=lead)]

    def expect(self, duration: float) -> None:
        """Expect the robot to stand in so much time, as it was sent a way to [s]."""
        self._due = self._situation.now + duration

    @property
    def stands(self) -> bool:
        """Whether the robot has come to a standstill."""
        situation = self._situation
        return situation.robot.still_for(situation.now) >= _STANDS and situation.now >= self._due

    @property
    def is_overdue(self) -> bool:
        """Whether the robot should stand, and may be told again."""
        situation = self._situation
        return situation.now > self._due + _STOP_PATIENCE and situation.block is None
