# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Folders of recordings: which signs they hold, and capturing them all, here or on a cluster.

The work goes to a `concurrent.futures.Executor`: this machine's processes, or those of a Dask cluster, whose
workers see the same files under the same names. What was captured before is left as it is, so that a run that
was stopped goes on where it was.
"""

from __future__ import annotations

import csv
import functools
import multiprocessing
import re
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

from teo_description.robot import Robot
from teo_sign_capture.entries.bag_capture import (
    CRASHED,
    UNCHANGED,
    CaptureJob,
    Outcome,
    Settings,
    capture_bags,
    captured_outcome,
    failed_outcome,
    is_captured,
)
from teo_sign_capture.entries.take import Cut
from teo_sign_capture.recordings.recording import is_recording
from teo_signs.errors import LutError
from teo_signs.sign import gloss_key
from teo_signs.sign_schema import Handedness

# Ends the names of several takes of one sign: HOLA_1, HOLA_2.
_TAKE = re.compile(r"_\d+$")
_COLUMNS = ("bag", "gloss", "start", "end", "hands", "person")
_CONNECT_TIMEOUT = 10.0  # [s] a scheduler that does not answer, or has no worker, by then will not


def find_jobs(folder: Path) -> list[CaptureJob]:
    """The signs of a folder: each recording, or sub-folder of recordings, is named after its gloss, by gloss.

    Names may be in lower case, as telephones and file systems like them.

    Raises:
        LutError: "no_bag" if there are none.
    """
    takes: dict[str, list[Path]] = {}
    for path in sorted(folder.iterdir() if folder.is_dir() else ()):
        if path.name.startswith("."):
            continue
        if is_recording(path):
            takes.setdefault(_gloss_of(path), []).append(path)
        elif path.is_dir():
            bags = [inside for inside in sorted(path.iterdir()) if is_recording(inside)]
            if bags:
                takes.setdefault(_gloss(path.name), []).extend(bags)
    if not takes:
        raise LutError(
            "no_bag",
            "expected a folder of bags, videos or .pose files that are named after their glosses, got none "
            f"in {folder}",
        )
    return [CaptureJob(gloss=gloss, bags=tuple(bags)) for gloss, bags in sorted(takes.items())]


def read_manifest(path: Path) -> list[CaptureJob]:
    """The signs of a CSV file with a row for each take: bag and gloss; start, end, hands, person if needed.

    Bags are named relative to the file. Rows of one gloss are takes of one sign, and agree in the rest.

    Raises:
        LutError: "bad_manifest", naming the line.
    """
    jobs: dict[str, CaptureJob] = {}
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = csv.DictReader(file)
            unknown = sorted(set(rows.fieldnames or ()) - set(_COLUMNS))
            if unknown or not {"bag", "gloss"} <= set(rows.fieldnames or ()):
                raise _bad_manifest(path, 1, f"the columns {', '.join(_COLUMNS)}", f"{rows.fieldnames}")
            for row in rows:
                job = _job(path, rows.line_num, row)
                known = jobs.setdefault(job.gloss, job)
                if known is job:
                    continue
                if (known.cut, known.handedness, known.person) != (job.cut, job.handedness, job.person):
                    expected = f"the same start, end, hands and person in every take of {job.gloss}"
                    raise _bad_manifest(path, rows.line_num, expected, "others")
                jobs[job.gloss] = replace(job, bags=known.bags + job.bags)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise LutError("bad_manifest", f"{path}: expected a CSV file, got: {error}") from error
    if not jobs:
        raise LutError("bad_manifest", f"{path}: expected a row for each take, got none")
    return sorted(jobs.values(), key=lambda job: job.gloss)


def run_jobs(
    executor: Executor, jobs: Sequence[CaptureJob], settings: Settings, on_done: Callable[[Outcome], None]
) -> list[Outcome]:
    """Capture signs where an executor has them done, and return the outcomes by gloss.

    One that fails stops no other. `on_done` is told of each as it ends.
    """
    # A worker may have been started elsewhere: names must not depend on where this is.
    here = replace(
        settings,
        table=settings.table.absolute(),
        cache=settings.cache.absolute(),
        pictures=settings.pictures and settings.pictures.absolute(),
    )
    futures = {}
    for job in jobs:
        located = replace(job, bags=tuple(bag.absolute() for bag in job.bags))
        futures[executor.submit(_capture_job, located, here)] = job
    outcomes = []
    try:
        for future in as_completed(futures):
            try:
                outcome = future.result()
            except Exception as error:  # the process died: out of memory, or killed
                message = f"expected a process that ends well, got {type(error).__name__} {error}"
                outcome = Outcome(gloss=futures[future].gloss, code=CRASHED, message=message)
            outcomes.append(outcome)
            on_done(outcome)
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    return sorted(outcomes, key=lambda outcome: outcome.gloss)


def _capture_job(job: CaptureJob, settings: Settings) -> Outcome:
    """Capture one sign, in whatever process this is."""
    try:
        if not settings.replace and is_captured(job, settings.table):
            return Outcome(gloss=job.gloss, code=UNCHANGED, message="made from these recordings before")
        return captured_outcome(capture_bags(_robot(settings.robot), job, settings))
    except LutError as error:
        return failed_outcome(job.gloss, error)
    except Exception as error:  # a mistake of ours in one of hundreds is no reason to lose the others
        return Outcome(gloss=job.gloss, code=CRASHED, message=f"{type(error).__name__}: {error}")


@contextmanager
def workers(count: int, dask: str | None) -> Iterator[Executor]:
    """Processes of this machine, or of the Dask cluster at an address such as "tcp://host:8786".

    Raises:
        LutError: "no_cluster" if no scheduler answers there.
    """
    if dask is None:
        # Fresh processes: a fork would take over locks and threads of whatever runs here.
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(count, mp_context=context) as pool:
            yield pool
        return
    from distributed import Client

    try:
        client: Any = Client(dask, timeout=_CONNECT_TIMEOUT)  # type: ignore[no-untyped-call]  # typed in part
    except (OSError, ValueError) as error:
        raise LutError(
            "no_cluster", f"expected the scheduler of a Dask cluster at {dask}, got: {error}"
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=_CONNECT_TIMEOUT)
        except TimeoutError as error:
            raise LutError(
                "no_cluster", f"expected a Dask cluster at {dask} that has workers, got: {error}"
            ) from error
        with client.get_executor(pure=False, retries=0) as pool:
            yield pool


def _gloss_of(path: Path) -> str:
    name = path.stem if path.is_file() else path.name
    return _gloss(_TAKE.sub("", name) or name)


def _gloss(name: str) -> str:
    return gloss_key(name).upper()


def _job(path: Path, line: int, row: dict[str, str | None]) -> CaptureJob:
    cells = {name: (row.get(name) or "").strip() for name in _COLUMNS}
    if not cells["bag"] or not cells["gloss"] or None in row:
        raise _bad_manifest(path, line, "a bag and a gloss", str(list(row.values())))
    try:
        cut = Cut(
            start=float(cells["start"]) if cells["start"] else None,
            end=float(cells["end"]) if cells["end"] else None,
        )
        person = int(cells["person"]) if cells["person"] else None
    except ValueError as error:
        raise _bad_manifest(path, line, "start and end in seconds, person a number", str(error)) from error
    if cells["hands"] and cells["hands"] not in get_args(Handedness):
        raise _bad_manifest(path, line, f"hands of {', '.join(get_args(Handedness))}", cells["hands"])
    return CaptureJob(
        gloss=_gloss(cells["gloss"]),
        bags=(path.parent / cells["bag"],),
        cut=cut,
        handedness=cells["hands"] or None,  # type: ignore[arg-type]  # checked above
        person=person,
    )


def _bad_manifest(path: Path, line: int, expected: str, got: str) -> LutError:
    return LutError("bad_manifest", f"{path.name}: line {line}: expected {expected}, got {got}")


@functools.cache
def _robot(name: str) -> Robot:
    """One for each process: loading it takes longer than a frame."""
    return Robot.load(name)
