# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The table of states and events is complete, printed as it is, and kept to whatever happens."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from made_signs import small_table

from queue_world import World
from teo_lut_executor.execution.interface import (
    Begun,
    DriverMode,
    Effect,
    Finished,
    Preemption,
    QueueSettings,
    StopReady,
    TrajectoryReady,
)
from teo_lut_executor.execution.table import TABLE, Event, printed
from teo_lut_executor.execution.work import State

README = Path(__file__).parents[1] / "README.md"
STANDS_STILL = (DriverMode.STOPPED, DriverMode.PAUSED, DriverMode.INACTIVE, DriverMode.FAULT)
TEXTS = ("TÚ", "A-N", "A-N-A", "Ω")
SECONDS = st.sampled_from((0.02, 0.1, 0.4, 1.0, 2.5))
STEPS = st.lists(
    st.one_of(
        st.tuples(st.just("sign"), st.sampled_from(TEXTS)),
        st.tuples(st.just("cancel"), st.integers(0, 5)),
        st.tuples(st.just("driver"), st.sampled_from(DriverMode)),
        st.tuples(st.just("hears"), st.booleans()),
        st.tuples(st.just("active"), st.booleans()),
        st.tuples(st.just("takes motions"), st.booleans()),
        st.tuples(st.sampled_from(("clear", "refuse", "push")), st.none()),
    ),
    min_size=4,
    max_size=12,
)


class WatchedWorld(World):
    """A world that sees what a user may rely on, at every effect."""

    mode = DriverMode.HOLDING

    def take(self, events: Iterable[Effect]) -> None:
        events = list(events)
        for event in events:
            sent = isinstance(event, TrajectoryReady | StopReady)
            assert not (sent and self.mode in STANDS_STILL), f"sent to a driver that is {self.mode.name}"
        super().take(events)
        ended = {event.ticket for event in self.events if isinstance(event, Finished)}
        begun = {event.ticket for event in self.events if isinstance(event, Begun)}
        assert len(begun - ended) <= 1, "one sentence after the other"

    def driver_says(self, mode: DriverMode, *, speed_scaling: float = 1.0) -> None:
        self.mode = mode
        if mode is DriverMode.PAUSED:
            self.velocities = np.zeros_like(self.velocities)
        super().driver_says(mode, speed_scaling=speed_scaling)

    def do(self, what: str, value: object, tickets: list[int]) -> None:
        match what, value:
            case "sign", str(text):
                tickets.append(self.sign(text, utterance_id=f"{len(tickets)}"))
            case "cancel", int(which) if tickets:
                self.cancel(tickets[which % len(tickets)])
            case "driver", DriverMode() as mode:
                self.driver_says(mode)
            case "hears", bool(hears):
                self.publishes_states = hears
            case "active", bool(active):
                self.obstacle = "" if active else "not active"
                if not active:
                    self.take(self.queue.deactivate(self.now))
            case "takes motions", bool(takes):
                self.accepts = lambda _: takes
            case "clear", _:
                self.take(self.queue.clear(self.now))
            case "refuse", _ if self.sent:
                self.take(self.queue.driver_refused(self.sent[-1].number, "[no] no", self.now))
            case "push", _:  # the driver forgets its motion
                self._motions, self.velocities = [], np.zeros_like(self.velocities)


def test_every_event_is_answered() -> None:
    assert set(TABLE) == set(Event)


def test_the_readme_prints_the_table() -> None:
    assert printed() in README.read_text(encoding="utf-8")


@settings(max_examples=12)
@given(
    walk=STEPS,
    waits=st.lists(SECONDS, min_size=12, max_size=12),
    planning_time=st.sampled_from((0.0, 0.2, 0.6)),
    opening_time=st.sampled_from((None, 0.4)),
    preemption=st.sampled_from(Preemption),
)
def test_whatever_happens_each_sentence_ends_once_and_nothing_moves_a_robot_that_is_to_stand(
    walk: list[tuple[str, object]],
    waits: list[float],
    planning_time: float,
    opening_time: float | None,
    preemption: Preemption,
) -> None:
    world = WatchedWorld(small_table(), QueueSettings(preemption=preemption))
    world.planning_time, world.opening_time = planning_time, opening_time
    world.run(0.1)
    tickets: list[int] = []
    for (what, value), wait in zip(walk, waits, strict=False):
        world.do(what, value, tickets)
        world.run(wait)
    for what, value in (("driver", DriverMode.HOLDING), ("hears", True), ("active", True)):
        world.do(what, value, tickets)
    world.do("takes motions", True, tickets)
    world.run_until(lambda: len(world.finished()) >= len(tickets) and world.queue.state is State.STANDING)
    assert Counter(ticket for ticket, _ in world.finished()) == Counter(tickets)
