# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The table by which an executor acts: what has happened, what is done in each state, and the state after it.

An event comes with what its action takes, e.g. the plan or the reason; see the actions in `signing` and
`stopping`.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from teo_lut_executor.execution import signing, stopping
from teo_lut_executor.execution.interface import DriverMode, Effect
from teo_lut_executor.execution.work import State, Work
from teo_signs.errors import PlanError


class Event(enum.Enum):
    """What can happen; the value says it to people."""

    # What people want of the current sentence.
    CANCELED = "the current sentence is to end"
    CANCELED_LATE = "the same, after its last sign, on the way to rest"
    REPLACED = "a newer text takes the place of a sentence that is planned"
    DEACTIVATED = "the executor is deactivated"
    CLEARED = "the queue is cleared"
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


# How often the way to rest is tried after an interrupted sentence, before the robot is left where it is.
_MOST_RETURNS = 3

#: An event and what its action takes; None if nothing of the kind has happened.
Notice = tuple[Event, object] | None


def notice_block(work: Work) -> Notice:
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


def notice_pause(work: Work) -> Notice:
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
    return failure_event(work, Event.NOT_FOLLOWED, problem)


def cancellation_event(work: Work) -> Event:
    """What it means that the current sentence is to end."""
    current, motion = work.current, work.motion
    if work.state is not State.SIGNING or current is None or motion is None or work.continuation is not None:
        return Event.CANCELED
    last = motion.plan.timings[-1]
    return Event.CANCELED_LATE if motion.elapsed >= last.start + last.duration else Event.CANCELED


def failure_event(work: Work, event: Event, error: PlanError) -> tuple[Event, PlanError]:
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
NOTICES = (notice_block, notice_pause, _silence, _take_over, _course, _early_plan, _tick, _standstill)


class _Cell(NamedTuple):
    """What an event brings about in a state.

    Attributes:
        action: Changes the work, and says what is to be done.
        after: The state after it.
    """

    action: Callable[[Work, Any], list[Effect]]
    after: State


def _nothing(_work: Work, _given: object) -> list[Effect]:
    """The event changes nothing in this state."""
    return []


def _rows() -> Mapping[Event, Mapping[State, _Cell]]:
    """What is done; in the states that a row leaves out, nothing."""
    standing, planning, planning_rest = State.STANDING, State.PLANNING, State.PLANNING_REST
    opening, signs, stops, returning = State.OPENING, State.SIGNING, State.STOPPING, State.RETURNING
    in_planning = (planning, planning_rest)
    to_sign = (opening, signs)
    anywhere = tuple(State)

    def when(states: tuple[State, ...], action: Callable[[Work, Any], list[Effect]], after: State) -> Any:
        return dict.fromkeys(states, _Cell(action, after))

    return {
        Event.CANCELED: when((planning,), stopping.cancel_before_it_began, standing)
        | when(to_sign, stopping.cancel, stops),
        Event.CANCELED_LATE: when((signs,), stopping.end_at_rest, signs),
        Event.REPLACED: when((opening,), stopping.end_when_replaced, opening)
        | when((signs,), stopping.end_when_replaced, signs),
        Event.DEACTIVATED: when(anywhere, stopping.deactivate, stops),
        Event.CLEARED: when((planning,), stopping.put_back, standing),
        Event.OPENED: when((planning,), signing.open_sentence, opening),
        Event.PLANNED: when((planning,), signing.sign, signs)
        | when((planning_rest,), signing.go_to_rest, returning)
        | when((opening,), signing.continue_opening, opening),
        Event.NOT_PLANNED: when((planning,), signing.refuse, standing)
        | when((opening,), stopping.refuse_opened, stops),
        Event.NOT_PLANNED_HERE: when((planning,), signing.refuse, standing)
        | when((opening,), signing.plan_from_end, opening),
        Event.NEXT_PLANNED: when((signs,), signing.keep_next_plan, signs),
        Event.NEXT_NOT_PLANNED: when((signs,), signing.refuse_next, signs),
        Event.NEXT_NOT_PLANNED_HERE: when((signs,), signing.leave_next, signs),
        Event.BLOCKED: when(anywhere, stopping.end_blocked, stops),
        Event.PAUSED: when(in_planning, stopping.put_back, standing),
        Event.MOTION_REFUSED: when(to_sign, stopping.give_up, stops)
        | when((returning,), stopping.try_rest_again, stops),
        Event.CONTINUATION_REFUSED: when((opening,), signing.plan_from_end, opening)
        | when((signs,), signing.withdraw_next, signs),
        Event.STOP_REFUSED: when((stops,), stopping.owe_stop, stops),
        Event.LOST: when((*in_planning, *to_sign, returning), stopping.give_up, stops),
        Event.TAKEN_OVER: when((opening,), signing.begin_plan, signs)
        | when((signs,), signing.begin_next, signs),
        Event.TAKEN_OVER_CANCELED: when((signs,), stopping.begin_next_and_stop, stops),
        Event.REACHED: when(to_sign, signing.finish, standing)
        | when((returning,), stopping.arrive, standing),
        Event.PLAN_DUE: when((opening,), signing.depart, signs),
        Event.NOT_FOLLOWED: when(to_sign, stopping.give_up, stops)
        | when((returning,), stopping.try_rest_again, stops),
        Event.NO_WAY: when((planning_rest, returning), stopping.stay, standing),
        Event.STANDS: when((stops,), _nothing, standing),
        Event.STILL_MOVING: when((stops,), stopping.stop_again, stops),
        Event.TICK: when((signs,), signing.prepare_next, signs),
        Event.SENTENCE_DUE: when((standing,), signing.plan_sentence, planning),
        Event.REST_DUE: when((standing,), signing.plan_rest, planning_rest),
        Event.AT_REST: when((standing,), stopping.arrive, standing),
    }


#: Every state answers every event.
TABLE: Mapping[Event, Mapping[State, _Cell]] = {
    event: {state: row.get(state, _Cell(_nothing, state)) for state in State}
    for event, row in _rows().items()
}


def happen(work: Work, event: Event, given: object = None) -> list[Effect]:
    """Let an event happen.

    Args:
        work: What is under way; its state becomes the one after the event.
        event: What happens.
        given: What the action takes.

    Returns:
        What is to be done, in order.
    """
    action, after = TABLE[event][work.state]
    effects = action(work, given)
    work.state = after
    return effects


def printed() -> str:
    """The table as Markdown, after a list of what its states mean."""
    states = [f"| {_name(state)} | {state.value} |" for state in State]
    lines = ["| state | meaning |", "|---|---|", *states, ""]
    lines += ["| event | in which state: what is done → the state after it |", "|---|---|"]
    for event, row in TABLE.items():
        answers: dict[_Cell, list[State]] = {}
        for state, cell in row.items():
            if cell != _Cell(_nothing, state):
                answers.setdefault(cell, []).append(state)
        lines.append(f"| {event.value} | {'; '.join(_printed(*answer) for answer in answers.items())} |")
    return "\n".join(lines) + "\n"


def _printed(cell: _Cell, states: Sequence[State]) -> str:
    before = "always" if len(states) == len(State) else ", ".join(map(_name, states))
    action = "" if cell.action is _nothing else f" {cell.action.__name__.replace('_', ' ')}"
    after = "" if set(states) == {cell.after} else f" → **{_name(cell.after)}**"
    return f"{before}:{action}{after}"


def _name(state: State) -> str:
    return state.name.lower().replace("_", " ")
