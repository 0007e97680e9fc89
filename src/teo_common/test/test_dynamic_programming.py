# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from itertools import pairwise, product

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_common.dynamic_programming import cheapest_path, warp


@settings(max_examples=30)
@given(
    seed=st.integers(0, 10**6),
    moments=st.integers(1, 5),
    price=st.floats(0.0, 3.0),
    haste=st.floats(0.0, 9.0),
)
def test_no_other_way_is_cheaper(seed, moments, price, haste):
    random = np.random.default_rng(seed)
    cost, values = random.uniform(0.0, 1.0, (moments, 3)), random.normal(size=(moments, 3, 2))

    farthest = random.uniform(0.0, 2.0, moments - 1)

    def total(way):
        path = values[np.arange(moments), way]
        ways = sum(float(((b - a) ** 2).sum()) for a, b in pairwise(path))
        beyond = 0.0
        for far, (a, b) in zip(farthest, pairwise(path), strict=True):
            beyond += sum(max(abs(y - x) - far, 0.0) ** 2 for x, y in zip(a, b, strict=True))
        return cost[np.arange(moments), way].sum() + price * ways + haste * beyond

    best = min((list(way) for way in product(range(3), repeat=moments)), key=total)
    found = cheapest_path(cost, values, price, farthest=farthest, haste=haste)
    assert found.tolist() == best


def test_candidates_may_be_as_many_as_there_are_at_each_moment():
    costs = [np.array([0.0, 0.1]), np.array([0.0]), np.array([0.5, 0.3, 0.0])]
    values = [np.array([[0.0], [1.0]]), np.array([[1.0]]), np.array([[1.0], [2.0], [9.0]])]
    assert cheapest_path(costs, values, 1.0).tolist() == [1, 0, 0]


def test_warping_finds_the_same_moments_at_another_pace():
    first, second = (
        np.stack([0.5 * np.sin(2.0 * np.pi * share), np.cos(share), 0.0 * share], axis=1)[:, None]
        for share in (np.linspace(0.0, 1.0, 40), np.linspace(0.0, 1.0, 70))
    )
    aligned = warp(first, second)
    assert aligned.distance < 0.05
    # Frame for frame along the diagonal.
    assert np.abs(aligned.pairs[:, 0] / 39.0 - aligned.pairs[:, 1] / 69.0).max() < 0.1
