# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A pipeline of two stages in threads, which works on the latest image and drops those it replaces."""

from __future__ import annotations

import gc
import sys
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from typing import Generic, TypeVar

# [s] after which a thread that runs lets another one in. MediaPipe's threads call Python eleven times for an
# image; at Python's own 5 ms each of these calls may stop a network for as long as another image's second
# half or a message takes.
_SWITCH_INTERVAL = 0.0005


def tune_interpreter() -> None:
    """Shorten the wait of native threads for Python, and exempt loaded modules from garbage collection.

    For the process of a node, once all is loaded: a full collection stops all threads for 30 ms, nearly all
    of it for modules and classes that never go.
    """
    sys.setswitchinterval(_SWITCH_INTERVAL)
    gc.collect()
    gc.freeze()


_Job = TypeVar("_Job")
_StageResult = TypeVar("_StageResult")


class LatestFramePipeline(Generic[_Job, _StageResult]):
    """Works on jobs in two stages, so that the second of one runs beside the first of the next.

    Whoever submits never waits. One job may wait to be begun; a newer one takes its place. The second stage
    sees jobs one by one, in the order in which they were begun, however many first stages run at once. No
    more are begun than the second stage keeps up with.
    """

    def __init__(
        self,
        first: Callable[[_Job], _StageResult | None],
        second: Callable[[_StageResult], object],
        *,
        at_once: int = 1,
    ) -> None:
        """Start the threads.

        Args:
            first: Stage, whose result goes to the second unless it is None; must not raise.
            second: Stage; must not raise.
            at_once: How many first stages may run at the same time.
        """
        self._first = first
        self._second = second
        self._at_once = at_once
        self._waiting: _Job | None = None
        self._begun: deque[Future[_StageResult | None]] = deque()
        self._closed = False
        self._changed = threading.Condition()
        self._threads = [threading.Thread(target=self._run_first, daemon=True) for _ in range(at_once)]
        self._threads.append(threading.Thread(target=self._run_second, daemon=True))
        for thread in self._threads:
            thread.start()

    def submit(self, job: _Job) -> _Job | None:
        """Give a job; returns the one that it takes the place of, if one was waiting."""
        with self._changed:
            replaced, self._waiting = self._waiting, job
            self._changed.notify_all()
        return replaced

    def close(self) -> None:
        """Finish the stages at hand and end the threads; what waits is let go."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        for thread in self._threads:
            thread.join()

    def _run_first(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._may_begin())
                if self._closed:
                    return
                job, self._waiting = self._waiting, None
                begun: Future[_StageResult | None] = Future()
                self._begun.append(begun)
            assert job is not None
            begun.set_result(self._first(job))
            with self._changed:
                self._changed.notify_all()

    def _may_begin(self) -> bool:
        return self._waiting is not None and len(self._begun) < self._at_once

    def _run_second(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or (self._begun and self._begun[0].done()))
                if self._closed:
                    return
                result = self._begun.popleft().result()
                self._changed.notify_all()
            if result is not None:
                self._second(result)
