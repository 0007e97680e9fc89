# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How one motion goes on into the next, and what interrupts it: stops, pauses, newer texts."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from queue_world import TICK, World
from teo_description.humanoid import load_humanoid
from teo_lut_executor.execution.interface import (
    Activity,
    Begun,
    DriverMode,
    Outcome,
    PlanWanted,
    Preemption,
    QueueSettings,
    ReturnWanted,
)
from teo_signs.sign import Sign

REST = load_humanoid().ready


def assert_smooth(world: World) -> None:
    """No jump: every tick's step and change of velocity are within what the limits allow."""
    limits = world.planner.limits
    positions = np.array([position for position, _ in world.path])
    velocities = np.array([velocity for _, velocity in world.path])
    assert (np.abs(np.diff(positions, axis=0)) <= limits.velocity * TICK * 1.01 + 1e-9).all()
    assert (np.abs(np.diff(velocities, axis=0)) <= limits.acceleration * TICK * 1.01 + 1e-9).all()


def test_sentences_in_a_row_are_signed_with_the_arms_up(world: World) -> None:
    tickets = [world.sign(text) for text in ("A-N", "N-A", "A")]
    world.run_until(lambda: len(world.finished()) == 3)
    assert world.finished() == [(ticket, Outcome.SUCCESS) for ticket in tickets]
    assert [event.ticket for event in world.events if isinstance(event, Begun)] == tickets
    signing = [status for status in world.statuses() if status.activity == Activity.SIGNING]
    assert [status.queued for status in signing] == [2, 1, 0]
    assert_smooth(world)
    raised = np.array([np.abs(positions - REST).max() > 0.1 for positions, _ in world.path])
    assert np.count_nonzero(np.diff(raised.astype(int)) == 1) == 1, "raised once for all three"
    np.testing.assert_allclose(world.positions, REST, atol=1e-3)
    singly = sum(world.planner.plan(event.sentence.tokens).duration for event in plans_wanted(world))
    assert world.now - 100.2 < singly - 2.0


def plans_wanted(world: World) -> list[PlanWanted]:
    return [event for event in world.events if isinstance(event, PlanWanted)]


def test_between_joined_sentences_the_hands_stay_for_the_pause(world: World) -> None:
    world.sign("A-N"), world.sign("N-A")
    world.run_until(lambda: len(world.sent) == 2)
    first, second = world.sent
    last = first.plan.timings[-1]
    ended = last.start + last.duration
    (began, _), (joined, _) = world.taken
    assert ended - 0.04 <= joined - began <= ended, "a period before the last point of standing"
    stays = second.plan.positions[second.plan.times <= world.queue.settings.sentence_pause]
    np.testing.assert_allclose(stays - stays[0], 0.0, atol=1e-6)


@pytest.mark.parametrize("late", [0.1, 0.5, 0.9])
def test_a_sentence_that_comes_while_the_arms_go_down_turns_them_round(world: World, late: float) -> None:
    first = world.sign("A-N")
    world.run_until(lambda: bool(world.sent))
    last = world.sent[0].plan.timings[-1]
    world.run(last.start + last.duration + late)
    second = world.sign("N-A")
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.SUCCESS)]
    assert plans_wanted(world)[-1].start.velocity.any(), "planned from a robot in motion"
    assert_smooth(world)


def test_a_sentence_that_cannot_be_signed_is_named_early_and_the_next_is_joined(
    world: World,
) -> None:
    first = world.sign("A-N")
    bad, third = world.sign("\u03a9"), world.sign("N-A")
    world.run_until(lambda: len(world.finished()) == 3)
    assert world.finished() == [(bad, Outcome.REFUSED), (first, Outcome.SUCCESS), (third, Outcome.SUCCESS)]
    assert plans_wanted(world)[-1].hold > 0.0
    assert_smooth(world)


def test_the_arms_rise_before_the_sentence_is_planned(world: World) -> None:
    world.opening_time, world.planning_time = 0.5, 0.3
    ticket = world.sign("A-N")
    world.run(0.2)
    assert len(world.sent) == 1 and np.abs(world.path[-1][0] - REST).max() > 1e-3, "they move already"
    assert world.activities()[-1] == Activity.WAITING, "and nothing is said of a plan that is not there"
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.SUCCESS)]
    assert len(world.sent) == 2
    assert_smooth(world)


def test_a_plan_that_the_driver_does_not_take_in_motion_begins_where_the_opening_stops(world: World) -> None:
    world.opening_time, world.planning_time = 0.5, 0.1
    world.follows = lambda _: len(world.sent) != 2
    ticket = world.sign("A-N")
    world.run_until(lambda: len(world.sent) == 2)
    world.take(world.queue.driver_refused(world.sent[1].number, "[start_too_fast] late", world.now))
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.SUCCESS)]
    assert len(world.sent) == 3 and not any(status.code for status in world.statuses())
    assert_smooth(world)


