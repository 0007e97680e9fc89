# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Work with MediaPipe in a process of its own.

MediaPipe is native code: what it breaks, keeps in memory or says ends with that process, which can be stopped
at any moment. A pool of `concurrent.futures` cannot stop a task that runs.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable
from multiprocessing import current_process, get_context
from multiprocessing.connection import Connection
from pathlib import Path
from types import ModuleType

from teo_signs.errors import LutError

# Loaded by MediaPipe, in a second, to draw; nothing is drawn in the process.
_NOT_NEEDED = ("matplotlib", "matplotlib.pyplot")

# Told how much is done, of how much.
Progress = Callable[[int, int], None]
# Takes a recording and the file to write; returns what could not be used, a sentence each.
Work = Callable[[Path, Path, Progress | None], tuple[str, ...]]


def work_apart(
    work: Work, recording: Path, out: Path, on_progress: Progress | None = None
) -> tuple[str, ...]:
    """Do work on a recording in a process of its own.

    Args:
        work: A function of a module, which a new process can import.
        recording: What it reads.
        out: File that it writes; its folder exists.
        on_progress: Told of the progress.

    Raises:
        LutError: What the work raises; "not_retrieved" where the process died.
        OSError: `out` cannot be written.
    """
    if current_process().daemon:  # a worker of Dask: in a process of its own already, and may start none
        return work(recording, out, on_progress)
    context = get_context("spawn")  # a fork would take over locks and threads of whatever runs here
    receiver, sender = context.Pipe(duplex=False)
    with tempfile.NamedTemporaryFile(prefix="retrieve-", suffix=".txt") as said:
        process = context.Process(target=_serve, args=(work, recording, out, sender, said.name))
        process.start()
        sender.close()
        try:
            while True:
                result = receiver.recv()
                if isinstance(result, Exception):
                    raise result
                if isinstance(result, list):
                    return tuple(result)
                if on_progress is not None:
                    on_progress(*result)
        except EOFError:
            process.join()
            last = Path(said.name).read_text("utf-8", errors="replace").strip().splitlines()[-1:]
            raise not_retrieved(recording, last[0] if last else f"exit status {process.exitcode}") from None
        finally:
            process.kill()
            process.join()
            receiver.close()


def not_retrieved(recording: Path, reason: str) -> LutError:
    """The error of a recording in whose images nothing was found."""
    return LutError("not_retrieved", f"{recording.name}: expected skeletons of its images, got: {reason}")


def _serve(work: Work, recording: Path, out: Path, sender: Connection, said: str) -> None:
    """Body of the process: sends the progress, then a list of complaints or the error."""
    sys.modules.update({name: ModuleType(name) for name in _NOT_NEEDED})
    native = os.open(said, os.O_WRONLY | os.O_APPEND)
    os.dup2(native, 1)
    os.dup2(native, 2)  # what MediaPipe's libraries say is for nobody, unless they end the process
    try:
        sender.send(list(work(recording, out, lambda done, total: sender.send((done, total)))))
    except (LutError, OSError) as error:
        sender.send(error)
