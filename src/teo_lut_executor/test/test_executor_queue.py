# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from queue_world import World
from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.interface import (
    Activity,
    DriverMode,
    DriverReport,
    Outcome,
    PlanWanted,
    QueueSettings,
    ReturnWanted,
)
from teo_names import COMMANDED_JOINTS
from teo_signs.sign import Sign
from teo_signs.tokens import parse_printed

REST = load_humanoid().ready


@pytest.fixture
def unheard(table: Mapping[str, Sign]) -> World:
    """A world in which the robot has not been heard yet."""
    world = World(table)
    world.publishes_states = False
    return world


def test_too_many_sentences_are_refused_with_the_reason(table: Mapping[str, Sign]) -> None:
    world = World(table, QueueSettings(capacity=2))
    world.run(0.1)
    tickets = []
    for _ in range(4):
        tickets.append(world.sign("TÚ"))
        world.tick()
    assert world.finished() == [(tickets[3], Outcome.REFUSED)]
    assert [status.code for status in world.statuses() if status.code] == ["queue_full"]
    world.run_until(lambda: len(world.finished()) == 4)
    assert [outcome for _, outcome in world.finished()[1:]] == [Outcome.SUCCESS] * 3


def test_it_waits_for_joint_states_and_for_a_driver_and_says_so_once(unheard: World) -> None:
    unheard.obstacle = "waiting for a driver to take joint_trajectory"
    unheard.run(0.1)
    unheard.sign("TÚ")
    unheard.run(5.0)
    assert set(unheard.activities()) == {Activity.WAITING} and len(unheard.statuses()) == 2
    assert "joint_states of AxialNeck" in unheard.statuses()[-1].message
    unheard.publishes_states = True
    unheard.run(1.0)
    assert "joint_trajectory" in unheard.statuses()[-1].message
    assert unheard.sent == []
    unheard.obstacle = ""
    unheard.run_until(lambda: bool(unheard.finished()))
    assert unheard.activities()[-2:] == [Activity.SIGNING, Activity.IDLE]


def test_a_robot_that_does_not_move_is_noticed_while_signing(world: World) -> None:
    world.follows = lambda _: False
    stuck = world.sign("TÚ", utterance_id="stuck")
    world.run_until(lambda: bool(world.finished()), most=6.0)
    assert world.finished() == [(stuck, Outcome.NOT_REACHED)]
    named = [status for status in world.statuses() if status.code]
    assert [(status.activity, status.code) for status in named] == [
        (Activity.FAULT, "not_followed"),  # it is tried once more
        (Activity.REFUSED, "not_followed"),
    ]
    assert {status.sentence.utterance_id for status in named if status.sentence} == {"stuck"}
    world.run(10.0)
    assert len(world.sent) < 10, "a robot that cannot be brought to rest is left alone after some tries"


def test_a_robot_that_stops_following_is_stopped_and_the_sentence_signed_again(world: World) -> None:
    first, second = world.sign("A-N-A-N"), world.sign("TÚ")
    world.run(2.5)
    elsewhere = world.planner.plan(parse_printed("CASA"))
    world._motions = [(world._path_time - 1.0, elsewhere)]  # somebody else has it sign
    world.run_until(lambda: bool(world.stops), most=3.0)
    starts = len([event for event in world.events if isinstance(event, PlanWanted)])
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.SUCCESS)]
    again = [event for event in world.events if isinstance(event, PlanWanted)][starts]
    assert not again.start.velocity.any(), "planned from a standstill"


def test_a_robot_that_is_late_on_its_path_follows_it(world: World) -> None:
    world.lag = 0.45  # a driver that waits for a processor
    ticket = world.sign("TÚ A")
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.SUCCESS)]
    assert not any(status.code for status in world.statuses())


def test_a_continuation_refused_at_the_second_attempt_does_not_end_the_sentence(world: World) -> None:
    world.opening_time, world.planning_time = 0.4, 1.5  # the first attempt goes on from a standstill
    ticket = world.sign("TÚ A")
    world.run_until(lambda: len(world.sent) == 2)
    world.follows = lambda _: False
    world._motions = []
    world.run_until(lambda: any(status.code == "not_followed" for status in world.statuses()))
    world.follows, world.planning_time = lambda _: True, 0.1
    world.accepts = lambda motion: motion.start is None  # continuations come too late
    world.run_until(lambda: bool(world.finished()))
    assert world.refused
    assert world.finished() == [(ticket, Outcome.SUCCESS)]


