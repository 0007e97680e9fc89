# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The table by which an executor acts: for each event and state what is done, and the state after it.

An event comes with what its action takes, e.g. the plan or the reason; see the actions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from teo_lut_executor.execution import joining, signing, stopping
from teo_lut_executor.execution.events import Effect
from teo_lut_executor.execution.states import Event, State
from teo_lut_executor.execution.work import Work


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
        Event.OPENED: when((planning,), signing.open_sentence, opening),
        Event.PLANNED: when((planning,), signing.sign, signs)
        | when((planning_rest,), signing.go_to_rest, returning)
        | when((opening,), signing.continue_opening, opening),
        Event.NOT_PLANNED: when((planning,), signing.refuse, standing)
        | when((opening,), stopping.refuse_opened, stops),
        Event.NOT_PLANNED_HERE: when((planning,), signing.refuse, standing)
        | when((opening,), signing.plan_from_end, opening),
        Event.NEXT_PLANNED: when((signs,), joining.keep_next_plan, signs),
        Event.NEXT_NOT_PLANNED: when((signs,), joining.refuse_next, signs),
        Event.NEXT_NOT_PLANNED_HERE: when((signs,), joining.leave_next, signs),
        Event.BLOCKED: when(anywhere, stopping.end_blocked, stops),
        Event.PAUSED: when(in_planning, stopping.put_back, standing),
        Event.MOTION_REFUSED: when(to_sign, stopping.give_up, stops)
        | when((returning,), stopping.try_rest_again, stops),
        Event.CONTINUATION_REFUSED: when((opening,), signing.plan_from_end, opening)
        | when((signs,), joining.withdraw_next, signs),
        Event.STOP_REFUSED: when((stops,), stopping.owe_stop, stops),
        Event.LOST: when((*in_planning, *to_sign, returning), stopping.give_up, stops),
        Event.TAKEN_OVER: when((opening,), signing.begin_plan, signs)
        | when((signs,), joining.begin_next, signs),
        Event.TAKEN_OVER_CANCELED: when((signs,), stopping.begin_next_and_stop, stops),
        Event.REACHED: when(to_sign, signing.finish, standing)
        | when((returning,), stopping.arrive, standing),
        Event.PLAN_DUE: when((opening,), signing.depart, signs),
        Event.NOT_FOLLOWED: when(to_sign, stopping.give_up, stops)
        | when((returning,), stopping.try_rest_again, stops),
        Event.NO_WAY: when((planning_rest, returning), stopping.stay, standing),
        Event.STANDS: when((stops,), _nothing, standing),
        Event.STILL_MOVING: when((stops,), stopping.stop_again, stops),
        Event.TICK: when((signs,), joining.prepare_next, signs),
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
    """The table as Markdown, after lists of what its states and events mean."""
    states = [f"| {_name(state)} | {state.value} |" for state in State]
    lines = ["| state | meaning |", "|---|---|", *states, ""]
    names = " | ".join(_name(state) for state in State)
    lines += [f"| event | {names} |", "|" + "---|" * (len(State) + 1)]
    for event, row in TABLE.items():
        cells = (_printed_cell(state, cell) for state, cell in row.items())
        lines.append(f"| {event.value} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _printed_cell(state: State, cell: _Cell) -> str:
    if cell == _Cell(_nothing, state):
        return "–"
    action = "" if cell.action is _nothing else cell.action.__name__.replace("_", " ")
    after = "" if cell.after is state else f"→ **{_name(cell.after)}**"
    return f"{action} {after}".strip()


def _name(state: State) -> str:
    return state.name.lower().replace("_", " ")
