# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import statistics

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_skeleton_retriever.compat.original_retriever import OriginalMedian

values = st.lists(st.floats(-10, 10), min_size=1, max_size=30)


def original(order: int, samples: list[float], start: float = 0.0) -> list[float]:
    median = OriginalMedian(order, np.array([start]))
    return [float(median.step(np.array([sample]))[0]) for sample in samples]


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
def test_once_full_it_is_the_median_of_the_last_samples(samples: list[float], order: int) -> None:
    expected = [statistics.median(samples[i - order : i + 1]) for i in range(order, len(samples))]
    assert original(order, samples)[order:] == pytest.approx(expected)
