# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from teo_skeleton_retriever.tracking.person_tracker import PersonTracker, SignerChoice

RATE = 30.0  # [1/s]
AT_ONCE = 1


def walk(*ways: list[np.ndarray | None], tracker: PersonTracker | None = None) -> list[list[int | None]]:
    """Ids of people who go these ways, seen in an order that changes; None where hidden."""
    tracker = tracker or PersonTracker()
    random = np.random.default_rng(5)
    ids: list[list[int | None]] = []
    for i, places in enumerate(zip(*ways, strict=True)):
        visible = [k for k, place in enumerate(places) if place is not None]
        random.shuffle(visible)
        noisy = [np.asarray(places[k]) + random.normal(0.0, 0.02, 3) for k in visible]
        found = dict(zip(visible, tracker.step(i / RATE, noisy), strict=True))
        ids.append([found.get(k) for k in range(len(places))])
    return ids


def line(start: tuple[float, ...], end: tuple[float, ...], images: int = 90) -> list[np.ndarray | None]:
    return list(np.linspace(start, end, images))


def kept(ids: list[list[int | None]]) -> bool:
    """Everybody has one id from first to last, and it is nobody else's."""
    columns = [
        {person_id for person_id in column if person_id is not None} for column in zip(*ids, strict=True)
    ]
    return all(len(column) == 1 for column in columns) and len(set().union(*columns)) == len(columns)


def test_two_who_cross_close_by_keep_their_ids_by_how_they_move() -> None:
    assert kept(walk(line((-1, 0, 2.0), (1, 0, 2.0)), line((1, 0, 2.25), (-1, 0, 2.25))))


def test_someone_who_walks_on_while_hidden_keeps_their_id() -> None:
    walking = line((-1, 0, 2.6), (1, 0, 2.6))
    walking[40:55] = [None] * 15
    assert kept(walk(walking, line((0, 0, 1.5), (0, 0, 1.5))))


def test_who_is_in_the_first_image_of_a_recording_is_a_person_and_who_enters_is_on_trial() -> None:
    there, enters = line((0, 0, 1.5), (0, 0, 1.5), 10), line((1, 0, 2.0), (1, 0, 2.0), 10)
    enters[0] = None
    for recorded, first in ((True, [0, None]), (False, [None, None])):
        ids = walk(there, enters, tracker=PersonTracker(recorded=recorded))
        assert ids[0] == first
        assert [found[1] is None for found in ids] == [True] * 3 + [False] * 7


def test_who_returns_within_the_memory_is_who_they_were_and_later_is_new() -> None:
    for gap, same in ((2.5, True), (3.5, False)):
        tracker = PersonTracker(AT_ONCE)
        place = np.array([0.3, 0.0, 2.0])
        first = tracker.step(0.0, [place])
        assert (tracker.step(gap, [place]) == first) is same


def test_as_many_as_possible_are_recognised() -> None:
    """The nearest pair is not taken first if that leaves somebody unrecognised."""
    tracker = PersonTracker(AT_ONCE)
    tracker.step(0.0, [np.array([0.0, 0.0, 2.0]), np.array([0.3, 0.0, 2.0])])
    assert tracker.step(0.001, [np.array([0.25, 0.0, 2.0]), np.array([0.6, 0.0, 2.0])]) == [0, 1]


@given(st.lists(st.lists(st.tuples(*[st.floats(-3, 3)] * 3), max_size=4), max_size=12))
@settings(max_examples=60, deadline=None)
def test_no_image_gives_an_id_twice_and_new_ids_only_grow(images: list[list[tuple[float, ...]]]) -> None:
    tracker = PersonTracker(AT_ONCE)
    highest = [-1]
    for i, places in enumerate(images):
        ids = tracker.step(i / RATE, [np.array(place) for place in places])
        given_ids = [person_id for person_id in ids if person_id is not None]
        assert len(ids) == len(places)
        assert len(set(given_ids)) == len(given_ids)
        highest.append(max([highest[-1], *given_ids]))
    assert all(after - before <= 4 for before, after in pairwise(highest))


def test_two_people_are_not_in_the_same_place() -> None:
    """Somebody seen twice, or somebody of whom only who hides them is measured."""
    places = [np.array([0.0, 0.0, 2.0]), np.array([0.1, 0.0, 2.1]), np.array([0.4, 0.0, 2.0])]
    assert PersonTracker(AT_ONCE).step(0.0, places) == [0, None, 1]


def test_of_several_places_where_a_person_may_be_that_where_they_are_expected_is_theirs() -> None:
    tracker = PersonTracker(AT_ONCE)
    tracker.step(0.0, [np.array([0.0, 0.0, 1.5]), np.array([0.3, 0.0, 2.5])])
    torn = np.array([[0.2, 0.0, 1.6], [0.3, 0.0, 2.5]])
    assert tracker.step(1 / RATE, [torn, np.array([0.0, 0.0, 1.5])]) == [1, 0]
    assert tracker.people[1].position[2] == pytest.approx(2.5)


@pytest.mark.parametrize("time", [math.nan, math.inf])
def test_a_time_that_is_none_is_refused(time: float) -> None:
    with refused("bad_time"):
        PersonTracker().step(time, [])


FAR_AHEAD = np.array([0.0, 0.0, 2.5])
NEAR_ASIDE = np.array([0.8, 0.0, 1.5])


def test_the_nearest_or_the_most_central_is_chosen() -> None:
    people = {4: FAR_AHEAD, 7: NEAR_ASIDE}
    assert SignerChoice("nearest", 3.0).step(0.0, people) == 7
    assert SignerChoice("central", 3.0).step(0.0, people) == 4


def test_a_signer_who_is_hidden_is_waited_for_then_given_up() -> None:
    choice = SignerChoice("nearest", 2.0)
    choice.step(0.0, {1: FAR_AHEAD})
    assert choice.step(1.9, {2: NEAR_ASIDE}) is None
    assert choice.signer == 1
    assert choice.step(2.1, {2: NEAR_ASIDE}) == 2
    assert choice.step(2.2, {1: FAR_AHEAD, 2: NEAR_ASIDE}) == 2


def test_after_unlocking_the_signer_stays_until_they_leave() -> None:
    choice = SignerChoice("nearest", 0.5)
    choice.lock(1)
    choice.step(0.0, {1: FAR_AHEAD, 2: NEAR_ASIDE})
    choice.lock(None)
    assert choice.step(0.1, {1: FAR_AHEAD, 2: NEAR_ASIDE}) == 1
    assert choice.step(1.0, {2: NEAR_ASIDE}) == 2
