# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a stream of images fares: rates, delays, and what was dropped and why."""

from __future__ import annotations

import threading
from collections import Counter, deque
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

_WINDOW = 10.0  # [s] long enough for a 99th percentile of 300 images at 30 Hz
_MOST = 1200  # images of the window at 120 Hz; bounds the memory


class Percentiles(NamedTuple):
    """Of times [s]; NaN of none."""

    median: float
    p99: float


@dataclass(frozen=True, kw_only=True)
class StreamReport:
    """What happened in the last ten seconds, and the counts since the start.

    Attributes:
        rates: Messages or results per second, by stream [Hz].
        silent: Time since the last of each stream, or since the start if none has come [s].
        delay: From the arrival of an image's last part to its result.
        age: From an image's stamp to its result; NaN where the clocks have nothing to do with each other.
        detector: Time of the detector.
        own: Time of what comes after it.
        dropped: Since the start, by reason.
        results: Since the start.
        people: In the last image.
        depth_share: Part of its pixels with a depth, 0 to 1; NaN before the first.
        depth_median: Of its depths [m]; NaN if it has none.
        signer: Id of its signer, None if there is none.
        people_left_out: How many more people the detector sees than it follows.
    """

    rates: dict[str, float]
    silent: dict[str, float]
    delay: Percentiles
    age: Percentiles
    detector: Percentiles
    own: Percentiles
    dropped: dict[str, int]
    results: int
    people: int
    depth_share: float
    depth_median: float
    signer: int | None
    people_left_out: int


class Result(NamedTuple):
    """What is kept of one processed image; times in seconds."""

    now: float
    delay: float
    age: float
    detector: float
    own: float
    people: int
    depth_share: float
    depth_median: float
    signer: int | None
    people_left_out: int = 0


class StreamStats:
    """Counts. May be used by several threads. Times [s] are of a clock that never goes back."""

    def __init__(self, streams: tuple[str, ...], now: float) -> None:
        """Begin with nothing.

        Args:
            streams: Names of what arrives.
            now: Time of the start.
        """
        self._start = now
        self._lock = threading.Lock()
        self._arrivals: dict[str, deque[float]] = {name: deque(maxlen=_MOST) for name in streams}
        self._results: deque[Result] = deque(maxlen=_MOST)
        self._dropped: Counter[str] = Counter()
        self._count = 0

    def arrived(self, stream: str, now: float) -> None:
        """Count a message."""
        with self._lock:
            self._arrivals[stream].append(now)

    def drop(self, reason: str, count: int = 1) -> None:
        """Count images that are not processed."""
        with self._lock:
            if count:
                self._dropped[reason] += count

    def done(self, result: Result) -> None:
        """Count a processed image."""
        with self._lock:
            self._results.append(result)
            self._count += 1

    def report(self, now: float) -> StreamReport:
        """Say how it fares."""
        with self._lock:
            arrivals = {name: list(times) for name, times in self._arrivals.items()}
            results = [result for result in self._results if now - result.now <= _WINDOW]
            last = self._results[-1] if self._results else None
            dropped, count = dict(self._dropped), self._count
        streams = arrivals | {"results": [result.now for result in results]}
        return StreamReport(
            rates={name: _rate(times, now) for name, times in streams.items()},
            silent={name: now - (times[-1] if times else self._start) for name, times in arrivals.items()},
            delay=_percentiles([result.delay for result in results]),
            age=_percentiles([result.age for result in results]),
            detector=_percentiles([result.detector for result in results]),
            own=_percentiles([result.own for result in results]),
            dropped=dropped,
            results=count,
            people=last.people if last else 0,
            depth_share=last.depth_share if last else float("nan"),
            depth_median=last.depth_median if last else float("nan"),
            signer=last.signer if last else None,
            people_left_out=last.people_left_out if last else 0,
        )


def _rate(times: list[float], now: float) -> float:
    """Events per second over the window, or over the time since its first event while that is shorter."""
    recent = [time for time in times if now - time <= _WINDOW]
    return (len(recent) - 1) / (now - recent[0]) if len(recent) > 1 and now > recent[0] else 0.0


def _percentiles(values: list[float]) -> Percentiles:
    known = [value for value in values if np.isfinite(value)]
    if not known:
        return Percentiles(float("nan"), float("nan"))
    median, p99 = np.percentile(known, [50, 99])
    return Percentiles(float(median), float(p99))
