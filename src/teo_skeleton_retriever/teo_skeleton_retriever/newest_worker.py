"""A thread that works on the newest of what comes, and lets go what it had no time for."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Job = TypeVar("Job")


class NewestWorker(Generic[Job]):
    """Whoever submits never waits; a job that is still waiting when the next one comes is never begun."""

    def __init__(self, work: Callable[[Job], None], name: str) -> None:
        """Start the thread.

        Args:
            work: called with one job at a time, in the thread; must not raise.
            name: of the thread.
        """
        self._work = work
        self._waiting: Job | None = None
        self._closed = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, job: Job) -> Job | None:
        """Give a job; returns the one that it takes the place of, if one was waiting."""
        with self._changed:
            replaced, self._waiting = self._waiting, job
            self._changed.notify()
        return replaced

    def close(self) -> None:
        """Finish the job at hand and end the thread; what waits is let go."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._waiting is not None)
                if self._closed:
                    return
                job, self._waiting = self._waiting, None
            assert job is not None
            self._work(job)
