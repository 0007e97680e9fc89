# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Jobs in their order, one at a time: a camera's film of one page must not slow down the film of another."""

from __future__ import annotations

import asyncio
import shutil
import tempfile
from collections.abc import Callable
from itertools import takewhile
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
        self._jobs: dict[str, Job] = {}
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._turn = asyncio.Lock()  # it is given in the order in which it was asked for

    def submit(self, command: Command, then: Callable[[], None] = lambda: None) -> Job:
        """Put a command at the end of the queue.

        Args:
            command: What to run.
            then: Called when it has run, however it ended.

        Raises:
            ConsoleError: "busy": too many wait already.
        """
        if sum(job.state == "waiting" for job in self._jobs.values()) >= MOST_WAITING:
            raise ConsoleError(
                "busy", f"expected at most {MOST_WAITING} jobs that wait: try again when some are done"
            )
        job = Job(command, then)
        self._jobs[job.id] = job
        self._forget_old()
        task = self._tasks[job.id] = asyncio.create_task(self._run_in_turn(job))
        task.add_done_callback(lambda _: self._end(job))
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
        before = takewhile(lambda each: each is not job, self._jobs.values())
        return job.told(sum(not each.is_over for each in before))

    def cancel(self, identifier: str) -> None:
        """End a job at once if it has not ended; what it has written goes away.

        Raises:
            ConsoleError: "unknown_job".
        """
        job = self.get(identifier)
        if not job.is_over:
            self._tasks[job.id].cancel()

    async def close(self) -> None:
        """End whatever runs, and run nothing more."""
        tasks = list(self._tasks.values())
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    async def _run_in_turn(self, job: Job) -> None:
        async with self._turn:
            await _run_in_a_folder(job)

    def _end(self, job: Job) -> None:
        del self._tasks[job.id]
        if not job.is_over:
            name = job.command.name
            job.state, job.code, job.message = "cancelled", "cancelled", f"{name} was cancelled"
        job.ended.set()

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
