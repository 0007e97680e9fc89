from __future__ import annotations

import threading

from teo_skeleton_retriever.newest_worker import NewestWorker


def test_the_newest_job_takes_the_place_of_one_that_waits():
    begun, go_on, done = threading.Semaphore(0), threading.Semaphore(0), []

    def work(job: int) -> None:
        begun.release()
        assert go_on.acquire(timeout=10)
        done.append(job)

    worker = NewestWorker(work, "test")
    assert worker.submit(1) is None
    assert begun.acquire(timeout=10)
    assert [worker.submit(job) for job in (2, 3, 4)] == [None, 2, 3]
    go_on.release()
    assert begun.acquire(timeout=10)
    go_on.release()
    worker.close()
    assert done == [1, 4]


def test_closing_finishes_the_job_at_hand_and_lets_go_what_waits():
    begun, go_on, done = threading.Semaphore(0), threading.Semaphore(0), []

    def work(job: int) -> None:
        begun.release()
        assert go_on.acquire(timeout=10)
        done.append(job)

    worker = NewestWorker(work, "test")
    worker.submit(1)
    assert begun.acquire(timeout=10)
    worker.submit(2)
    closing = threading.Thread(target=worker.close)
    closing.start()
    go_on.release(2)
    closing.join(timeout=10)
    assert not closing.is_alive()
    assert done in ([1], [1, 2])  # the second may have begun before the end was told


def test_a_worker_without_work_can_be_closed():
    NewestWorker(print, "test").close()


def test_handing_over_waits_until_the_job_before_was_begun_and_loses_none():
    go_on, done = threading.Semaphore(0), []

    def work(job: int) -> None:
        assert go_on.acquire(timeout=10)
        done.append(job)

    worker = NewestWorker(work, "test")
    giver = threading.Thread(target=lambda: [worker.hand_over(job) for job in range(5)])
    giver.start()
    for _ in range(5):
        go_on.release()
    giver.join(timeout=10)
    assert not giver.is_alive()
    worker.hand_over(5)
    go_on.release()
    worker.hand_over(6)  # waits until 5 was begun
    go_on.release()
    worker.close()
    assert done[:6] == [0, 1, 2, 3, 4, 5]


def test_closing_lets_go_of_who_waits_to_hand_over():
    begun, go_on = threading.Event(), threading.Semaphore(0)

    def work(_: int) -> None:
        begun.set()
        assert go_on.acquire(timeout=10)

    worker = NewestWorker(work, "test")
    worker.submit(1)
    assert begun.wait(timeout=10)
    worker.submit(2)
    giver = threading.Thread(target=worker.hand_over, args=(3,))
    giver.start()
    closing = threading.Thread(target=worker.close)
    closing.start()
    giver.join(timeout=10)
    assert not giver.is_alive()
    go_on.release(3)
    closing.join(timeout=10)
    assert not closing.is_alive()
