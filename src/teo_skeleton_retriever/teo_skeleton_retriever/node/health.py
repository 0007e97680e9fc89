# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the node fares: rates, delays and dropped images, judged, on `diagnostics` and in the log."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter, deque
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from teo_common.diagnostics import Diagnosis, DiagnosticsPublisher, Level
from teo_skeleton_retriever.detectors.detector import left_out_sentence
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.image_retriever import depth_fault

_WINDOW = 10.0  # [s] long enough for a 99th percentile of 300 images at 30 Hz
_MOST = 1200  # images of the window at 120 Hz; bounds the memory


# Times of `Result` by the name that diagnostics give them.
_TIMES = {
    "arrival to result": "delay",
    "image stamp to result": "age",
    "detector": "detector",
    "own time": "own",
}


class Percentiles(NamedTuple):
    """Of times [s]; NaN of none."""

    median: float
    p99: float


class Result(NamedTuple):
    """What is kept of one processed image, the defaults of none; times in seconds."""

    now: float = math.nan
    """when it was done"""
    delay: float = math.nan
    """from the arrival of the image's last part to the result"""
    age: float = math.nan
    """from the image's stamp to the result; NaN where the clocks have nothing to do with each other"""
    detector: float = math.nan
    """time of the detector"""
    own: float = math.nan
    """time of what comes after it"""
    people: int = 0
    depth_share: float = math.nan
    """part of the pixels with a depth, 0 to 1"""
    depth_median: float = math.nan
    """of the depths [m]; NaN if there is none"""
    signer: int | None = None
    """id; None if there is none"""
    people_left_out: int = 0
    """how many more people the detector sees than it follows"""


@dataclass(frozen=True, kw_only=True)
class StreamReport:
    """What happened in the last ten seconds, and the counts since the start.

    Attributes:
        rates: Messages or results per second, by stream [Hz].
        silent: Time since the last of each stream, or since the start if none has come [s].
        times: Percentiles of the times of `Result`, by the name that diagnostics give them.
        dropped: Since the start, by reason.
        results: Since the start.
        last: The last result.
    """

    rates: dict[str, float]
    silent: dict[str, float]
    times: dict[str, Percentiles]
    dropped: dict[str, int]
    results: int
    last: Result


class StreamStats:
    """Counts. May be used by several threads. Times [s] are of a clock that never goes back."""

    def __init__(self, streams: tuple[str, ...], now: float) -> None:
        """Begin with nothing, at a time; `streams` are the names of what arrives."""
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
            last = self._results[-1] if self._results else Result()
            dropped, count = dict(self._dropped), self._count
        streams = arrivals | {"results": [result.now for result in results]}
        return StreamReport(
            rates={name: _rate(times, now) for name, times in streams.items()},
            silent={name: now - (times[-1] if times else self._start) for name, times in arrivals.items()},
            times={
                name: _percentiles([getattr(result, field) for result in results])
                for name, field in _TIMES.items()
            },
            dropped=dropped,
            results=count,
            last=last,
        )


def _rate(times: list[float], now: float) -> float:
    """Events per second over the window, or over the time since its first event while that is shorter."""
    recent = [time for time in times if now - time <= _WINDOW]
    return (len(recent) - 1) / (now - recent[0]) if len(recent) > 1 and now > recent[0] else 0.0


def _percentiles(values: list[float]) -> Percentiles:
    known = [value for value in values if np.isfinite(value)]
    if not known:
        return Percentiles(math.nan, math.nan)
    median, p99 = np.percentile(known, [50, 99])
    return Percentiles(float(median), float(p99))


_SILENCE = 2.0  # [s] without a message, after which a topic counts as silent: many images of any camera
_SLOW = 0.9  # a tenth fewer results than images: beyond the jitter of a busy machine


class Problem(NamedTuple):
    """Why an image could not be processed."""

    code: str
    sentence: str

    @classmethod
    def of(cls, error: Exception) -> Problem:
        """Name an error; one that is none of ours is a fault of the node."""
        if isinstance(error, RetrieverError):
            return cls(error.code, error.sentence)
        return cls("internal", f"fault in the node: {type(error).__name__}: {error}")


