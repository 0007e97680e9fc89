from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_skeleton_retriever.compat.original_median import OriginalMedian
from teo_skeleton_retriever.tracking.temporal_median import TemporalMedian

values = st.lists(st.floats(-10, 10), min_size=1, max_size=30)


def original(order: int, samples: list[float], start: float = 0.0) -> list[float]:
    median = OriginalMedian(order, np.array([start]))
    return [float(median.step(np.array([sample]))[0]) for sample in samples]


def temporal(order: int, samples: list[float], max_age: float = 100.0) -> list[float]:
    median = TemporalMedian(order, max_age)
    return [float(median.step(float(t), np.array([sample]))[0]) for t, sample in enumerate(samples)]


def test_the_original_is_frozen_until_it_is_full() -> None:
    assert original(3, [1.0, 2.0, 3.0, 4.0, 5.0], start=9.0) == [9.0, 9.0, 9.0, 2.5, 3.5]


def test_the_original_with_order_zero_lets_everything_through() -> None:
    assert original(0, [3.0, -1.0]) == [3.0, -1.0]


def test_a_restart_freezes_the_original_again() -> None:
    median = OriginalMedian(1, np.zeros(1))
    median.step(np.array([1.0]))
    assert median.step(np.array([3.0]))[0] == 2.0
    median.restart(np.array([7.0]))
    assert median.step(np.array([8.0]))[0] == 7.0
    assert median.output[0] == 7.0


def test_axes_are_filtered_apart_from_each_other() -> None:
    median = OriginalMedian(2, np.zeros(2))
    for sample in ([0.0, 5.0], [1.0, 0.0], [2.0, 1.0]):
        output = median.step(np.array(sample))
    assert output.tolist() == [1.0, 1.0]


@given(values, st.integers(0, 6))
@settings(max_examples=50, deadline=None)
def test_once_full_both_give_the_same(samples: list[float], order: int) -> None:
    assert original(order, samples)[order:] == temporal(order, samples)[order:]


def test_ours_moves_from_the_first_sample_on() -> None:
    assert temporal(4, [1.0, 2.0, 3.0, 4.0]) == [1.0, 1.5, 2.0, 2.5]


def test_one_outlier_does_not_pass() -> None:
    assert max(temporal(4, [1.0, 1.0, 1.0, 50.0, 1.0, 1.0])) == 1.0


def test_a_sample_that_is_not_finite_is_not_taken() -> None:
    assert temporal(2, [1.0, math.nan, 1.0, math.inf, 3.0]) == [1.0, 1.0, 1.0, 1.0, 1.0]


def test_before_any_sample_nothing_is_known() -> None:
    assert math.isnan(temporal(2, [math.nan])[0])


def test_after_a_gap_it_starts_afresh() -> None:
    median = TemporalMedian(4, max_age=0.5)
    for i in range(5):
        median.step(0.1 * i, np.zeros(3))
    assert median.step(2.0, np.ones(3)).tolist() == [1.0, 1.0, 1.0]


def test_time_that_runs_backwards_restarts_it() -> None:
    median = TemporalMedian(4, max_age=100.0)
    median.step(10.0, np.zeros(1))
    assert median.step(1.0, np.ones(1)).tolist() == [1.0]


@pytest.mark.parametrize("order", [0, 1, 5])
def test_the_output_cannot_reach_back_into_the_filter(order: int) -> None:
    median = OriginalMedian(order, np.zeros(1))
    median.step(np.array([1.0]))[:] = 99.0
    assert median.output[0] != 99.0
