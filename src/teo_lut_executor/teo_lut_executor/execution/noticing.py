# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which event has happened, as far as the clock, the joint states and the driver's word show it.

Each function tells the event and what its action takes, or None if nothing of the kind has happened.
"""

from __future__ import annotations

from teo_lut_executor.execution.events import DriverMode
from teo_lut_executor.execution.states import Event, State
from teo_lut_executor.execution.work import Work
from teo_signs.errors import PlanError

# How often the way to rest is tried after an interrupted sentence, before the robot is left where it is.
_MOST_RETURNS = 3

Notice = tuple[Event, object] | None


def block(work: Work) -> Notice:
    """Whether the driver takes nothing more of what is going on."""
    situation = work.situation
    if situation.driver is None or situation.block is None:
        return None
    idle = work.current is None and work.interrupted is None
    if idle and work.state in (State.STANDING, State.STOPPING):
        return None
    code, meaning = situation.block
    said = situation.driver.message
    return Event.BLOCKED, PlanError(code, f"{said}: {meaning}" if said else meaning)


def pause(work: Work) -> Notice:
    """Whether the driver is paused."""
    return (Event.PAUSED, None) if work.situation.mode is DriverMode.PAUSED else None


def _silence(work: Work) -> Notice:
    """Whether nothing is heard of the robot."""
    if not work.situation.is_stale:
        return None
    return Event.LOST, PlanError("stale_joint_states", work.situation.hindrance)


def _take_over(work: Work) -> Notice:
    """Whether the time of the continuation has come."""
    if work.continuation is None or work.continuation.elapsed < 0.0:
        return None
    canceled = work.state is State.SIGNING and work.waiting[0].canceled
    return (Event.TAKEN_OVER_CANCELED if canceled else Event.TAKEN_OVER), None


def _course(work: Work) -> Notice:
    """Whether the robot follows its motion, is at its end, or has come to a standstill."""
    if work.state is State.STOPPING:
        if work.halt.stands:
            return Event.STANDS, None
        return (Event.STILL_MOVING, None) if work.halt.is_overdue else None
    motion, situation = work.motion, work.situation
    if motion is None:
        return None
    continues, age = work.continuation is not None, situation.age * situation.pace
    if motion.is_reached(situation.robot, age) and not continues:
        return _end_of(work)
    problem = motion.problem(situation.robot, age)
    if problem is None or (problem.code == "not_reached" and continues):
        return None
    return failure(work, Event.NOT_FOLLOWED, problem)


def cancellation(work: Work) -> Event:
    """What it means that the current sentence is to end."""
    current, motion = work.current, work.motion
    if work.state is not State.SIGNING or current is None or motion is None or work.continuation is not None:
        return Event.CANCELED
    last = motion.motion.timings[-1]
    return Event.CANCELED_LATE if motion.elapsed >= last.start + last.duration else Event.CANCELED


def failure(work: Work, event: Event, error: PlanError) -> tuple[Event, PlanError]:
    """What it means that the robot did not do what it was sent."""
    last = work.state is State.RETURNING and work.returns + 1 >= _MOST_RETURNS
    return (Event.NO_WAY if last else event), error


def _early_plan(work: Work) -> Notice:
    """Whether a plan has been kept."""
    return None if work.early is None else (Event.PLANNED, work.early)


def _tick(_: Work) -> Notice:
    """That time passes."""
    return Event.TICK, None


def _standstill(work: Work) -> Notice:
    """Whether a motion may begin, and which."""
    if work.state is not State.STANDING or work.situation.hindrance:
        return None
    if work.current is None and work.waiting:
        return Event.SENTENCE_DUE, None
    if work.current is None and not work.astray:
        return None
    return (Event.AT_REST if work.situation.at_rest else Event.REST_DUE), None


def _end_of(work: Work) -> Notice:
    """What it means that the robot stands at the end of its motion."""
    current = work.current
    if work.state is not State.OPENING or current is None or current.canceled:
        return Event.REACHED, None
    if current.plan is None or work.situation.hindrance:
        return None
    return Event.PLAN_DUE, None


#: What a step of the clock looks for, in order.
STEP = (block, pause, _silence, _take_over, _course, _early_plan, _tick, _standstill)
