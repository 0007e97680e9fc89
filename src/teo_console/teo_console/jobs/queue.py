# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Jobs in their order, one at a time: a camera's film of one page must not slow down the film of another."""

from __future__ import annotations

import asyncio
import shutil
import tempfile
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from typing import Any

from teo_console.errors import ConsoleError
from teo_console.jobs.commands import Command
from teo_console.jobs.process import Job, run

# Jobs that wait, over all pages: a class of thirty, each with one.
MOST_WAITING = 32
# Jobs whose end is remembered, for pages that ask late.
_REMEMBERED = 200


class JobQueue:
    """Runs commands one after the other. All methods belong to one event loop."""

    def __init__(self) -> None:
        """Begin with nothing to do."""
        self._jobs: OrderedDict[str, Job] = OrderedDict()
        self._waiting: asyncio.Queue[Job] = asyncio.Queue()
        self._worker: asyncio.Task[None] | None = None
        self._running: asyncio.Task[None] | None = None
        self._current: Job | None = None
        self._count = 0

    def submit(self, command: Command, then: Callable[[], None] = lambda: None) -> Job:
        """Put a command at the end of the queue.

        Args:
            command: What to run.
            then: Called when it has run, however it ended.

        Raises:
            ConsoleError: "busy": too many wait already.
        """
        if self._waiting.qsize() >= MOST_WAITING:
            raise ConsoleError(
                "busy", f"expected at most {MOST_WAITING} jobs that wait: try again when some are done"
            )
        self._count += 1
        job = Job(command, self._count, then)
        self._jobs[job.id] = job
        self._forget_old()
        self._waiting.put_nowait(job)
        if self._worker is None:
            self._worker = asyncio.create_task(self._work())
        return job

    async def run(self, command: Command) -> Job:
        """Run a command in its turn and return its job when it has ended.

        Raises:
            ConsoleError: "busy", or the reason for which it failed or was cancelled.
        """
        job = self.submit(command)
        try:
            await job.ended.wait()
        except asyncio.CancelledError:
            self.cancel(job.id)
            raise
        if job.state != "done":
            raise ConsoleError(job.code or "cancelled", job.message or f"{command.name} was cancelled")
        return job

    def get(self, identifier: str) -> Job:
        """The job of that name.

        Raises:
            ConsoleError: "unknown_job".
        """
        job = self._jobs.get(identifier)
        if job is None:
            raise ConsoleError(
                "unknown_job", "expected a job that this console remembers, it knows none of that name"
            )
        return job

    def told(self, job: Job) -> dict[str, Any]:
        """What a page is told of a job: itself, and how many come before it."""
        return job.told(sum(each.number < job.number and not each.is_over for each in self._jobs.values()))

    def cancel(self, identifier: str) -> None:
        """End a job at once if it has not ended; what it has written goes away.

        Raises:
            ConsoleError: "unknown_job".
        """
        job = self.get(identifier)
        if job.is_over:
            return
        if job is self._current and self._running is not None:
            self._running.cancel()
        else:
            _cancelled(job)

    async def close(self) -> None:
        """End whatever runs, and run nothing more."""
        for job in self._jobs.values():
            if not job.is_over and job is not self._current:
                _cancelled(job)
        if self._worker is not None:
            self._worker.cancel()
            await asyncio.gather(self._worker, return_exceptions=True)

    async def _work(self) -> None:
        while True:
            job = await self._waiting.get()
            if job.is_over:
                continue
            self._current = job
            self._running = asyncio.create_task(_run_in_a_folder(job))
            try:
                await asyncio.wait([self._running])
            finally:
                if not self._running.done():  # the queue is closed
                    self._running.cancel()
                    await asyncio.gather(self._running, return_exceptions=True)
                if not job.is_over:
                    _cancelled(job)
                self._current = self._running = None

    def _forget_old(self) -> None:
        for identifier in [name for name, job in self._jobs.items() if job.is_over][:-_REMEMBERED]:
            del self._jobs[identifier]


async def _run_in_a_folder(job: Job) -> None:
    folder = Path(tempfile.mkdtemp(prefix="teo-job-"))
    try:
        await run(job, folder)
    except OSError as error:
        job.fail("not_started", f"{job.command.name}: {error}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        job.then()
        if job.is_over:
            job.ended.set()


def _cancelled(job: Job) -> None:
    job.state, job.code, job.message = "cancelled", "cancelled", f"{job.command.name} was cancelled"
    job.ended.set()
