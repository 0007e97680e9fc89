# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The cheapest path through time over candidates (Viterbi, IEEE Trans. Inf. Theory 1967)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

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
