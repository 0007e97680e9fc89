"""Figures as the benches give them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Figure(NamedTuple):
    """One measured figure: what was measured, and the value with its unit."""

    what: str
    value: str


def percentiles(what: str, seconds: Sequence[float]) -> Figure:
    """Median and 99th percentile of times [s], in milliseconds."""
    median, p99 = np.percentile(seconds, [50, 99]) * 1e3
    return Figure(f"{what} ({len(seconds)} times)", f"median {median:.2f} ms, p99 {p99:.2f} ms")
