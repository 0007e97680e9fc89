# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The retriever, run on a recording in a process of its own.

MediaPipe is native code: what it breaks, keeps in memory or says ends with that process, which can be stopped
at any moment. A pool of `concurrent.futures` cannot stop a task that runs.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from multiprocessing import current_process, get_context
from multiprocessing.connection import Connection
from pathlib import Path

from teo_signs.errors import LutError
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP

# Told the number of messages read and that of all.
Progress = Callable[[int, int], None]


def retrieve_apart(
    bag: Path, out: Path, on_progress: Progress | None = None, *, slop: float = DEFAULT_SLOP
) -> tuple[str, ...]:
    """Find people in the images of a bag and write their skeletons.

    Args:
        bag: The bag.
        out: MCAP file to write; its folder exists.
        on_progress: Told of the progress.
        slop: Greatest difference between the stamps of colour and depth [s].

    Returns:
        What could not be used of the images, a sentence each.

    Raises:
        LutError: The code of the retriever's error ("no_depth", "no_camera_info", ...) or of what was wrong
            with all images; "not_retrieved" where there is none, or the process died.
        OSError: `out` cannot be written.
    """
    if current_process().daemon:  # a worker of Dask: in a process of its own already, and may start none
        return _retrieve(bag, out, on_progress, slop)
    context = get_context("spawn")  # a fork would take over locks and threads of whatever runs here
    receiver, sender = context.Pipe(duplex=False)
    with tempfile.NamedTemporaryFile(prefix="retrieve-", suffix=".txt") as said:
        process = context.Process(target=_serve, args=(bag, out, slop, sender, said.name))
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
            raise _failure(bag, last[0] if last else f"exit status {process.exitcode}") from None
        finally:
            process.kill()
            process.join()
            receiver.close()


def _serve(bag: Path, out: Path, slop: float, sender: Connection, said: str) -> None:
    """Body of the process: sends the progress, then a list of complaints or the error."""
    native = os.open(said, os.O_WRONLY | os.O_APPEND)
    os.dup2(native, 1)
    os.dup2(native, 2)  # what MediaPipe's libraries say is for nobody, unless they end the process
    try:
        sender.send(list(_retrieve(bag, out, lambda done, total: sender.send((done, total)), slop)))
    except (LutError, OSError) as error:
        sender.send(error)


def _retrieve(bag: Path, out: Path, on_progress: Progress | None, slop: float) -> tuple[str, ...]:
    # Imported here: MediaPipe and what it needs are to be loaded by the process that runs it.
    from teo_skeleton_retriever.errors import RetrieverError, TopicError
    from teo_skeleton_retriever.recording import retrieve_recording

    try:
        report = retrieve_recording(bag, out=out, slop=slop, on_progress=on_progress)
    except TopicError as error:
        option = f"--{error.argument.replace('_', '-')}"
        hint = f"if it has another name, run `retrieve {option} NAME` first"
        raise LutError(error.code, f"{bag.name}: {error.sentence}: {hint}") from None
    except RetrieverError as error:
        raise LutError(error.code, f"{bag.name}: {error.sentence}") from None
    if not report.images:
        for code, sentence in report.reasons.items():
            raise LutError(code, f"{bag.name}: {sentence}")
        raise _failure(bag, report.complaints[0])
    if report.nobody:
        raise LutError("nobody_in_space", f"{bag.name}: {report.nobody}")
    return report.complaints


def _failure(bag: Path, reason: str) -> LutError:
    return LutError("not_retrieved", f"{bag.name}: expected skeletons of its images, got: {reason}")
