# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Ways through time by dynamic programming: the cheapest path over candidates, and two motions aligned."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array


def cheapest_path(
    costs: Sequence[Array] | Array,
    values: Sequence[Array] | Array,
    price: float,
    *,
    farthest: Array | None = None,
    haste: float = 0.0,
) -> NDArray[np.intp]:
    """Choose one candidate at each of n moments: least sum of their costs and of the steps between them.

    The algorithm is Viterbi's (IEEE Trans. Information Theory, 1967).

    Args:
        costs: Of the c candidates at each moment; c may differ from moment to moment. n arrays of shape (c,).
        values: What the candidates are. n arrays of shape (c, k).
        price: Of the square of the step from one moment to the next.
        farthest: How far each of the k values goes from one moment to the next without haste; None for as
            far as it likes. Shape (n - 1,).
        haste: Price of the square of what is beyond.

    Returns:
        Index of the candidate chosen at each moment. Shape (n,).
    """
    total = costs[0]
    origins = []
    reach = np.full(len(costs) - 1, np.inf) if farthest is None else farthest
    for (before, now), own, far in zip(pairwise(values), costs[1:], reach, strict=True):
        step = np.abs(now[:, None] - before[None])
        through = total[None] + (price * step**2 + haste * np.maximum(step - far, 0.0) ** 2).sum(axis=2)
        origins.append(through.argmin(axis=1))
        total = through.min(axis=1) + own
    chosen = [int(total.argmin())]
    for origin in reversed(origins):
        chosen.append(int(origin[chosen[-1]]))
    return np.array(chosen[::-1], dtype=np.intp)


class Warp(NamedTuple):
    """How two motions correspond: mean distance along the way [unit], and pairs of frames, shape (p, 2)."""

    distance: float
    pairs: NDArray[np.int64]


def warp(first: Array, second: Array) -> Warp:
    """Align two motions at any pace (dynamic time warping; Sakoe and Chiba, IEEE Trans. ASSP, 1978).

    Two frames are as far apart as what differs most in them.

    Args:
        first: f points or directions in each frame. Shape (n, f, 3).
        second: Likewise. Shape (m, f, 3).
    """
    cost = np.linalg.norm(first[:, None] - second[None], axis=3).max(axis=2)
    total = np.full((len(first) + 1, len(second) + 1), np.inf)
    total[0, 0] = 0.0
    for row in range(len(first)):
        for column in range(len(second)):
            before = min(total[row, column], total[row, column + 1], total[row + 1, column])
            total[row + 1, column + 1] = cost[row, column] + before
    row, column = len(first) - 1, len(second) - 1
    pairs = [(row, column)]
    while row or column:
        steps = ((row - 1, column - 1), (row - 1, column), (row, column - 1))
        row, column = min(
            steps, key=lambda step: total[step[0] + 1, step[1] + 1] if min(step) >= 0 else np.inf
        )
        pairs.append((row, column))
    path = np.array(pairs[::-1], dtype=np.int64)
    return Warp(float(cost[path[:, 0], path[:, 1]].mean()), path)
