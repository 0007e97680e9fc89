# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np
import pytest

from teo_description import COMMANDED_JOINTS
from teo_lut_executor.execution.events import (
    Activity,
    Event,
    Finished,
    Outcome,
    PlanWanted,
    QueueSettings,
    ReturnWanted,
    Sentence,
    Status,
    TrajectoryReady,
)
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_motion.planner import Planner
from teo_motion.sentence.composition import REST
from teo_motion.sentence.plan import Plan
from teo_signs.errors import PlanError
from teo_signs.sign import Sign
from teo_signs.tokens import parse_printed

TICK = 0.02


class World:
    """A queue, its planner, a clock, and a robot that follows what it is sent (or not)."""

    def __init__(self, table: Mapping[str, Sign], settings: QueueSettings | None = None) -> None:
        self.planner = Planner(table)
        self.queue = ExecutionQueue(self.planner.limits, settings)
        self.now = 100.0
        self.listening = True
        self.publishes_states = True
        self.follows: Callable[[TrajectoryReady], bool] = lambda _: True
        self.sent: list[TrajectoryReady] = []
        self.events: list[Event] = []
        self._motion: Plan | None = None
        self._begin = 0.0
        self.positions = REST.copy()
        self.velocities = np.zeros(REST.size)
        self.lag = 0.0  # of the robot behind what it was sent [s]

    def sign(self, text: str, **fields: object) -> int:
        sentence = Sentence(tokens=parse_printed(text), **fields)  # type: ignore[arg-type]
        ticket, events = self.queue.submit(sentence, self.now)
        self.take(events)
        return ticket

    def cancel(self, ticket: int) -> None:
        self.take(self.queue.cancel(ticket, self.now))

    def take(self, events: Iterable[Event]) -> None:
        to_do = list(events)
        while to_do:
            event = to_do.pop(0)
            self.events.append(event)
            if isinstance(event, PlanWanted):
                try:
                    plan = self.planner.plan(event.sentence.tokens, event.start)
                except PlanError as error:
                    to_do += self.queue.not_planned(error, self.now)
                else:
                    to_do += self.queue.planned(plan, self.now)
            elif isinstance(event, ReturnWanted):
                to_do += self.queue.return_planned(self.planner.plan_to_rest(event.start), self.now)
            elif isinstance(event, TrajectoryReady):
                self.sent.append(event)
                if self.follows(event):
                    self._motion, self._begin = event.plan, self.now + event.lead

    def run(self, seconds: float) -> None:
        end = self.now + seconds
        while self.now < end:
            self.tick()

    def run_until(self, condition: Callable[[], bool], most: float = 120.0) -> None:
        end = self.now + most
        while not condition():
            assert self.now < end, f"not within {most} s"
            self.tick()

    def tick(self) -> None:
        self.now += TICK
        if self._motion is not None and self.now >= self._begin:
            elapsed = max(0.0, self.now - self._begin - self.lag)
            self.positions, self.velocities, _ = self._motion.at(elapsed)
        if self.publishes_states:
            state = self.positions.tolist(), self.velocities.tolist()
            self.queue.joint_states(COMMANDED_JOINTS, *state, self.now)
        self.take(self.queue.step(self.now, listening=self.listening))

    def finished(self) -> list[tuple[int, Outcome]]:
        return [(event.ticket, event.outcome) for event in self.events if isinstance(event, Finished)]

    def statuses(self) -> list[Status]:
        return [event for event in self.events if isinstance(event, Status)]

    def activities(self) -> list[Activity]:
        return [status.activity for status in self.statuses()]


@pytest.fixture
def world(table: Mapping[str, Sign]) -> World:
    return World(table)


def test_it_begins_idle(world: World) -> None:
    world.run(1.0)
    assert world.activities() == [Activity.IDLE]


def test_a_sentence_is_signed_and_then_all_is_idle(world: World) -> None:
    world.run(0.1)
    ticket = world.sign("TÚ A-N", utterance_id="text", index=1, count=2)
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.SUCCESS)]
    idle, signing, again = world.statuses()
    assert [idle.activity, signing.activity, again.activity] == [
        Activity.IDLE,
        Activity.SIGNING,
        Activity.IDLE,
    ]
    assert signing.sentence is not None and signing.plan is not None
    assert (signing.sentence.utterance_id, signing.sentence.index, signing.sentence.count) == ("text", 1, 2)
    assert [timing.token.gloss for timing in signing.plan.timings] == ["TÚ", "A", "N"]
    assert again.stamp == pytest.approx(signing.stamp + signing.plan.duration, abs=0.1)


