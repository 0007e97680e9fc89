# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading

import camera_take as take
import numpy as np
import pytest
from node_bench import NodeBench

from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D


def test_images_wait_for_camera_info_and_are_followed_once_it_comes(start):
    bench = start(take.person())
    bench.send_until(lambda: bench.summary.startswith("no_camera_info"), info=None)
    assert bench.diagnostics[-1].status[0].level == b"\x01"
    assert "/camera/color/camera_info" in bench.summary
    assert not bench.arrays
    assert bench.recovers()
    bench.send_until(lambda: bench.diagnostics[-1].status[0].level == b"\x00")


def test_what_it_has_no_time_for_is_dropped_for_the_newest_and_counted(context):
    class Slow:
        name = "slow"
        images_at_once = 1

        def __init__(self) -> None:
            self.seen: list[float] = []
            self.goes_on = threading.Event()

        def detect(self, image: np.ndarray, stamp: float) -> tuple[Person2D, ...]:
            del image
            self.seen.append(stamp)
            assert self.goes_on.wait(timeout=20.0)
            return ()

        def close(self) -> None:
            pass

    detector = Slow()
    bench = NodeBench(context, detector)
    try:
        sent = []

        def send() -> None:
            if len(sent) < 10:
                sent.append(0)
                bench.send()

        # One is at the detector, the newest waits, the others had to go.
        bench.until(lambda: bench.said("dropped busy") == "8", doing=send)
        assert len(detector.seen) == 1
        detector.goes_on.set()
        last = (take.START + 9 * take.PERIOD) * 1e-9
        bench.until(lambda: detector.seen[-1] == pytest.approx(last, abs=1e-6))
        assert len(detector.seen) == 2
    finally:
        detector.goes_on.set()
        bench.close()


def test_a_detector_that_fails_is_told_and_tried_again(context):
    class Failing:
        name = "failing"
        images_at_once = 1
        errors = iter(
            [RetrieverError("bad_day", "expected a good day")] * 3 + [ZeroDivisionError("on purpose")] * 3
        )

        def detect(self, image: np.ndarray, stamp: float) -> tuple[Person2D, ...]:
            del image, stamp
            error = next(self.errors, None)
            if error is not None:
                raise error
            return (take.person(),)

        def close(self) -> None:
            pass

    bench = NodeBench(context, Failing())
    try:
        bench.send_until(bench.followed)
        bench.until(lambda: bench.said("dropped bad_day") == "3" and bench.said("dropped internal") == "3")
    finally:
        bench.close()
