# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the translator has done so far: counts, diagnostics, and texts as log lines show them."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np

from teo_common.diagnostics import Diagnosis, Level

#: Latest texts whose latencies are kept; enough for a 99th percentile.
_KEPT = 1000
# A log line shows this much of a text [characters].
_LENGTH = 80


@dataclass
class Statistics:
    """Counts of texts and how long they took.

    Attributes:
        done: Texts that were translated.
        refused: Texts that were not.
        last_refusal: Code and sentence of the last refusal; empty if there was none.
    """

    done: int = 0
    refused: int = 0
    last_refusal: str = ""
    _told: int = 0  # refusals at the last diagnosis
    _latencies: deque[float] = field(default_factory=lambda: deque(maxlen=_KEPT))

    def add_done(self, latency: float) -> None:
        """Count a text, and how long it took from its arrival to its tokens [s]."""
        self.done += 1
        self._latencies.append(latency)

    def add_refused(self, reason: str) -> None:
        """Count a text that was not translated, and keep why."""
        self.refused += 1
        self.last_refusal = reason

    def newly_refused(self) -> int:
        """Texts refused since this was asked last."""
        told, self._told = self._told, self.refused
        return self._told - told

    def latency(self, percentile: float) -> float | None:
        """A percentile, 0 to 100, of the latest texts' latencies [s]; None if there are none."""
        latencies = list(self._latencies)
        return float(np.percentile(latencies, percentile)) if latencies else None


def quoted(text: str) -> str:
    """A text in quotes, with characters that could upset a terminal escaped."""
    return short(repr(text))


def short(text: str) -> str:
    """A text, cut to the length of a log line."""
    return text if len(text) <= _LENGTH else text[: _LENGTH - 1] + "…"


def diagnose(
    statistics: Statistics, *, language: str, model: str, active: bool, waiting: int, signs: int | None
) -> Diagnosis:
    """How the translator is: a warning where it has refused texts since the last diagnosis.

    Args:
        statistics: What it has done.
        language: Code of the sign language in use.
        model: Name of the model in use.
        active: Whether it listens to texts.
        waiting: Texts that wait.
        signs: Glosses that have signs; None if that is not known.
    """
    values = {
        "language": language,
        "model": model,
        "state": "active" if active else "inactive",
        "texts done": str(statistics.done),
        "texts refused": str(statistics.refused),
        "texts waiting": str(waiting),
        "latency median [ms]": _milliseconds(statistics.latency(50.0)),
        "latency p99 [ms]": _milliseconds(statistics.latency(99.0)),
        "last refusal": statistics.last_refusal,
        "signs known": "unknown" if signs is None else str(signs),
    }
    refused = statistics.newly_refused()
    if refused:
        return Diagnosis(Level.WARN, f"{refused} texts refused: {statistics.last_refusal}", values)
    return Diagnosis(Level.OK, f"{values['state']}, model {model}", values)


def _milliseconds(seconds: float | None) -> str:
    return "" if seconds is None else f"{seconds * 1000:.1f}"
