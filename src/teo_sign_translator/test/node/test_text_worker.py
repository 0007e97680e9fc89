# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A bounded queue and its worker."""

from __future__ import annotations

import threading

from teo_sign_translator.node.text_worker import TextWorker

PATIENCE = 20.0  # [s] that anything may take on a busy machine


def test_items_are_worked_on_in_order_and_those_too_many_are_refused() -> None:
    release, entered, finished = threading.Event(), threading.Event(), threading.Event()
    done: list[int] = []

    def work(item: int) -> None:
        entered.set()
        assert release.wait(PATIENCE)
        done.append(item)
        if item == 2:
            finished.set()

    worker = TextWorker(work, size=2)
    assert worker.offer(0)
    assert entered.wait(PATIENCE)
    assert [worker.offer(item) for item in (1, 2, 3)] == [True, True, False]
    assert worker.waiting == 2
    release.set()
    assert finished.wait(PATIENCE)
    assert done == [0, 1, 2]
    worker.stop(PATIENCE)


def test_stopping_gives_back_what_waits_and_takes_nothing_more() -> None:
    release, entered = threading.Event(), threading.Event()
    done: list[str] = []

    def work(item: str) -> None:
        entered.set()
        assert release.wait(PATIENCE)
        done.append(item)

    worker = TextWorker(work, size=5)
    worker.offer("a")
    assert entered.wait(PATIENCE)
    worker.offer("b")
    threading.Timer(0.05, release.set).start()
    assert worker.stop(PATIENCE) == ["b"]
    assert done == ["a"]
    assert not worker.offer("c")