def test_sentences_are_signed_in_the_order_in_which_they_came(world: World) -> None:
    tickets = [world.sign(text) for text in ("TÚ", "A", "N", "CASA")]
    world.run_until(lambda: len(world.finished()) == 4)
    assert world.finished() == [(ticket, Outcome.SUCCESS) for ticket in tickets]
    signing = [status for status in world.statuses() if status.activity == Activity.SIGNING]
    assert [status.queued for status in signing] == [3, 2, 1, 0]
    assert world.activities()[-1] == Activity.IDLE


def test_a_refused_sentence_does_not_hold_up_the_next(world: World) -> None:
    bad, good = world.sign("Ω"), world.sign("TÚ")
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(bad, Outcome.REFUSED), (good, Outcome.SUCCESS)]
    refused = next(status for status in world.statuses() if status.activity == Activity.REFUSED)
    assert refused.code == "unknown_sign" and "Ω" in refused.message
    assert refused.sentence is not None and refused.sentence.tokens[0].gloss == "Ω"


def test_too_many_sentences_are_refused_with_the_reason(table: Mapping[str, Sign]) -> None:
    world = World(table, QueueSettings(capacity=2))
    world.run(0.1)
    tickets = []
    for _ in range(4):
        tickets.append(world.sign("TÚ"))
        world.tick()
    assert world.finished() == [(tickets[3], Outcome.REFUSED)]
    assert world.statuses()[-1].code == "queue_full"
    world.run_until(lambda: len(world.finished()) == 4)
    assert [outcome for _, outcome in world.finished()[1:]] == [Outcome.SUCCESS] * 3


def test_it_waits_for_joint_states_and_for_a_driver_and_says_so_once(world: World) -> None:
    world.publishes_states = world.listening = False
    world.run(0.1)
    world.sign("TÚ")
    world.run(5.0)
    assert world.activities() == [Activity.IDLE, Activity.WAITING]
    assert "joint_states of AxialNeck" in world.statuses()[-1].message
    world.publishes_states = True
    world.run(1.0)
    assert "joint_trajectory" in world.statuses()[-1].message
    assert world.sent == []
    world.listening = True
    world.run_until(lambda: bool(world.finished()))
    assert world.activities()[-2:] == [Activity.SIGNING, Activity.IDLE]


def test_a_start_from_old_joint_states_is_refused(world: World) -> None:
    world.run(0.1)
    world.publishes_states = False
    world.run(1.0)
    old = world.sign("TÚ")
    world.tick()
    assert world.finished() == [(old, Outcome.REFUSED)]
    assert world.statuses()[-2].code == "stale_joint_states"
    world.publishes_states = True
    world.run(0.1)
    new = world.sign("TÚ")
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (new, Outcome.SUCCESS)


def test_a_robot_that_does_not_move_is_noticed_while_signing(world: World) -> None:
    world.run(0.1)
    world.follows = lambda _: False
    stuck = world.sign("TÚ")
    world.run_until(lambda: bool(world.finished()), most=3.0)
    assert world.finished() == [(stuck, Outcome.NOT_REACHED)]
    assert world.statuses()[-2].code == "not_followed"


def test_an_end_that_is_not_reached_is_reported_and_the_next_sentence_starts_from_there(
    table: Mapping[str, Sign],
) -> None:
    world = World(table, QueueSettings(path_tolerance=10.0, goal_time=1.0))
    world.run(0.1)
    first = world.sign("TÚ")
    world.tick()
    plan = world.sent[0].plan
    world.run(plan.duration - 0.5)
    world._motion = None  # stands still half a second before the end
    stopped = world.positions.copy()
    second = world.sign("A")
    world.run_until(lambda: bool(world.finished()), most=2.0)
    assert world.finished() == [(first, Outcome.NOT_REACHED)]
    assert any(status.code == "not_reached" for status in world.statuses())
    np.testing.assert_array_equal(world.sent[1].plan.positions[0], stopped)
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (second, Outcome.SUCCESS)


def test_a_sentence_that_waits_can_be_canceled(world: World) -> None:
    first, second, third = (world.sign(text) for text in ("TÚ", "A", "N"))
    world.run(1.0)
    world.cancel(second)
    assert world.finished() == [(second, Outcome.CANCELED)]
    world.run_until(lambda: len(world.finished()) == 3)
    assert world.finished()[1:] == [(first, Outcome.SUCCESS), (third, Outcome.SUCCESS)]


