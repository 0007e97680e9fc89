# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the node fares, judged by its streams and the problems of images; on `diagnostics` and in the log."""

from __future__ import annotations

import time
from typing import Any, NamedTuple

from teo_common.diagnostics import Diagnosis, DiagnosticsPublisher, Level
from teo_skeleton_retriever.detectors.detector import left_out_sentence
from teo_skeleton_retriever.empty_space import depth_fault
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.node.stream_stats import Percentiles, StreamReport, StreamStats

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
    elif fault := depth_fault(report.depth_share, report.depth_median):
        code = "wrong_depth" if report.depth_share else "no_depth_measured"
        level, message = Level.WARN, f"{code}: {fault}"
    elif told := left_out_sentence(report.people_left_out):
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
    for name, times in {
        "arrival to result": report.delay,
        "image stamp to result": report.age,
        "detector": report.detector,
        "own time": report.own,
    }.items():
        values |= _milliseconds(name, times)
    values |= {
        "results": str(report.results),
        "people": str(report.people),
        "people left out": str(report.people_left_out),
        "signer": "" if report.signer is None else str(report.signer),
        "depth known [%]": f"{100.0 * report.depth_share:.0f}",
        "median depth [m]": f"{report.depth_median:.2f}",
        "dropped": str(sum(report.dropped.values())),
    }
    return values | {f"dropped {reason}": str(count) for reason, count in sorted(report.dropped.items())}


def _milliseconds(name: str, times: Percentiles) -> dict[str, str]:
    return {
        f"{name}, median [ms]": f"{times.median * 1e3:.1f}",
        f"{name}, p99 [ms]": f"{times.p99 * 1e3:.1f}",
    }


_SAY_AGAIN = 5.0  # [s] after which a problem that goes on is logged again


class ImageDiagnostics:
    """Publishes the state when asked, and at once when a problem is new. May be used by several threads."""

    def __init__(self, node: Any, stats: StreamStats, topics: dict[str, str]) -> None:
        """Create the publisher.

        Args:
            node: To publish and to log with.
            stats: Of its streams.
            topics: Name of the topic of each stream that must come.
        """
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
