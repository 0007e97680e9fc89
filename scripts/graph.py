"""The project's nodes as processes of their own: start them, notice when one dies, stop them."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import IO

# What signs: package and executable of each node.
NODES = {
    "translator": ("teo_sign_translator", "translator_node"),
    "executor": ("teo_lut_executor", "executor_node"),
    "driver": ("teo_sim_driver", "driver_node"),
}

# A node that has not ended this long after SIGINT [s] is killed: a clean end takes a fraction of a second.
_STOP_TIMEOUT = 5.0


class GraphError(Exception):
    """A process of the graph ended by itself; the message carries the end of what it said."""


class Graph:
    """Processes that are all stopped, by SIGINT as Ctrl-C does, when the `with` block ends."""

    def __init__(self, *, log_folder: Path, environment: Mapping[str, str] | None = None) -> None:
        """Keep what each process prints in `log_folder`/NAME.log; add `environment` to our own."""
        self._log_folder = log_folder
        self._environment = {**os.environ, **(environment or {})}
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._logs: dict[str, IO[bytes]] = {}
        log_folder.mkdir(parents=True, exist_ok=True)

    def __enter__(self) -> Graph:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for process in self._processes.values():
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        for name in list(self._processes):
            self.stop(name)

    def start_nodes(self) -> None:
        """Start every node that takes part in signing."""
        for name, (package, executable) in NODES.items():
            self.start(name, "ros2", "run", package, executable)

    def start(self, name: str, *command: str) -> None:
        """Start a command under a name of its own."""
        log = (self._log_folder / f"{name}.log").open("wb")
        self._logs[name] = log
        self._processes[name] = subprocess.Popen(
            command, env=self._environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT
        )

    def stop(self, name: str) -> int:
        """Stop one process and give its exit status."""
        process = self._processes.pop(name)
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        try:
            status = process.wait(_STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        self._logs.pop(name).close()
        return status

    def check(self) -> None:
        """Raise `GraphError` if a process has ended by itself."""
        for name, process in self._processes.items():
            if process.poll() is not None:
                status, said = process.returncode, self.tail(name)
                raise GraphError(f"expected {name} to keep running, it ended with status {status}:\n{said}")

    def tail(self, name: str, lines: int = 15) -> str:
        """Give the last lines that a process printed."""
        text = (self._log_folder / f"{name}.log").read_text(encoding="utf-8", errors="replace")
        return "\n".join(text.splitlines()[-lines:])
