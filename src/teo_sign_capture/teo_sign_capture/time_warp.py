# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Dynamic time warping (Sakoe and Chiba, IEEE Trans. ASSP 1978): how alike two motions are at any pace."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array


class Warp(NamedTuple):
    """How two motions correspond: mean distance along the way [unit], and pairs of frames, shape (p, 2)."""

    distance: float
    pairs: NDArray[np.int64]


def warp(first: Array, second: Array) -> Warp:
    """Align two motions in time; frames are as far apart as what differs most. Shapes (n, f, 3) each."""
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