def test_a_sentence_that_is_refused_after_its_opening_brings_the_robot_back_to_rest(world: World) -> None:
    world.opening_time, world.planning_time = 0.5, 0.3
    world.planner._avoidance._timing._max_duration = 1.0  # known only when the whole is timed
    ticket = world.sign("A-N")
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.REFUSED)]
    world.planner._avoidance._timing._max_duration = 300.0
    world.run_until(lambda: world.activities()[-1] == Activity.IDLE)
    np.testing.assert_allclose(world.positions, REST, atol=0.02)


def test_a_latched_stop_ends_the_sentence_and_keeps_the_queue_until_it_is_rearmed(world: World) -> None:
    first, second = world.sign("A-N-A", utterance_id="one"), world.sign("N-A", utterance_id="two")
    world.run(3.0)
    world.driver_says(DriverMode.STOPPED)
    world.run(5.0)
    assert world.finished() == [(first, Outcome.CANCELED)]
    named = next(status for status in world.statuses() if status.activity == Activity.REFUSED)
    assert named.code == "stopped" and named.sentence and named.sentence.utterance_id == "one"
    assert world.statuses()[-1].activity == Activity.STOPPED
    assert len(world.sent) == 1 and world.queue.queued == 1
    world.driver_says(DriverMode.HOLDING)
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (second, Outcome.SUCCESS)
    np.testing.assert_allclose(world.positions, REST, atol=1e-3)


def test_a_pause_halts_progress_and_costs_nothing(world: World) -> None:
    ticket = world.sign("A-N-A")
    world.run(3.0)
    world.driver_says(DriverMode.PAUSED)
    before = world.queue.progress(world.now)
    world.run(20.0)
    after = world.queue.progress(world.now)
    assert before is not None and after is not None
    assert after.fraction == pytest.approx(before.fraction, abs=0.01)
    assert world.activities()[-1] == Activity.PAUSED
    world.driver_says(DriverMode.MOVING)
    world.run_until(lambda: bool(world.finished()))
    assert world.finished() == [(ticket, Outcome.SUCCESS)]


def test_a_newer_text_replaces_the_one_before_without_going_to_rest(table: Mapping[str, Sign]) -> None:
    world = World(table, QueueSettings(preemption=Preemption.REPLACE))
    world.run(0.2)
    first = world.sign("A-N-A-N-A-N", utterance_id="old", count=2)
    sister = world.sign("CASA", utterance_id="old", index=1, count=2)
    world.run(3.0)
    newer = world.sign("N-A", utterance_id="new")
    world.run_until(lambda: len(world.finished()) == 3)
    assert world.finished() == [
        (sister, Outcome.CANCELED),
        (first, Outcome.CANCELED),
        (newer, Outcome.SUCCESS),
    ]
    replaced = [s.sentence.index for s in world.statuses() if s.code == "replaced" and s.sentence]
    assert replaced == [1, 0]
    assert world.now < 100.2 + world.sent[0].plan.duration
    assert_smooth(world)


def test_a_joined_sentence_that_is_canceled_goes_to_rest_instead(world: World) -> None:
    first, second = world.sign("A"), world.sign("N-A-N-A")
    world.run_until(lambda: len(world.sent) == 2)
    world.cancel(second)
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.CANCELED)]
    np.testing.assert_allclose(world.positions, REST, atol=0.02)


def test_a_driver_that_does_not_take_a_joined_sentence_gets_it_from_rest(world: World) -> None:
    world.follows = lambda _: len(world.sent) != 2
    first, second = world.sign("A"), world.sign("N")
    world.run_until(lambda: len(world.sent) == 2)
    world.take(world.queue.driver_refused(world.sent[1].number, "[start_mismatch] elsewhere", world.now))
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished() == [(first, Outcome.SUCCESS), (second, Outcome.SUCCESS)]
    np.testing.assert_allclose(world.sent[2].plan.positions[0], REST, atol=1e-3)


def test_why_the_driver_refuses_is_told(world: World) -> None:
    world.follows = lambda _: False
    ticket = world.sign("A")
    for count in (1, 2):
        world.run_until(lambda count=count: len(world.sent) == count)  # type: ignore[misc]
        world.take(world.queue.driver_refused(world.sent[-1].number, "[held_joint] no", world.now))
    assert world.finished() == [(ticket, Outcome.NOT_REACHED)]
    refused = world.statuses()[-1]
    assert refused.code == "trajectory_refused" and "[held_joint] no" in refused.message


def test_a_robot_that_somebody_else_moves_is_not_called_at_rest(world: World) -> None:
    world.events.clear()
    world.velocities = np.full(REST.size, 0.2)
    world.run(1.0)
    assert set(world.activities()) == {Activity.WAITING}
    world.velocities = np.zeros(REST.size)
    world.run(0.2)
    assert world.activities()[-1] == Activity.IDLE


