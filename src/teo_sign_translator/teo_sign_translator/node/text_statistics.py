"""What a translator has done so far."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np

#: Latest texts whose latencies are kept; enough for a 99th percentile.
_KEPT = 1000


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
    _latencies: deque[float] = field(default_factory=lambda: deque(maxlen=_KEPT))

    def add_done(self, latency: float) -> None:
        """Count a text, and how long it took from its arrival to its tokens [s]."""
        self.done += 1
        self._latencies.append(latency)

    def add_refused(self, reason: str) -> None:
        """Count a text that was not translated, and keep why."""
        self.refused += 1
        self.last_refusal = reason

    def latency(self, percentile: float) -> float | None:
        """A percentile, 0 to 100, of the latest texts' latencies [s]; None if there are none."""
        latencies = list(self._latencies)
        return float(np.percentile(latencies, percentile)) if latencies else None