def test_a_silent_robot_is_told_within_a_second_and_the_sentence_signed_when_it_is_back(world: World) -> None:
    first, second = world.sign("TÚ", utterance_id="first"), world.sign("A")
    world.run(2.0)
    world.publishes_states = False  # the driver was killed
    world._motions = []
    began = world.now
    world.run_until(lambda: world.activities()[-1] == Activity.FAULT, most=1.0)
    assert world.now - began < 1.0
    assert world.statuses()[-1].code == "stale_joint_states"
    assert any(s.sentence and s.sentence.utterance_id == "first" for s in world.statuses() if s.code)
    world.run(3.0)
    assert world.finished() == []
    world.positions, world.velocities = REST.copy(), np.zeros(REST.size)  # started again, at rest
    world.publishes_states = True
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.SUCCESS)]


def test_an_end_that_is_not_reached_is_reported_and_the_next_sentence_starts_from_there(
    table: Mapping[str, Sign],
) -> None:
    world = World(table, QueueSettings(path_tolerance=10.0, goal_time=1.0))
    world.run(0.1)
    first = world.sign("TÚ")
    world.run_until(lambda: bool(world.sent))
    plan = world.sent[0].plan
    world.run(plan.duration - 0.5)
    world._motions = []  # stands still half a second before the end
    world.velocities = np.zeros(REST.size)
    stopped = world.positions.copy()
    world.run_until(lambda: bool(world.finished()), most=3.0)
    assert world.finished() == [(first, Outcome.NOT_REACHED)]
    second = world.sign("A")
    assert any(status.code == "not_reached" for status in world.statuses())
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (second, Outcome.SUCCESS)
    np.testing.assert_array_equal(world.sent[1].plan.positions[0], stopped)


def test_a_canceled_sentence_goes_back_to_rest_smoothly_and_the_next_begins(world: World) -> None:
    ticket, following = world.sign("A-N-A-N-A-N"), world.sign("TÚ")
    world.run(5.0)
    world.cancel(ticket)
    world.cancel(ticket)  # twice is as good as once
    full, halt = (sent.plan for sent in world.sent)
    assert halt.duration <= 0.6
    limits = world.planner.limits
    assert (halt.samples.velocities[-1] == 0.0).all()
    assert (halt.positions >= limits.lower).all() and (halt.positions <= limits.upper).all()
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.CANCELED)]
    assert world.now < 100.0 + full.duration
    np.testing.assert_allclose(world.positions, REST, atol=0.02)
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (following, Outcome.SUCCESS)


def test_a_sentence_canceled_on_its_way_to_rest_just_ends(world: World) -> None:
    ticket = world.sign("TÚ")
    world.run_until(lambda: bool(world.sent))
    world.run(world.sent[0].plan.duration - 0.5)
    world.cancel(ticket)
    world.run_until(lambda: bool(world.finished()))
    assert len(world.sent) == 1 and world.stops == []
    assert world.finished() == [(ticket, Outcome.CANCELED)]


@pytest.mark.parametrize("signed_for", [0.4, 0.8, 1.5])
@pytest.mark.parametrize("delay", [0.0, 0.06, 0.1, 0.15, 0.2, 0.3])
@pytest.mark.parametrize("link", [0.0, 0.1, 0.2, 0.3, 0.4])
def test_the_way_to_rest_begins_where_the_robot_stands_however_late_messages_are(
    world: World, link: float, delay: float, signed_for: float
) -> None:
    world.link = link
    ticket = world.sign("TÚ A")
    world.run(0.5 + signed_for)
    world.delay = delay
    world.cancel(ticket)
    wanted = 0
    while not world.finished():
        world.tick()
        begun = [event for event in world.events if isinstance(event, ReturnWanted)][wanted:]
        wanted += len(begun)
        for event in begun:
            assert not world.velocities.any()
            np.testing.assert_allclose(event.start.position, world.positions, atol=1e-9)
    # What comes late cannot continue another motion: then it is told to stop from where it is seen, twice.
    assert len(world.stops) <= (2 if delay else 0)


