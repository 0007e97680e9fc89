# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time

import pytest

from teo_skeleton_retriever.node.latest_frame_pipeline import LatestFramePipeline


class Done:
    """A second stage that notes what it gets."""

    def __init__(self) -> None:
        self.jobs: list[int] = []
        self.count = threading.Semaphore(0)

    def __call__(self, job: int) -> None:
        self.jobs.append(job)
        self.count.release()

    def wait(self) -> None:
        assert self.count.acquire(timeout=10)


def test_several_first_stages_run_at_once_and_the_order_stays():
    release = {job: threading.Event() for job in range(4)}
    begun, done = threading.Semaphore(0), Done()

    def first(job: int) -> int:
        begun.release()
        assert release[job].wait(timeout=10)
        return job

    pipeline = LatestFramePipeline(first, done, at_once=2)
    for job in (0, 1):
        pipeline.submit(job)
        assert begun.acquire(timeout=10)
    release[1].set()  # the second is ready before the first
    assert not done.count.acquire(timeout=0.05)
    release[0].set()
    done.wait()
    done.wait()
    pipeline.close()
    assert done.jobs == [0, 1]


@pytest.mark.parametrize("at_once", [1, 3])
def test_closing_waits_for_what_is_at_hand_and_a_pipeline_without_work_can_be_closed(at_once):
    LatestFramePipeline(print, print, at_once=at_once).close()
    finished = []

    def slow(job: int) -> None:
        time.sleep(0.05)
        finished.append(job)

    pipeline = LatestFramePipeline(slow, print, at_once=at_once)
    pipeline.submit(1)
    deadline = time.monotonic() + 10
    while pipeline._waiting is not None and time.monotonic() < deadline:
        time.sleep(0.001)
    pipeline.close()
    assert finished == [1]
