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
        self._owed = False
        self._number = 0  # of the stop that was sent last

    def begin(self) -> None:
        """Expect the robot to stand from now on."""
        self._stops, self._due, self._owed = 0, self._situation.now, False

    def owe(self, number: int | None = None) -> None:
        """Stop the robot when it can be told, though it may seem to stand: it has a motion to go on with.

        Args:
            number: Of a stop that the driver did not take; of others' numbers nothing is owed. None: it could
                not be told.
        """
        if number is None or number == self._number:
            self._owed = self._stops < _MOST_STOPS

    def shift_clock(self, by: float) -> None:
        """Follow a clock that was set by so much [s]."""
        self._due += by

    def stop(self, moving: State, number: int) -> list[StopReady]:
        """Stop a robot in this state, if it moves; the motion gets a number."""
        situation = self._situation
        still = situation.robot.is_still and not self._owed
        if still or not situation.may_be_told or self._stops >= _MOST_STOPS:
            return []
        self._stops += 1
        self._owed, self._number = False, number
        end, lead = stop(moving, situation.limits)
        self._due = situation.now + lead
        return [StopReady(number=number, end=end, lead=lead)]

    def expect(self, number: int, duration: float) -> None:
        """Expect the robot to stand in so much time [s], as it was sent a way to that has this number."""
        self._number, self._due = number, self._situation.now + duration

    @property
    def stands(self) -> bool:
        """Whether the robot has come to a standstill."""
        situation = self._situation
        still = situation.robot.still_for(situation.now) >= _STANDS and not situation.is_stale
        return still and situation.now >= self._due and not self._owed

    @property
    def is_overdue(self) -> bool:
        """Whether the robot should stand, and is to be told again."""
        return self._owed or self._situation.now > self._due + _STOP_PATIENCE