def test_a_queue_that_is_deactivated_stops_the_robot_and_names_the_sentence(world: World) -> None:
    first, second = world.sign("A-N-A"), world.sign("N")
    world.run(3.0)
    world.take(world.queue.deactivate(world.now))
    world.obstacle = "not active"
    assert len(world.sent) == 2 and world.finished() == [(first, Outcome.CANCELED)]
    assert [status.code for status in world.statuses() if status.code] == ["inactive"]
    world.run(1.0)
    assert not world.velocities.any() and len(world.sent) == 2
    world.obstacle = ""
    world.run_until(lambda: len(world.finished()) == 2)
    assert world.finished()[1] == (second, Outcome.SUCCESS)


@pytest.mark.parametrize("pace", [0.3, 0.9])
def test_at_any_speed_sentences_begin_at_once_and_go_on_from_where_the_robot_is(
    world: World, pace: float
) -> None:
    world.driver_says(DriverMode.HOLDING, speed_scaling=pace)
    world.opening_time, world.planning_time = 0.4, 0.2
    world.run(0.5)
    tickets = [world.sign(text) for text in ("TÚ", "A-N", "TÚ")]
    world.run_until(lambda: len(world.finished()) == len(tickets), most=60.0 / pace)
    assert world.finished() == [(ticket, Outcome.SUCCESS) for ticket in tickets]
    assert world.refused == 0
    assert not world.stops
    assert all(status.code == "" for status in world.statuses())
    opening, *others = world.sent
    assert len(others) == len(tickets)
    np.testing.assert_allclose(opening.plan.positions[0], REST, atol=1e-3)
    for sent in others:
        assert np.abs(sent.plan.positions[0] - REST).max() > 0.1, "from rest again"


def passing(clock: float, path: float) -> Callable[[World], None]:
    """Time that the clock and the robot's motion go on by, which nobody sees."""

    def pass_by(world: World) -> None:
        world.now += clock
        world._path_time += path

    return pass_by


def held_up(world: World) -> None:
    """The process stands still for 3 s; joint states wait in its inbox."""
    world.publishes_states = False
    passing(3.0, 3.0)(world)
    world.tick()
    world.publishes_states = True


def changed(**values: float) -> Callable[[World], None]:
    return lambda world: vars(world).update(values)


@pytest.mark.parametrize(
    ("moment", "hinder"),
    [
        (0.0, changed(link=0.3)),
        (0.0, changed(planning_time=2.0)),
        (0.0, changed(opening_time=0.5, planning_time=1.5)),  # the opening ends before the plan is there
        (0.0, changed(opening_time=0.4, planning_time=0.2, delay=0.45)),
        (1.0, changed(planning_time=4.0)),  # too long for the next to join
        (1.0, held_up),
        *((moment, passing(clock, 0.0)) for moment in (0.04, 2.0) for clock in (-90.0, 1.5, 60.0)),
        *((moment, passing(gap, gap)) for moment in (0.04, 2.0) for gap in (1.5, 60.0)),
    ],
)
def test_what_is_late_and_clocks_that_are_set_cost_no_sentence(
    world: World, moment: float, hinder: Callable[[World], None]
) -> None:
    if moment == 0.0:
        hinder(world)
        world.run(1.0)
    tickets = [world.sign(text) for text in ("TÚ", "A-N", "N-A")]
    world.run(moment)
    if moment > 0.0:
        hinder(world)
    world.run_until(lambda: len(world.finished()) == len(tickets))
    assert world.finished() == [(ticket, Outcome.SUCCESS) for ticket in tickets]
    assert not [status.code for status in world.statuses() if status.code]


@pytest.mark.parametrize("seed", range(6))
def test_a_speed_that_is_changed_whenever_costs_no_sentence(world: World, seed: int) -> None:
    draw = np.random.default_rng(seed)
    world.opening_time, world.planning_time = 0.4, 0.2
    tickets = [world.sign(text) for text in ("TÚ", "A-N", "TÚ")]
    for _ in range(20):
        world.run(float(draw.uniform(0.02, 0.8)))
        mode = draw.choice([DriverMode.MOVING, DriverMode.PAUSED], p=[0.8, 0.2])
        world.driver_says(DriverMode(mode), speed_scaling=float(draw.uniform(0.1, 1.0)))
    world.driver_says(DriverMode.MOVING)
    world.run_until(lambda: len(world.finished()) == len(tickets))
    assert world.finished() == [(ticket, Outcome.SUCCESS) for ticket in tickets]
    assert world.refused == 0
    assert all(status.code == "" for status in world.statuses())


