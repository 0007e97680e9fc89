# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the node fares, judged by its streams and the problems of images."""

from __future__ import annotations

from typing import NamedTuple

from teo_common.diagnostics import Diagnosis, Level
from teo_skeleton_retriever.detectors.detector import left_out_sentence
from teo_skeleton_retriever.empty_space import depth_fault
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.node.stream_stats import Percentiles, StreamReport

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
