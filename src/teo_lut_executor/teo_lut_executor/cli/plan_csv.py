"""Plans as CSV: time [s] first, then a column of positions [rad] for each joint."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from teo_common.atomic_files import write_atomically
from teo_motion.sentence.plan import Plan, sample_at

RATE = 100
"""Rows a second [Hz], as TEO's own state is published."""

# A nanoradian: what is written stays within the limits that it stands on.
_DECIMALS = 9


def write_csv(path: Path, plan: Plan) -> int:
    """Write a plan, whole or not at all.

    Args:
        path: File to write; its folder exists.
        plan: What to write, from 0 s to the first row at rest.

    Returns:
        Number of rows below the header.

    Raises:
        OSError: The file cannot be written.
    """
    rows = math.ceil(plan.duration * RATE) + 1
    times = np.arange(rows) / RATE
    positions = sample_at(plan.motions, times).positions
    lines = [",".join(("time", *plan.names))]
    lines += [
        f"{time:.2f}," + ",".join(f"{value:.{_DECIMALS}f}" for value in row)
        for time, row in zip(times.tolist(), positions.tolist(), strict=True)
    ]
    write_atomically(path, ("\n".join(lines) + "\n").encode())
    return rows