@pytest.mark.parametrize("seed", range(6))
def test_a_robot_that_is_not_heard_for_a_while_but_goes_on_is_stopped_before_it_signs_again(
    world: World, seed: int
) -> None:
    draw = np.random.default_rng(seed)
    tickets = [world.sign(text) for text in ("A-N-A", "TÚ")]
    world.run(float(draw.uniform(0.3, 6.0)))
    world.publishes_states = False
    world.run(float(draw.uniform(0.6, 2.0)))
    world.publishes_states = True
    world.run_until(lambda: len(world.finished()) == len(tickets))
    assert world.finished() == [(ticket, Outcome.SUCCESS) for ticket in tickets]
    assert world.refused == 0


@pytest.mark.parametrize("wait", [0.05, 1.0])
def test_a_sentence_that_is_canceled_in_a_pause_does_not_go_on_when_the_pause_ends(
    world: World, wait: float
) -> None:
    first = world.sign("A-N-A-N")
    world.run(3.0)
    world.driver_says(DriverMode.PAUSED)
    world.velocities = np.zeros(REST.size)
    world.run(wait)
    world.cancel(first)
    world.run(1.0)
    here = world.positions
    world.driver_says(DriverMode.MOVING)
    second = world.sign("TÚ")
    world.run_until(lambda: len(world.finished()) == 2)
    (back,) = (event for event in world.events if isinstance(event, ReturnWanted))
    # The way of a stop from full speed, which this driver has at once: 0.2 s at 1 rad/s.
    np.testing.assert_allclose(back.start.position, here, atol=0.2)
    assert world.finished() == [(first, Outcome.CANCELED), (second, Outcome.SUCCESS)]
    assert world.refused == 0


@pytest.mark.parametrize("wait", [0.02, 0.3, 0.5])
def test_a_sentence_that_is_canceled_while_its_motion_is_on_its_way_does_not_begin_later(
    world: World, wait: float
) -> None:
    world.delay = 0.4
    ticket = world.sign("A-N-A-N")
    world.run_until(lambda: bool(world.sent))
    world.run(wait)
    world.cancel(ticket)
    world.run_until(lambda: bool(world.finished()))
    world.run(3.0)
    assert world.finished() == [(ticket, Outcome.CANCELED)]
    assert world.activities()[-1] == Activity.IDLE
    np.testing.assert_allclose(world.positions, REST, atol=0.02)
    assert not world.velocities.any()


# While it is stopped, stands, is planned for again, and signs again.
@pytest.mark.parametrize("wait", [0.02, 0.4, 0.8, 2.0])
def test_a_stop_ends_an_interrupted_sentence_that_is_to_be_signed_again(world: World, wait: float) -> None:
    world.planning_time = 0.5
    interrupted, waiting = world.sign("A-N-A-N"), world.sign("TÚ")
    world.run(3.0)
    world.publishes_states = False
    world.run(0.6)
    assert world.statuses()[-1].code == "stale_joint_states"
    world.publishes_states = True
    world.run(wait)
    world.driver_says(DriverMode.STOPPED)
    world.tick()
    assert world.finished() == [(interrupted, Outcome.CANCELED)]
    assert world.queue.queued == 1
    world.driver_says(DriverMode.HOLDING)
    world.run_until(lambda: world.activities()[-1] == Activity.IDLE)
    assert world.finished()[1:] == [(waiting, Outcome.SUCCESS)]
    np.testing.assert_allclose(world.positions, REST, atol=0.02)


def test_a_robot_whose_driver_hears_late_goes_to_rest_all_the_same(world: World) -> None:
    ticket = world.sign("A-N-A-N")
    world.run(3.0)
    world.delay = 1.0
    world.cancel(ticket)
    world.run_until(lambda: world.activities()[-1] == Activity.IDLE)
    assert world.finished() == [(ticket, Outcome.CANCELED)]
    np.testing.assert_allclose(world.positions, REST, atol=0.02)


def test_a_driver_that_takes_no_way_to_rest_is_told_so_and_left_alone(world: World) -> None:
    ticket = world.sign("A-N-A-N")
    world.run(3.0)
    world.accepts = lambda _: False
    world.cancel(ticket)
    world.run(30.0)
    assert world.finished() == [(ticket, Outcome.CANCELED)]
    assert any(status.code == "trajectory_refused" for status in world.statuses())
    assert world.refused <= 6


def test_a_robot_that_was_stopped_goes_to_rest_when_it_is_rearmed(world: World) -> None:
    world.sign("A-N-A")
    world.run(3.0)
    world.driver_says(DriverMode.STOPPED)
    world.run(1.0)
    world.driver_says(DriverMode.HOLDING)
    world.run_until(lambda: world.activities()[-1] == Activity.IDLE)
    np.testing.assert_allclose(world.positions, REST, atol=0.02)
