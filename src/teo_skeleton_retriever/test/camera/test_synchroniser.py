# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

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
            assert (pair.color, pair.depth) == (pair.stamp, pair.depth_stamp)
            pairs.append((pair.stamp, pair.depth_stamp))
    return pairs


def test_the_nearest_depth_is_taken_and_waited_for():
    sync = new()
    assert fed(sync, ("d", BASE - 9 * MS), ("c", BASE)) == []  # a nearer one may come
    assert fed(sync, ("d", BASE + 2 * MS)) == [(BASE, BASE + 2 * MS)]


def test_beyond_the_slop_nothing_is_paired_and_the_image_is_counted():
    sync = new(slop=10 * MS)
    assert fed(sync, ("c", BASE), ("d", BASE + 10 * MS + 1)) == []
    assert sync.dropped[NO_DEPTH] == 1
    assert fed(new(slop=10 * MS), ("c", BASE), ("d", BASE + 10 * MS)) == [(BASE, BASE + 10 * MS)]


def test_colour_does_not_wait_for_ever_where_no_depth_comes():
    sync = new(capacity=3)
    assert fed(sync, *[("c", BASE + i * PERIOD) for i in range(10)]) == []
    assert sync.dropped == {NO_DEPTH: 7}


def test_depth_that_lags_by_a_few_images_is_waited_for():
    colors = [("c", BASE + i * PERIOD) for i in range(8)]
    depths = [("d", BASE + i * PERIOD) for i in range(8)]
    arrivals = colors[:3] + [x for pair in zip(colors[3:], depths, strict=False) for x in pair] + depths[5:]
    assert fed(new(), *arrivals) == [(s, s) for _, s in colors]


def test_depth_at_half_the_rate_pairs_with_every_other_colour():
    sync = new()
    arrivals = [
        x
        for i in range(10)
        for x in ([("c", BASE + i * PERIOD)] + ([("d", BASE + i * PERIOD)] if i % 2 == 0 else []))
    ]
    assert [s for s, _ in fed(sync, *arrivals)] == [BASE + i * PERIOD for i in range(0, 10, 2)]
    assert sync.dropped[NO_DEPTH] == 4  # the last still waits


def test_a_second_colour_of_the_same_stamp_and_a_late_one_are_dropped():
    sync = new()
    later = BASE + PERIOD
    assert fed(sync, ("c", later), ("c", later), ("d", later)) == [(later, later)]
    assert fed(sync, ("c", later), ("c", BASE), ("d", BASE)) == []
    assert sync.dropped[OVERTAKEN] == 3


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
    pairs += [(pair.stamp, pair.depth_stamp) for pair in sync.finish()]
    assert all(abs(color - depth) <= slop for color, depth in pairs)
    assert [color for color, _ in pairs] == sorted({color for color, _ in pairs})
    assert len({depth for _, depth in pairs}) == len(pairs)
    colors = sum(kind == "c" for kind, _ in arrivals)
    assert len(pairs) + sync.dropped[NO_DEPTH] + sync.dropped[OVERTAKEN] == colors


def test_equal_stamps_pair_at_once_whichever_comes_first():
    assert fed(new(), ("c", BASE), ("d", BASE)) == [(BASE, BASE)]
    assert fed(new(), ("d", BASE), ("c", BASE)) == [(BASE, BASE)]


def test_an_earlier_depth_is_taken_where_the_later_is_farther():
    assert fed(new(), ("d", BASE - 3 * MS), ("c", BASE), ("d", BASE + 30 * MS)) == [(BASE, BASE - 3 * MS)]


def test_depth_without_colour_is_let_go():
    sync = new(capacity=3)
    assert fed(sync, *[("d", BASE + i * PERIOD) for i in range(10)]) == []
    assert sync.dropped == {NO_COLOR: 7}


def test_a_second_depth_of_the_same_stamp_changes_nothing():
    assert fed(new(), ("d", BASE), ("d", BASE), ("c", BASE)) == [(BASE, BASE)]


def test_colour_that_comes_out_of_order_while_it_waits_comes_out_in_order():
    sync = new()
    assert fed(sync, ("c", BASE + PERIOD), ("c", BASE)) == []
    assert [s for s, _ in fed(sync, ("d", BASE), ("d", BASE + PERIOD))] == [BASE, BASE + PERIOD]
