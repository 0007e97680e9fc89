"""The cheapest way through time over candidates (Viterbi, IEEE Trans. Inf. Theory 1967)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def cheapest_way(
    cost: Array, values: Array, price: float, *, farthest: Array | None = None, haste: float = 0.0
) -> Array:
    """One candidate at each moment, such that their costs and the ways between them are least together.

    Args:
        cost: Of c candidates at n moments. Shape (n, c).
        values: What they are. Shape (n, c, k).
        price: Of the square of the way from one moment to the next.
        farthest: How far each of the k values goes from one moment to the next without haste; None for as
            far as it likes. Shape (n - 1,).
        haste: Price of the square of what is beyond.

    Returns:
        The values chosen. Shape (n, k).
    """
    total = cost[0]
    origins = []
    reach = np.full(len(cost) - 1, np.inf) if farthest is None else farthest
    for (before, now), own, far in zip(pairwise(values), cost[1:], reach, strict=True):
        way = np.abs(now[:, None] - before[None])
        through = total[None] + (price * way**2 + haste * np.maximum(way - far, 0.0) ** 2).sum(axis=2)
        origins.append(through.argmin(axis=1))
        total = through.min(axis=1) + own
    index = int(total.argmin())
    chosen = [index]
    for origin in reversed(origins):
        index = int(origin[index])
        chosen.append(index)
    path: Array = values[np.arange(len(values)), chosen[::-1]]
    return path
