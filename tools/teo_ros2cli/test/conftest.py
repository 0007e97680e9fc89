# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The command as a process, and nodes of the tests' own, in a DDS domain for each test."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from teo_ros2cli.packages import package_prefix

PATIENCE = 120.0
"""Longest time that anything may take [s]; a machine with ten things to do takes half a minute a command."""


def _command() -> Path:
    """Our own command, also where a genuine one is on the path."""
    return package_prefix("teo_ros2cli") / "lib" / "teo_ros2cli" / "ros2"


@pytest.fixture
def ros2_path() -> Path:
    """The command's file."""
    return _command()


@pytest.fixture
def ros2() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run the command to its end."""

    def run(*arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [_command(), *arguments], capture_output=True, text=True, timeout=PATIENCE, check=False, **options
        )

    return run


@pytest.fixture
def ros2_here(capfd: pytest.CaptureFixture[str]) -> Iterator[Callable[..., subprocess.CompletedProcess[str]]]:
    """Run the command in this process: what Python and rclpy take to start is saved at each call."""
    from teo_ros2cli.main import main

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        capfd.readouterr()
        try:
            status = main(arguments)
        except SystemExit as end:
            status = int(str(end.code))
        return subprocess.CompletedProcess(arguments, status, *capfd.readouterr())

    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield run
    for number, handler in handlers.items():
        signal.signal(number, handler)


class Running:
    """The command, or another program, in the background, with its output as it comes."""

    def __init__(self, *arguments: str, program: str | Path | None = None, **options: Any) -> None:
        options.setdefault("stdin", subprocess.DEVNULL)
        self.process = subprocess.Popen(
            [program or _command(), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
            **options,
        )
        self.lines: list[str] = []
        self._new: queue.Queue[str | None] = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._new.put(line.rstrip("\n"))
        self._new.put(None)

    def wait_for_line(self, part: str) -> str:
        """Wait until a line with this part has been printed, and return it."""
        for line in self.lines:
            if part in line:
                return line
        deadline = time.monotonic() + PATIENCE
        while True:
            try:
                line = self._new.get(timeout=max(deadline - time.monotonic(), 0))
            except queue.Empty:
                line = None
            if line is None:
                raise AssertionError(f"no line with {part!r} in {self.lines}")
            self.lines.append(line)
            if part in line:
                return line

    def stop(self, number: signal.Signals = signal.SIGINT) -> int:
        """Send a signal, wait for the end, and return the exit status."""
        self.process.send_signal(number)
        return self.finish()

    def finish(self) -> int:
        """Wait for the end, and return the exit status."""
        status = self.process.wait(PATIENCE)
        self._reader.join(PATIENCE)
        while (line := self._new.get()) is not None:
            self.lines.append(line)
        return status

    @property
    def text(self) -> str:
        return "\n".join(self.lines)


@pytest.fixture
def start() -> Iterator[Callable[..., Running]]:
    """Start commands in the background; what still runs at the end is killed."""
    started: list[Running] = []

    def run(*arguments: str, **options: Any) -> Running:
        started.append(Running(*arguments, **options))
        return started[-1]

    yield run
    for running in started:
        with suppress(ProcessLookupError):
            running.process.kill()
        running.process.wait(PATIENCE)


@pytest.fixture
def prompt_discovery(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let participants find each other at once, as the workspace's environment does."""
    profile = Path(__file__).parents[1] / "config" / "fastdds.xml"
    monkeypatch.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", str(profile))


class Graph:
    """A node of the test's own, with a thread that spins it."""

    def __init__(self, name: str) -> None:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor

        self.context = rclpy.Context()
        rclpy.init(args=[], context=self.context)
        self.node = rclpy.create_node(name, context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self._running = True
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def _spin(self) -> None:
        while self._running:
            self.executor.spin_once(timeout_sec=0.05)

    def wait_until(self, condition: Callable[[], Any], what: str) -> None:
        """Wait until a condition holds."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, f"waited in vain until {what}"
            time.sleep(0.01)

    def close(self) -> None:
        import rclpy

        self._running = False
        self._thread.join(PATIENCE)
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)


@pytest.fixture
def graph(domain_id: int, prompt_discovery: None) -> Iterator[Graph]:  # noqa: ARG001
    """A node `/tester` in the test's domain."""
    made = Graph("tester")
    yield made
    made.close()
