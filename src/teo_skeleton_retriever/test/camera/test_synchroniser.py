# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_skeleton_retriever.camera.synchroniser import NO_COLOR, NO_DEPTH, OVERTAKEN, Synchroniser

MS = 1_000_000
PERIOD = 33 * MS
BASE = 1_000 * PERIOD


def new(slop: int = 10 * MS, capacity: int = 4) -> Synchroniser:
    return Synchroniser(slop=slop, capacity=capacity)


def fed(sync: Synchroniser, *arrivals: tuple[str, int]) -> list[tuple[int, int]]:
    """Stamps of the pairs that come out; the images are their own stamps."""
    pairs = []
    for kind, stamp in arrivals:
        add = sync.add_color if kind == "c" else sync.add_depth
        for pair in add(stamp, stamp):
            assert pair.color == pair.stamp
            pairs.append((pair.stamp, pair.depth))
    return pairs


@pytest.mark.parametrize(
    ("depths", "paired"),
    [
        ((-9, 2), 2),  # the nearer one is waited for
        ((-3, 30), -3),
        ((10,), 10),
        ((0, 0), 0),
        ((10 + 1 / MS, 100), None),
    ],
)
def test_the_nearest_depth_within_the_slop_is_taken(depths: tuple[float, ...], paired: int | None):
    before, after = (
        [("d", BASE + round(d * MS)) for d in depths if (d < 0) is early] for early in (True, False)
    )
    sync = new(slop=10 * MS)
    pairs = [] if paired is None else [(BASE, BASE + paired * MS)]
    assert fed(sync, *before, ("c", BASE)) == []
    assert fed(sync, *after) == pairs
    assert sync.dropped[NO_DEPTH] == 1 - len(pairs)


@pytest.mark.parametrize(("kind", "reason"), [("c", NO_DEPTH), ("d", NO_COLOR)])
def test_what_has_no_other_half_does_not_wait_for_ever(kind: str, reason: str):
    sync = new(capacity=3)
    assert fed(sync, *[(kind, BASE + i * PERIOD) for i in range(10)]) == []
    assert sync.dropped == {reason: 7}


def test_depth_that_lags_by_a_few_images_is_waited_for():
    colors = [("c", BASE + i * PERIOD) for i in range(8)]
    depths = [("d", BASE + i * PERIOD) for i in range(8)]
    arrivals = colors[:3] + [x for pair in zip(colors[3:], depths, strict=False) for x in pair] + depths[5:]
    assert fed(new(), *arrivals) == [(s, s) for _, s in colors]


def test_stamps_that_jump_back_begin_anew():
    sync = new()
    assert fed(sync, ("c", BASE), ("d", BASE))
    early = BASE - 10_000 * MS
    assert fed(sync, ("c", early), ("d", early)) == [(early, early)]


def test_one_stamp_far_in_the_future_does_not_stop_the_stream():
    sync = new()
    future = BASE + 10**18
    assert fed(sync, ("c", BASE), ("d", BASE), ("c", future)) == [(BASE, BASE)]
    after = [BASE + i * PERIOD for i in range(1, 5)]
    assert [s for s, _ in fed(sync, *[x for s in after for x in (("c", s), ("d", s))])] == after


def test_the_end_of_a_recording_gives_what_waits():
    sync = new()
    assert fed(sync, ("d", BASE - 5 * MS), ("c", BASE), ("c", BASE + PERIOD)) == []
    assert [pair.stamp for pair in sync.finish()] == [BASE]
    assert sync.dropped[NO_DEPTH] == 1


@given(
    st.lists(
        st.tuples(st.sampled_from("cd"), st.integers(0, 60).map(lambda i: BASE + i * 7 * MS)), max_size=80
    ),
    st.integers(0, 20).map(lambda i: i * MS),
    st.integers(1, 5),
)
def test_whatever_comes_pairs_are_near_ascend_and_no_image_is_lost_uncounted(arrivals, slop, capacity):
    sync = new(slop, capacity)
    pairs = fed(sync, *arrivals)
    pairs += [(pair.stamp, pair.depth) for pair in sync.finish()]
    assert all(abs(color - depth) <= slop for color, depth in pairs)
    assert [color for color, _ in pairs] == sorted({color for color, _ in pairs})
    assert len({depth for _, depth in pairs}) == len(pairs)
    colors = sum(kind == "c" for kind, _ in arrivals)
    assert len(pairs) + sync.dropped[NO_DEPTH] + sync.dropped[OVERTAKEN] == colors
