"""A thread that works on one thing after the other, and lets go what it had no time for."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Job = TypeVar("Job")


class NewestWorker(Generic[Job]):
    """One job may wait. Whoever brings another either takes its place (`submit`) or waits (`hand_over`)."""

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
        """Give a job at once; returns the one that it takes the place of, if one was waiting."""
        with self._changed:
            replaced, self._waiting = self._waiting, job
            self._changed.notify_all()
        return replaced

    def hand_over(self, job: Job) -> None:
        """Give a job as soon as none is waiting."""
        with self._changed:
            self._changed.wait_for(lambda: self._closed or self._waiting is None)
            self._waiting = job
            self._changed.notify_all()

    def close(self) -> None:
        """Finish the job at hand and end the thread; what waits is let go."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._waiting is not None)
                if self._closed:
                    return
                job, self._waiting = self._waiting, None
                self._changed.notify_all()
            assert job is not None
            self._work(job)