def test_a_canceled_sentence_goes_back_to_rest_smoothly_and_the_next_begins(world: World) -> None:
    world.run(0.1)
    ticket, following = world.sign("A-N-A-N-A-N"), world.sign("TÚ")
    world.run(5.0)
    world.cancel(ticket)
    world.cancel(ticket)  # twice is as good as once
    assert len(world.sent) == 2
    back = world.sent[1]
    assert 0.1 <= back.lead <= 0.6
    full, _ = world.sent[0].plan, world.positions
    limits = world.planner.limits
    moving = full.at(4.98)[1]
    assert (np.abs(back.plan.positions[0] - world.positions) <= np.abs(moving) * back.lead + 0.05).all()
    assert (back.plan.velocities[0] == 0.0).all()
    assert (back.plan.positions >= limits.lower).all() and (back.plan.positions <= limits.upper).all()
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.CANCELED)]
    assert world.now < 100.0 + full.duration
    np.testing.assert_allclose(world.positions, REST, atol=0.02)
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (following, Outcome.SUCCESS)


def test_a_sentence_canceled_on_its_way_to_rest_just_ends(world: World) -> None:
    world.run(0.1)
    ticket = world.sign("TÚ")
    world.tick()
    world.run(world.sent[0].plan.duration - 0.5)
    world.cancel(ticket)
    world.run_until(lambda: bool(world.finished()))
    assert len(world.sent) == 1
    assert world.finished() == [(ticket, Outcome.CANCELED)]


def test_a_way_back_that_the_driver_refuses_is_sent_again(world: World) -> None:
    world.run(0.1)
    ticket = world.sign("A-N-A-N-A-N")
    world.run(4.0)
    world.follows = lambda event: event.lead == 0.0 or len(world.sent) >= 3
    world.cancel(ticket)
    world.run_until(lambda: bool(world.finished()))
    assert len(world.sent) == 3
    assert world.finished() == [(ticket, Outcome.CANCELED)]


def test_an_unknown_ticket_cancels_nothing(world: World) -> None:
    world.sign("TÚ")
    world.run(1.0)
    world.cancel(99)
    world.run_until(lambda: bool(world.finished()))
    assert world.finished()[0][1] == Outcome.SUCCESS


def test_progress_names_the_token_that_is_signed(world: World) -> None:
    world.run(0.1)
    assert world.queue.progress(world.now) is None
    ticket = world.sign("TÚ A-N")
    seen = []
    while not world.finished():
        world.tick()
        progress = world.queue.progress(world.now)
        if progress is not None:
            assert progress.ticket == ticket and progress.stretch >= 1.0
            seen.append((progress.token, progress.gloss, progress.fraction))
    assert [index for index, _, _ in seen] == sorted(index for index, _, _ in seen)
    assert {(index, gloss) for index, gloss, _ in seen} == {
        (0, ""),
        (0, "TÚ"),
        (1, ""),
        (1, "A"),
        (2, ""),
        (2, "N"),
    }
    fractions = [fraction for _, _, fraction in seen]
    assert fractions == sorted(fractions) and fractions[0] >= 0.0 and fractions[-1] <= 1.0


def test_a_clock_that_is_set_back_does_not_stop_the_signing(world: World) -> None:
    world.run(0.1)
    ticket = world.sign("TÚ")
    world.run(2.0)
    world.now -= 90.0
    world._begin -= 90.0
    world.run_until(lambda: bool(world.finished()), most=10.0)
    assert world.finished() == [(ticket, Outcome.SUCCESS)]


@pytest.mark.parametrize(
    ("positions", "velocities"),
    [([np.nan] * 28, []), ([0.0] * 27, []), ([0.0] * 28, [0.0]), ([0.0] * 28, [np.inf] * 28)],
)
def test_a_joint_state_that_is_none_is_not_taken(
    world: World, positions: list[float], velocities: list[float]
) -> None:
    world.publishes_states = False
    assert world.queue.joint_states(COMMANDED_JOINTS, positions, velocities, world.now)
    world.sign("TÚ")
    world.run(0.1)
    assert world.activities() == [Activity.WAITING]


def test_joint_states_may_come_from_several_publishers(world: World) -> None:
    world.publishes_states = False
    half = len(COMMANDED_JOINTS) // 2
    world.queue.joint_states(COMMANDED_JOINTS[:half], REST[:half].tolist(), [], world.now)
    world.queue.joint_states(("LeftKnee",), [0.3], [], world.now)
    world.sign("TÚ")
    world.tick()
    assert COMMANDED_JOINTS[half] in world.statuses()[-1].message
    world.queue.joint_states(COMMANDED_JOINTS[half:], REST[half:].tolist(), [], world.now)
    world.tick()
    assert len(world.sent) == 1


def test_the_next_sentence_waits_for_a_robot_that_is_late_to_stand_still(world: World) -> None:
    world.lag = 0.15  # at the planned end it is within the tolerance of rest, and still moving there
    first, second = world.sign("A"), world.sign("A")
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.SUCCESS)]
    starts = [event.start for event in world.events if isinstance(event, PlanWanted)]
    np.testing.assert_array_equal(starts[1].velocity, 0.0)
    np.testing.assert_allclose(starts[1].position, REST, atol=1e-3)
