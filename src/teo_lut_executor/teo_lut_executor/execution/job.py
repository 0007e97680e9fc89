# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sentence that was accepted, and what the robot does for it."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from teo_lut_executor.execution.events import Sentence
from teo_motion.sentence.plan import Plan

# Time that planning a sentence is given at first when it is to continue a motion [s]: three times the median
# on two loaded cores. Where it was too little, the next try gets twice as much.
_PLANNING_TIME = 0.4


class Phase(enum.Enum):
    """What the robot does, as far as the executor has a hand in it."""

    RESTING = enum.auto()  # nothing is in force
    PLANNING = enum.auto()  # standing, a plan is awaited
    SIGNING = enum.auto()  # a motion of a sentence is in force
    STOPPING = enum.auto()  # given up; the robot is awaited to stand
    RETURNING = enum.auto()  # a way to rest is in force


@dataclass(kw_only=True, eq=False)
class Job:
    """A sentence that was accepted."""

    ticket: int
    sentence: Sentence
    attempts: int = 0  # how often it was begun
    again: bool = False  # whether it was interrupted, and is to be signed again
    canceled: str = ""  # why it is to end early; empty if it is not
    plan: Plan | None = None
    planning_time: float = _PLANNING_TIME  # to be given when it is to continue another [s]
    joins: bool = True  # whether it may continue another