def assess(report: StreamReport, topics: dict[str, str], problem: Problem | None) -> Diagnosis:
    """Judge how the node fares.

    Args:
        report: Of the streams.
        topics: Name of the topic of each stream that must come.
        problem: Of an image since the last time, None if there was none.
    """
    level, message = Level.OK, f"{report.rates['results']:.1f} images per second"
    silent = [topic for stream, topic in topics.items() if report.silent[stream] > _SILENCE]
    if problem is not None:
        level = Level.ERROR if problem.code == "internal" else Level.WARN
        message = f"{problem.code}: {problem.sentence}"
    elif silent:
        level, message = Level.WARN, f"nothing comes on {', '.join(silent)}"
    elif fault := depth_fault(report.last.depth_share, report.last.depth_median):
        code = "wrong_depth" if report.last.depth_share else "no_depth_measured"
        level, message = Level.WARN, f"{code}: {fault}"
    elif told := left_out_sentence(report.last.people_left_out):
        level, message = Level.WARN, f"too_many_people: {told}"
    elif report.rates["results"] < _SLOW * report.rates["color"]:
        level = Level.WARN
        message = (
            f"{report.rates['results']:.1f} of {report.rates['color']:.1f} images per second: "
            "too slow, or depth does not match"
        )
    return Diagnosis(level, message, _values(report))


def _values(report: StreamReport) -> dict[str, str]:
    values = {f"{name} [Hz]": f"{rate:.1f}" for name, rate in report.rates.items()}
    for name, times in report.times.items():
        values[f"{name}, median [ms]"] = f"{times.median * 1e3:.1f}"
        values[f"{name}, p99 [ms]"] = f"{times.p99 * 1e3:.1f}"
    last = report.last
    values |= {
        "results": str(report.results),
        "people": str(last.people),
        "people left out": str(last.people_left_out),
        "signer": "" if last.signer is None else str(last.signer),
        "depth known [%]": f"{100.0 * last.depth_share:.0f}",
        "median depth [m]": f"{last.depth_median:.2f}",
        "dropped": str(sum(report.dropped.values())),
    }
    return values | {f"dropped {reason}": str(count) for reason, count in sorted(report.dropped.items())}


_SAY_AGAIN = 5.0  # [s] after which a problem that goes on is logged again


class ImageDiagnostics:
    """Publishes the state when asked, and at once when a problem is new. May be used by several threads."""

    def __init__(self, node: Any, stats: StreamStats, topics: dict[str, str]) -> None:
        """Create the publisher; `topics` are those of the streams that must come."""
        self._node = node
        self._stats = stats
        self._topics = topics
        self._publisher = DiagnosticsPublisher(node, "images")
        self._problem: Problem | None = None
        self._said: dict[str, float] = {}

    def report(self, problem: Problem, details: str = "") -> None:
        """Note a problem for the next diagnostics; tell it at once unless it was told just now.

        Args:
            problem: Why an image was left out.
            details: For the log, which make it an error.
        """
        self._problem = problem
        now = time.monotonic()
        if now - self._said.get(problem.code, -_SAY_AGAIN) < _SAY_AGAIN:
            return
        self._said[problem.code] = now
        sentence = f"image left out, {problem.code}: {problem.sentence}"
        if details:
            self._node.get_logger().error(f"{sentence}\n{details}")
        else:
            self._node.get_logger().warning(sentence)
        self._publish(problem)

    def publish(self) -> None:
        """Publish the state, with the problem that there was since the last time."""
        problem, self._problem = self._problem, None
        diagnosis = self._publish(problem)
        if diagnosis.level is not Level.OK and problem is None:
            self._node.get_logger().warning(diagnosis.message, throttle_duration_sec=_SAY_AGAIN)

    def _publish(self, problem: Problem | None) -> Diagnosis:
        diagnosis = assess(self._stats.report(time.monotonic()), self._topics, problem)
        self._publisher.publish(diagnosis)
        return diagnosis
