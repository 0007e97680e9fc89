# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Translator, executor and driver on three machines: what delay, loss and a partition that heals cost.

The machines are network namespaces, set up as docs/machines.md says, tunnel included. In each row a text is
typed on the laptop five times, or once where the robot is cut off in the midst of signing it. The baseline is
the first row, a network without delay and loss. Needs root, `wg` and `wireguard-go`.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections import Counter
from functools import partial
from pathlib import Path

from hosts import missing
from laboratory import PROGRAMS, ROOT, Laboratory
from witness import Seen

from report import Figure

# Name, one-way delay [s], share of packets lost, time without the robot [s].
_ROWS = (
    ("no delay", 0.0, 0.0, 0.0),
    ("20 ms each way", 0.02, 0.0, 0.0),
    ("50 ms each way, 2 % lost", 0.05, 0.02, 0.0),
    ("robot cut off for 5 s", 0.0, 0.0, 5.0),
    ("robot cut off for 60 s", 0.0, 0.0, 60.0),
)
_TIMEOUT = 180.0  # [s] until all is at rest again


def measure(texts: int = 5) -> list[Figure]:
    """One row for each kind of network."""
    if reason := missing(*PROGRAMS):
        return [Figure("three machines", f"not measured: {reason}")]
    os.chdir(ROOT)
    figures = []
    with tempfile.TemporaryDirectory() as folder, Laboratory(Path(folder)) as laboratory:
        for name, delay, loss, cut in _ROWS:
            laboratory.network.delay(delay)
            laboratory.network.lose(loss)
            figures.append(Figure(name, _row(laboratory, 1 if cut else texts, cut)))
    return figures


def _row(laboratory: Laboratory, texts: int, cut: float) -> str:
    before = laboratory.wait(lambda seen: seen.at_rest, _TIMEOUT)
    healed = 0.0
    for count in range(len(before.outcomes) + 1, len(before.outcomes) + 1 + texts):
        laboratory.say()
        if cut:
            laboratory.wait(_moves, _TIMEOUT)
            laboratory.network.cut("robot")
            time.sleep(cut)
            laboratory.network.heal()
            healed = time.monotonic()
        after = laboratory.wait(partial(_done, count), _TIMEOUT)
    outcomes = Counter(after.outcomes) - Counter(before.outcomes)
    named = Counter(after.named) - Counter(before.named)
    told = ", ".join(f"{number} {outcome}" for outcome, number in outcomes.most_common())
    reasons = ", ".join(f"{code} ({number})" for code, number in named.most_common()) or "none"
    recovered = f"; at rest {time.monotonic() - healed:.1f} s after" if cut else ""
    return (
        f"of {texts}: {told}; reasons given: {reasons}{recovered}; greatest speed over the limit"
        f" {after.fastest:.3f}, way past a limit {max(after.outside, 0.0):.3f} rad"
    )


def _moves(seen: Seen) -> bool:
    return not seen.at_rest


def _done(count: int, seen: Seen) -> bool:
    return seen.at_rest and len(seen.outcomes) == count
