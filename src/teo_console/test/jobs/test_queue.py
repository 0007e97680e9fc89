# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands run one after the other within their limits, and nothing is left of them."""

from __future__ import annotations

import asyncio
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from teo_console.errors import ConsoleError
from teo_console.jobs.commands import Command, Limits
from teo_console.jobs.process import Job
from teo_console.jobs.queue import MOST_WAITING, JobQueue

MEGABYTE = 1024**2


def python(program: str, *arguments: str, **limits: float) -> Command:
    return Command(
        name="test",
        arguments=(sys.executable, "-c", program, *arguments),
        limits=Limits(**limits),  # type: ignore[arg-type]
    )


@pytest.fixture
def queue(runner: asyncio.Runner) -> Iterator[JobQueue]:
    opened = JobQueue()
    yield opened
    runner.run(opened.close())


async def ended(queue: JobQueue, command: Command) -> Job:
    job = queue.submit(command)
    await job.ended.wait()
    return job


async def until(holds: Callable[[], bool]) -> None:
    while not holds():
        await asyncio.sleep(0.01)


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return "Z" not in Path(f"/proc/{pid}/stat").read_text().split(")")[1].split()[0]


async def test_a_command_ends_with_what_it_printed_its_last_object_and_no_temporary_file(
    queue: JobQueue,
) -> None:
    program = "import tempfile; print('one'); print(f'[\"{tempfile.mkstemp()[1]}\"]')"

    job = await queue.run(python(program))
    assert job.state == "done"
    assert job.output.startswith("one\n")
    left = Path(*job.result)
    assert not left.exists()
    assert left.parents[1] == Path(tempfile.gettempdir())


async def test_commands_run_one_at_a_time_and_each_knows_how_many_come_before(
    queue: JobQueue, tmp_path: Path
) -> None:
    log = tmp_path / "log"
    program = (
        "import sys, time; f = open(sys.argv[1], 'a', buffering=1); "
        "f.write('b' + sys.argv[2]); time.sleep(0.1); f.write('e' + sys.argv[2])"
    )

    ended: list[int] = []
    jobs = [queue.submit(python(program, str(log), name), lambda: ended.append(1)) for name in "123"]
    assert [queue.told(job)["ahead"] for job in jobs] == [0, 1, 2]
    for number, job in enumerate(jobs, start=1):
        await job.ended.wait()
        assert len(ended) >= number
        assert all(later.state == "waiting" for later in jobs[number + 1 :])  # on a slow machine too
    assert [queue.told(job)["ahead"] for job in jobs] == [0, 0, 0]
    assert log.read_text() == "b1e1b2e2b3e3"


async def test_what_a_command_says_of_its_progress_is_known_while_it_runs(queue: JobQueue) -> None:
    program = (
        "import sys, time; "
        'print(\'{"event": "progress", "what": "looking", "done": 3, "total": 9}\', '
        "file=sys.stderr, flush=True); time.sleep(60)"
    )

    job = queue.submit(python(program))
    await until(lambda: job.progress.what == "looking")
    assert (job.state, job.progress.done, job.progress.total) == ("running", 3, 9)


async def test_the_reason_of_a_command_that_fails_is_its_own(queue: JobQueue) -> None:
    job = await ended(queue, python("import sys; sys.exit('no_motion: no hand leaves rest')"))
    assert (job.state, job.code, job.message) == ("failed", "no_motion", "no hand leaves rest")
    with pytest.raises(ConsoleError) as caught:
        await queue.run(python("raise SystemExit(3)"))
    assert caught.value.code == "failed"
    nowhere = await ended(queue, Command(name="test", arguments=("/no/such/program",)))
    assert nowhere.state == "failed"


@pytest.mark.parametrize(
    ("program", "limits", "reason"),
    [
        ("import time; time.sleep(60)", {"seconds": 0.5}, "too_slow"),
        ("while True: pass", {"seconds": 1.0}, "too_slow"),
        ("bytearray(600 * 2**20)", {"memory": 500 * MEGABYTE}, "failed: test: MemoryError"),
        ("open('big', 'wb').write(bytes(3 * 2**20))", {"file": MEGABYTE}, "failed: test: OSError"),
        ("print('x' * 20 * 2**20)", {}, "too_much_output"),
    ],
)
async def test_a_command_beyond_its_limits_is_ended(
    queue: JobQueue, program: str, limits: dict[str, float], reason: str
) -> None:
    job = await ended(queue, python(program, **limits))
    assert job.state == "failed"
    assert f"{job.code}: {job.message}".startswith(reason)


async def test_a_cancelled_command_ends_with_all_that_it_started(queue: JobQueue, tmp_path: Path) -> None:
    note = tmp_path / "pids"
    # It starts another process, and both are deaf to requests to end.
    program = (
        "import os, signal, subprocess, sys, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); "
        "child = subprocess.Popen([sys.executable, '-c', 'import signal, time; "
        "signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(60)']); "
        "open(sys.argv[1] + '~', 'w').write(f'{os.getpid()} {child.pid} {os.getcwd()}'); "
        "os.rename(sys.argv[1] + '~', sys.argv[1]); time.sleep(60)"
    )

    job = queue.submit(python(program, str(note)))
    await until(note.exists)
    own, child, folder = note.read_text().split()
    assert Path(folder).is_dir()
    queue.cancel(job.id)
    await job.ended.wait()
    assert job.state == "cancelled"
    await until(lambda: not alive(int(own)) and not alive(int(child)))
    assert not Path(folder).exists()


async def test_a_job_that_waits_is_cancelled_without_being_run(queue: JobQueue, tmp_path: Path) -> None:
    first = queue.submit(python("import time; time.sleep(60)"))
    second = queue.submit(python("import sys; open(sys.argv[1], 'w')", str(tmp_path / "ran")))
    queue.cancel(second.id)
    queue.cancel(first.id)
    await first.ended.wait()
    assert (await queue.run(python("print('{}')"))).state == "done"
    assert (first.state, second.state) == ("cancelled", "cancelled")
    assert not (tmp_path / "ran").exists()


async def test_a_closed_queue_leaves_nothing_running(queue: JobQueue, tmp_path: Path) -> None:
    note = tmp_path / "pid"
    program = "import os, sys, time; open(sys.argv[1], 'w').write(str(os.getpid())); time.sleep(60)"

    job = queue.submit(python(program, str(note)))
    await until(lambda: note.exists() and note.read_text() != "")
    await queue.close()
    assert job.state == "cancelled"
    assert not alive(int(note.read_text()))


async def test_too_many_jobs_are_refused_and_unknown_ones_named(queue: JobQueue) -> None:
    slow = python("import time; time.sleep(60)")
    with pytest.raises(ConsoleError) as caught:
        for _ in range(MOST_WAITING + 2):
            queue.submit(slow)
    assert caught.value.code == "busy"
    with pytest.raises(ConsoleError) as caught:
        queue.get("nobody")
    assert caught.value.code == "unknown_job"
