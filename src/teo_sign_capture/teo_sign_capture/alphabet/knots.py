"""Fewer knots for the same motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def reduce_knots(times: Array, positions: Array, tolerance: float) -> Indices:
    """Choose knots such that straight lines between them stay near (Ramer 1972; Douglas, Peucker 1973).

    Args:
        times: Increasing [s]. Shape (n,).
        positions: Shape (n, m) [rad].
        tolerance: No joint is farther than this from the lines between the knots, at any sample [rad].

    Returns:
        Indices of the knots, increasing, the first and the last among them. Shape (k,).
    """
    if len(times) < 2:
        return np.arange(len(times), dtype=np.int64)
    kept = {0, len(times) - 1}
    spans = [(0, len(times) - 1)]
    while spans:
        start, end = spans.pop()
        if end - start < 2:
            continue
        inside = slice(start + 1, end)
        share = (times[inside] - times[start]) / (times[end] - times[start])
        line = positions[start] + share[:, None] * (positions[end] - positions[start])
        away = np.abs(positions[inside] - line).max(axis=1)
        worst = int(away.argmax())
        if away[worst] > tolerance:
            middle = start + 1 + worst
            kept.add(middle)
            spans += [(start, middle), (middle, end)]
    return np.array(sorted(kept), dtype=np.int64)