def test_a_stop_that_the_driver_does_not_take_is_sent_again(world: World) -> None:
    ticket = world.sign("A-N-A-N-A-N")
    world.run(3.0)
    world.run_until(lambda: bool(np.abs(world.velocities).max() > 0.5))
    going_on = world._motions
    world.cancel(ticket)
    world._motions, world._stop = going_on, None  # the driver has refused it
    world.run_until(lambda: len(world.stops) == 1, most=2.0)
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.CANCELED)]
    np.testing.assert_allclose(world.positions, REST, atol=0.02)


def test_a_driver_that_takes_no_stop_gets_time_between_them_and_is_then_told_to_stop_by_itself(
    world: World,
) -> None:
    canceled, following = world.sign("A-N-A-N-A-N-A-N"), world.sign("TÚ")
    world.run_until(lambda: world.now > 103.0 and bool(np.abs(world.velocities).max() > 0.5))
    world.accepts, world.takes_stops = lambda _: False, False
    began = world.now
    world.cancel(canceled)
    world.run_until(lambda: world.statuses()[-2].code == "stop_refused", most=5.0)
    assert len(world.stops) == 5 and world.now - began >= sum(stop.lead for stop in world.stops)
    assert not world.velocities.any()
    world.accepts, world.takes_stops = lambda _: True, True
    world.driver_says(DriverMode.HOLDING)  # re-armed
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(canceled, Outcome.CANCELED), (following, Outcome.SUCCESS)]


def test_progress_names_the_token_that_is_signed(world: World) -> None:
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


def test_what_a_paused_robot_waits_for_is_told_as_its_driver_says_it(world: World) -> None:
    report = DriverReport(mode=DriverMode.PAUSED, speed_scaling=0.0, message="the speed scaling factor is 0")
    world.take(world.queue.driver_state(report, world.now))
    assert world.statuses()[-1].message == report.message


@pytest.mark.parametrize(
    ("positions", "velocities"),
    [([np.nan] * 28, []), ([0.0] * 27, []), ([0.0] * 28, [0.0]), ([0.0] * 28, [np.inf] * 28)],
)
def test_a_joint_state_that_is_none_is_not_taken(
    unheard: World, positions: list[float], velocities: list[float]
) -> None:
    assert unheard.queue.joint_states(COMMANDED_JOINTS, positions, velocities, unheard.now)
    unheard.sign("TÚ")
    unheard.run(0.1)
    assert unheard.activities() == [Activity.WAITING]


def test_joint_states_may_come_from_several_publishers(unheard: World) -> None:
    half = len(COMMANDED_JOINTS) // 2
    unheard.queue.joint_states(COMMANDED_JOINTS[:half], REST[:half].tolist(), [], unheard.now)
    unheard.queue.joint_states(("LeftKnee",), [0.3], [], unheard.now)
    unheard.sign("TÚ")
    unheard.tick()
    assert COMMANDED_JOINTS[half] in unheard.statuses()[-1].message
    unheard.queue.joint_states(COMMANDED_JOINTS[half:], REST[half:].tolist(), [], unheard.now)
    unheard.run_until(lambda: len(unheard.sent) == 1, most=1.0)


def test_the_next_sentence_waits_for_a_robot_that_is_late_to_stand_still(world: World) -> None:
    world.lag = 0.15  # at the planned end it is within the tolerance of rest, and still moving there
    first = world.sign("A")
    world.run_until(lambda: bool(world.sent))
    world.run(world.sent[0].plan.duration - 0.2)  # too late to be joined
    second = world.sign("A")
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.SUCCESS)]
    starts = [event.start for event in world.events if isinstance(event, PlanWanted)]
    np.testing.assert_array_equal(starts[1].velocity, 0.0)
    np.testing.assert_allclose(starts[1].position, REST, atol=1e-3)


def test_a_sentence_whose_plan_does_not_come_is_cleared_like_those_that_wait(world: World) -> None:
    world.planning_time = 1e6
    tickets = [world.sign("TÚ"), world.sign("A")]
    world.run(1.0)
    world.planning_time = 0.0
    world.take(world.queue.clear(world.now))
    assert world.finished() == [(ticket, Outcome.CANCELED) for ticket in tickets]
    assert [status.code for status in world.statuses() if status.code] == ["cleared", "cleared"]
    following = world.sign("N")
    world.run_until(lambda: len(world.finished()) == 3)
    assert world.finished()[2] == (following, Outcome.SUCCESS)
