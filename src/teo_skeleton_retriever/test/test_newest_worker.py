from __future__ import annotations

import threading

from teo_skeleton_retriever.newest_worker import NewestWorker


class Gate:
    """Work that begins, and goes on only when told to."""

    def __init__(self) -> None:
        self.begun, self.go_on = threading.Semaphore(0), threading.Semaphore(0)
        self.done: list[int] = []

    def __call__(self, job: int) -> None:
        self.begun.release()
        assert self.go_on.acquire(timeout=10)
        self.done.append(job)


def test_the_newest_job_takes_the_place_of_one_that_waits():
    gate = Gate()
    worker = NewestWorker(gate, "test")
    assert worker.submit(1) is None
    assert gate.begun.acquire(timeout=10)
    assert [worker.submit(job) for job in (2, 3, 4)] == [None, 2, 3]
    gate.go_on.release()
    assert gate.begun.acquire(timeout=10)
    gate.go_on.release()
    worker.close()
    assert gate.done == [1, 4]


def test_closing_finishes_the_job_at_hand_and_lets_go_what_waits():
    gate = Gate()
    worker = NewestWorker(gate, "test")
    worker.submit(1)
    assert gate.begun.acquire(timeout=10)
    worker.submit(2)
    closing = threading.Thread(target=worker.close)
    closing.start()
    gate.go_on.release(2)
    closing.join(timeout=10)
    assert not closing.is_alive()
    assert gate.done in ([1], [1, 2])  # the second may have begun before the end was told


def test_a_worker_without_work_can_be_closed():
    NewestWorker(print, "test").close()


def test_handing_over_waits_until_the_job_before_was_begun_and_loses_none():
    gate = Gate()
    worker = NewestWorker(gate, "test")
    giver = threading.Thread(target=lambda: [worker.hand_over(job) for job in range(5)])
    giver.start()
    gate.go_on.release(5)
    giver.join(timeout=10)
    assert not giver.is_alive()
    worker.hand_over(5)
    gate.go_on.release(2)
    worker.hand_over(6)  # waits until 5 was begun
    worker.close()
    assert gate.done[:6] == [0, 1, 2, 3, 4, 5]


def test_closing_lets_go_of_who_waits_to_hand_over():
    gate = Gate()
    worker = NewestWorker(gate, "test")
    worker.submit(1)
    assert gate.begun.acquire(timeout=10)
    worker.submit(2)
    giver = threading.Thread(target=worker.hand_over, args=(3,))
    giver.start()
    closing = threading.Thread(target=worker.close)
    closing.start()
    giver.join(timeout=10)
    assert not giver.is_alive()
    gate.go_on.release(3)
    closing.join(timeout=10)
    assert not closing.is_alive()
