# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The states that an executor can be in, and the events that it answers in each."""

from __future__ import annotations

import enum


class State(enum.Enum):
    """What the robot does, as far as the executor has a hand in it; the value says it to people."""

    STANDING = "no motion is in force"
    PLANNING = "the robot stands, a sentence is being planned"
    PLANNING_REST = "the robot stands, its way to rest is being planned"
    OPENING = "the robot moves towards the first sign, the sentence is not in force yet"
    SIGNING = "the plan of a sentence is in force"
    STOPPING = "the robot was told to stop, and does not stand yet"
    RETURNING = "the robot moves to rest"


class Event(enum.Enum):
    """What can happen; the value says it to people."""

    # What people want of the current sentence.
    CANCELED = "the current sentence is to end"
    CANCELED_LATE = "the same, after its last sign, on the way to rest"
    REPLACED = "a newer text takes the place of a sentence that is planned"
    DEACTIVATED = "the executor is deactivated"
    # What the planner answers to the latest request.
    OPENED = "the first motion is planned"
    PLANNED = "the plan is there"
    NOT_PLANNED = "there is no plan"
    NOT_PLANNED_HERE = "there is no plan from the moving robot, perhaps one from a standstill"
    NEXT_PLANNED = "the plan by which the next sentence continues this one is there"
    NEXT_NOT_PLANNED = "the next sentence cannot be signed"
    NEXT_NOT_PLANNED_HERE = "the next sentence cannot continue this one"
    # What the driver says.
    BLOCKED = "the driver was stopped, is inactive or at fault"
    PAUSED = "the driver is paused"
    MOTION_REFUSED = "the driver refuses the motion in force"
    CONTINUATION_REFUSED = "the driver refuses what was to continue the motion"
    STOP_REFUSED = "the driver refuses a stop"
    # What joint states and the clock show.
    LOST = "joint states are stale"
    TAKEN_OVER = "the continuation is in force"
    TAKEN_OVER_CANCELED = "the same, of a sentence that was canceled meanwhile"
    REACHED = "the robot stands at the end of its motion"
    PLAN_DUE = "it stands at the end of the opening, the plan is there"
    NOT_FOLLOWED = "the robot does not follow its motion, or misses its end"
    NO_WAY = "the way to rest cannot be planned, or has failed too often"
    STANDS = "the robot has come to a standstill"
    STILL_MOVING = "the robot should stand and does not"
    TICK = "a step of the clock"
    SENTENCE_DUE = "a motion may begin, a sentence waits"
    REST_DUE = "a motion may begin, the robot is to go to rest"
    AT_REST = "the same, and it is at rest"
