# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time

import pytest

from teo_skeleton_retriever.node.latest_frame_pipeline import LatestFramePipeline


class Gate:
    """A stage that begins, and goes on only when told to."""

    def __init__(self) -> None:
        self.begun, self.go_on = threading.Semaphore(0), threading.Semaphore(0)
        self.jobs: list[int] = []

    def __call__(self, job: int) -> int:
        self.jobs.append(job)
        self.begun.release()
        assert self.go_on.acquire(timeout=10)
        return job

    def wait(self) -> None:
        assert self.begun.acquire(timeout=10)


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


def test_the_second_stage_of_one_runs_beside_the_first_of_the_next():
    first, second = Gate(), Gate()
    pipeline = LatestFramePipeline(first, second)
    pipeline.submit(1)
    first.wait()
    first.go_on.release()
    second.wait()  # 1 is in its second stage
    pipeline.submit(2)
    first.wait()  # and 2 in its first
    first.go_on.release()
    second.go_on.release(2)
    second.wait()
    pipeline.close()
    assert second.jobs == [1, 2]


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


def test_two_are_begun_and_one_waits_whose_place_a_newer_one_takes():
    first, done = Gate(), Done()
    pipeline = LatestFramePipeline(first, done, at_once=2)
    for job in (1, 2):
        assert pipeline.submit(job) is None
        first.wait()
    assert [pipeline.submit(job) for job in (3, 4, 5)] == [None, 3, 4]
    assert not first.begun.acquire(timeout=0.05)
    first.go_on.release(3)
    for _ in range(3):
        done.wait()
    pipeline.close()
    assert done.jobs == [1, 2, 5]
