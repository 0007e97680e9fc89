# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest

from teo_common.diagnostics import Level
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.node.health import Problem, Result, StreamStats, assess

TOPICS = {"color": "/c", "depth": "/d", "camera_info": "/i"}


def result(now: float, **changes: object) -> Result:
    values = {"delay": 0.02, "age": 0.05, "detector": 0.015, "own": 0.004, "people": 1, "depth_share": 0.8}
    return Result(now=now, **({"signer": 3, "depth_median": 1.6} | values | changes))


def streaming(seconds: float, rate: float = 30.0, results: float = 30.0, **changes: object) -> StreamStats:
    stats = StreamStats(tuple(TOPICS), 0.0)
    for i in range(round(seconds * rate)):
        for stream in TOPICS:
            stats.arrived(stream, i / rate)
    for i in range(round(seconds * results)):
        stats.done(result(i / results, **changes))
    return stats


def test_rates_and_delays_are_those_of_the_last_ten_seconds():
    report = streaming(30.0).report(30.0)
    assert report.rates["color"] == pytest.approx(30.0, rel=0.02)
    assert report.rates["results"] == pytest.approx(30.0, rel=0.02)
    assert report.times["arrival to result"].median == pytest.approx(0.02)
    assert report.times["own time"].p99 == pytest.approx(0.004)
    assert report.results == 900
    assert report.last.signer == 3


def test_a_stream_that_stopped_loses_its_rate():
    report = streaming(5.0).report(16.0)
    assert report.rates["color"] == 0.0
    assert math.isnan(report.times["arrival to result"].median)
    assert report.silent["depth"] == pytest.approx(11.0, abs=0.1)


def test_what_is_wrong_is_told():
    assert "/c, /d, /i" in assess(StreamStats(tuple(TOPICS), 0.0).report(2.1), TOPICS, None).message
    assert assess(StreamStats(tuple(TOPICS), 0.0).report(0.5), TOPICS, None).level is Level.OK
    slow = assess(streaming(10.0, results=12.0).report(10.0), TOPICS, None)
    assert (slow.level, "too slow" in slow.message) == (Level.WARN, True)
    blind = assess(streaming(10.0, depth_share=0.0).report(10.0), TOPICS, None)
    assert blind.message.startswith("no_depth_measured")
    for median in (0.0016, 1600.0):
        odd = assess(streaming(10.0, depth_median=median).report(10.0), TOPICS, None)
        assert (odd.level, odd.message.startswith("wrong_depth"), "units?" in odd.message) == (
            Level.WARN,
            True,
            True,
        )


def test_people_whom_the_detector_has_no_place_for_are_told():
    health = assess(streaming(10.0, people=4, people_left_out=2).report(10.0), TOPICS, None)
    assert (health.level, health.values["people left out"]) == (Level.WARN, "2")
    assert health.message.startswith("too_many_people: 2 more people are seen")


def test_a_problem_is_told_before_anything_else_and_a_fault_of_its_own_is_an_error():
    report = streaming(10.0).report(10.0)
    told = assess(report, TOPICS, Problem.of(RetrieverError("wrong_length", "expected more")))
    assert (told.level, told.message) == (Level.WARN, "wrong_length: expected more")
    assert assess(report, TOPICS, Problem.of(ZeroDivisionError("x"))).level is Level.ERROR
