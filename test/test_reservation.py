# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Two runs on one machine do not meet: each has a domain and a folder of its own while it lives."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

SCRIPTS = Path(__file__).parents[1] / "scripts"
PROGRAM = """
import pathlib, sys, reservation
try:
    with reservation.folder(pathlib.Path(sys.argv[1])), reservation.domain() as domain:
        print(domain, flush=True)
        sys.stdin.read()
except reservation.OccupiedError as error:
    print(error, flush=True)
"""


@contextmanager
def running(out: Path, **environment: str) -> Iterator[str]:
    """Another run, while the block runs; yields what it says first."""
    inherited = {name: value for name, value in os.environ.items() if name != "ROS_DOMAIN_ID"}
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(out)],
        env={**inherited, "PYTHONPATH": str(SCRIPTS), **environment},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        yield process.stdout.readline().strip()
        process.stdin.close()


def test_each_run_has_its_domain_and_gives_it_back(tmp_path: Path) -> None:
    with running(tmp_path / "a") as first, running(tmp_path / "b") as second:
        assert len({first, second, "0"}) == 3
    with running(tmp_path / "a") as again:
        assert again == first


def test_a_domain_that_was_asked_for_is_taken(tmp_path: Path) -> None:
    with running(tmp_path / "a", ROS_DOMAIN_ID="7") as domain:
        assert domain == "7"


def test_two_runs_do_not_write_into_one_folder(tmp_path: Path) -> None:
    with running(tmp_path / "a") as first, running(tmp_path / "a") as second:
        assert first.isdigit()
        assert "another one is writing there" in second
