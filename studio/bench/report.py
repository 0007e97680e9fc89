# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Figures as the benches give them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Figure(NamedTuple):
    """One measured figure: what was measured, and the value with its unit."""

    what: str
    value: str


def percentiles(what: str, seconds: Sequence[float]) -> Figure:
    """Median and 99th percentile of times [s], in milliseconds."""
    median, p99 = np.percentile(seconds, [50, 99]) * 1e3
    return Figure(f"{what} ({len(seconds)} times)", f"median {median:.2f} ms, p99 {p99:.2f} ms")


def spread(values: NDArray[np.float64] | Sequence[float], unit: str) -> str:
    """Median and 90th percentile: "median 11, p90 24 deg"."""
    median, p90 = np.percentile(values, [50, 90])
    return f"median {median:.0f}, p90 {p90:.0f} {unit}"


def share(count: int, total: int) -> str:
    """A share with Wilson's interval, in which the true one is with 95 %: "76 (78 %, 69 to 85 %)"."""
    z = 1.96
    part = count / total
    middle = part + z * z / (2 * total)
    deviation = z * math.sqrt(part * (1 - part) / total + z * z / (4 * total * total))
    low, high = (abs(middle + side) / (1 + z * z / total) for side in (-deviation, deviation))
    return f"{count} ({100 * part:.0f} %, {100 * low:.0f} to {100 * high:.0f} %)"
