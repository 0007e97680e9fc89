# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One run of a command: a process within limits, listened to, and ended with all that it started."""

from __future__ import annotations

import asyncio
import json
import math
import os
import secrets
import signal
import sys
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from teo_console.jobs import limited
from teo_console.jobs.commands import Command

# Bytes of standard output that are kept: a hundred times the longest answer of a command.
_OUTPUT_BYTES = 16 * 1024**2
# Lines of standard error that are kept to say why it failed.
_LAST_LINES = 20
# Bytes of a line of standard error; a longer one is cut.
_LINE_BYTES = 64 * 1024
# From the request to end to the end by force [s]: time to remove temporary files.
_GRACE = 3.0


_State = Literal["waiting", "running", "done", "failed", "cancelled"]


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a command says that it is.

    Attributes:
        what: What it does now; empty before it has said so.
        done: How much of it is done.
        total: Of how much; 0 where it does not know.
    """

    what: str = ""
    done: int = 0
    total: int = 0


class Job:
    """One run of a command. Fields change as it goes; `ended` is set when nothing will change any more."""

    def __init__(self, command: Command, then: Callable[[], None]) -> None:
        """A job that waits.

        Args:
            command: What to run.
            then: To be called when it has run.
        """
        self.id = secrets.token_urlsafe(12)  # who has it may look at it and cancel it
        self.command = command
        self.then = then
        self.state: _State = "waiting"
        self.progress = Progress()
        self.result: Any = None
        """The last line that the command printed, if that is JSON."""
        self.output = ""
        """All that it printed on standard output."""
        self.code = ""
        """Why it failed."""
        self.message = ""
        self.ended = asyncio.Event()

    @property
    def is_over(self) -> bool:
        """Whether it ended, in whatever way."""
        return self.state in ("done", "failed", "cancelled")

    def fail(self, code: str, message: str) -> None:
        """Enter why it failed."""
        self.state, self.code, self.message = "failed", code, message

    def told(self, ahead: int) -> dict[str, Any]:
        """What a page is told of it.

        Args:
            ahead: Jobs that come before it.
        """
        return {
            "id": self.id,
            "name": self.command.name,
            "state": self.state,
            "ahead": ahead,
            "progress": vars(self.progress),
            "result": self.result,
            "code": self.code,
            "message": self.message,
        }


async def run(job: Job, folder: Path) -> None:
    """Run a job's command to its end and enter how it ended.

    Args:
        job: What to run; gets state, progress, output, result and reason.
        folder: For its temporary files, and where it runs.

    Raises:
        OSError: It cannot be started.
        asyncio.CancelledError: The task was cancelled; the process and all that it started have ended.
    """
    command, limits = job.command, job.command.limits
    launcher = (sys.executable, "-I", limited.__file__)  # as a file: it needs nothing of this package
    numbers = (2 * math.ceil(limits.seconds), limits.memory, limits.file)
    process = await asyncio.create_subprocess_exec(
        *launcher,
        *map(str, numbers),
        *command.arguments,
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
        cwd=folder,
        env={**os.environ, "TMPDIR": str(folder)},
        start_new_session=True,  # a group of its own, which is ended as one
        limit=_LINE_BYTES,
    )
    assert process.stdout is not None and process.stderr is not None
    job.state = "running"
    said: deque[str] = deque(maxlen=_LAST_LINES)
    try:
        async with asyncio.timeout(limits.seconds):
            output, _ = await asyncio.gather(_read_output(process), _listen(process.stderr, job, said))
            status = await process.wait()
    except TimeoutError:
        job.fail("too_slow", f"expected {command.name} to end within {limits.seconds:g} s, it did not")
        return
    finally:
        await _end(process)
    if len(output) > _OUTPUT_BYTES:
        job.fail("too_much_output", f"expected at most {_OUTPUT_BYTES} bytes from {command.name}, got more")
        return
    job.output = output.decode("utf-8", errors="replace")
    job.result = _json(job.output.rstrip().rpartition("\n")[2])
    if status == 0 or isinstance(job.result, dict):
        job.state = "done"
    else:
        job.fail(*_reason(command.name, status, said))


async def _read_output(process: asyncio.subprocess.Process) -> bytes:
    """All that is printed; who prints more than is kept is killed."""
    assert process.stdout is not None
    output = bytearray()
    while piece := await process.stdout.read(_LINE_BYTES):
        if len(output) <= _OUTPUT_BYTES:
            output += piece
            if len(output) > _OUTPUT_BYTES:
                _signal(process, signal.SIGKILL)
    return bytes(output)


async def _listen(stream: asyncio.StreamReader, job: Job, said: deque[str]) -> None:
    """Enter what the command says of its progress, and keep its other words."""
    while True:
        try:
            line = await stream.readuntil()
        except asyncio.IncompleteReadError as error:
            line = error.partial
        except asyncio.LimitOverrunError as error:
            line = await stream.readexactly(error.consumed)
        if not line:
            return
        text = line.decode("utf-8", errors="replace").strip()
        event = _json(text)
        if isinstance(event, dict) and event.get("event") == "progress":
            job.progress = Progress(
                what=str(event.get("what", "")),
                done=int(event.get("done") or 0),
                total=int(event.get("total") or 0),
            )
        elif text:
            said.append(text)


async def _end(process: asyncio.subprocess.Process) -> None:
    """See to it that nothing is left of the process's group."""
    # Not `asyncio.timeout`: in a task that is being cancelled, that of Python 3.11.2 does not time out.
    ended = asyncio.ensure_future(_end_of(process))
    for number in (signal.SIGTERM, signal.SIGKILL):
        if not _signal(process, number):  # nobody is left
            break
        await asyncio.wait({ended}, timeout=_GRACE)
    # A process that left the group may hold the pipes for as long as it likes.
    await asyncio.wait({ended}, timeout=_GRACE)
    ended.cancel()


def _signal(process: asyncio.subprocess.Process, number: int) -> bool:
    """Send a signal to the process's group; whether anybody is left in it."""
    try:
        os.killpg(process.pid, number)
    except (ProcessLookupError, PermissionError):
        return False
    return True


async def _end_of(process: asyncio.subprocess.Process) -> None:
    """Wait until a process has ended, whatever it has printed: asyncio sees no end before that is read."""
    for stream in (process.stdout, process.stderr):
        assert stream is not None
        while await stream.read(_LINE_BYTES):
            pass
    await process.wait()


def _json(text: str) -> Any:
    """What a line holds; None if that is no JSON."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return None


def _reason(name: str, status: int, said: deque[str]) -> tuple[str, str]:
    """Code and sentence: as the project's commands print them, "code: sentence", or the last words."""
    if status < 0 or status == 128 + signal.SIGKILL:
        return "killed", f"{name} was ended by signal {abs(status)}, probably at a limit of time or memory"
    last = said[-1] if said else f"exit status {status}"
    for line in reversed(said):
        code, colon, sentence = line.partition(": ")
        if colon and code.isidentifier() and code.islower():
            return code, sentence
    return "failed", f"{name}: {last}"
