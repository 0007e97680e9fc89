# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Figures of a review: agreement between reviewers, and how far a share of so many answers can be trusted."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Hashable, Iterable, Sequence
from statistics import NormalDist
from typing import NamedTuple


class Interval(NamedTuple):
    """A share and the interval in which the true one is with 95 %; all 0 to 1."""

    share: float
    low: float
    high: float


def wilson(successes: int, total: int) -> Interval | None:
    """The score interval of a share with 95 % confidence; None of no answers.

    E. B. Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22 (1927).
    Answers of one person to several items hang together, so that it is rather too narrow.
    """
    if total == 0:
        return None
    z = NormalDist().inv_cdf(0.975)
    share = successes / total
    middle = (share + z * z / (2 * total)) / (1 + z * z / total)
    half = z * math.sqrt(share * (1 - share) / total + z * z / (4 * total * total)) / (1 + z * z / total)
    return Interval(share, max(middle - half, 0.0), min(middle + half, 1.0))


def krippendorff_alpha(units: Iterable[Sequence[Hashable]]) -> float | None:
    """Krippendorff's alpha of nominal values: 1 if reviewers agree always, 0 if as by chance.

    K. Krippendorff, "Computing Krippendorff's alpha-reliability" (2011), by coincidences. Not every reviewer
    needs to have rated every unit.

    Args:
        units: For each item the values that reviewers gave it.

    Returns:
        At most 1; None if no item has two values, or all values of all items are the same: then nothing tells
        agreement from habit.
    """
    coincidences: Counter[tuple[Hashable, Hashable]] = Counter()
    for values in units:
        counts = Counter(values)
        pairs = len(values) - 1
        if pairs < 1:
            continue
        for one, first in counts.items():
            for other, second in counts.items():
                coincidences[one, other] += first * (second - (one == other)) / pairs  # type: ignore[assignment]
    totals: Counter[Hashable] = Counter()
    for (one, _), count in coincidences.items():
        totals[one] += count
    n = sum(totals.values())
    expected = n * n - sum(count * count for count in totals.values())
    if n < 2 or expected == 0:
        return None
    observed = sum(count for (one, other), count in coincidences.items() if one != other)
    return 1.0 - (n - 1) * observed / expected
