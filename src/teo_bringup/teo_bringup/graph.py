# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The project's nodes as processes of their own: start them, notice when one dies, stop them."""

from __future__ import annotations

import signal
import subprocess
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import IO

from ament_index_python.packages import PackageNotFoundError, get_package_prefix

# What signs: package and executable of each node.
NODES = {
    "translator": ("teo_sign_translator", "translator_node"),
    "executor": ("teo_lut_executor", "executor_node"),
    "driver": ("teo_sim_driver", "driver_node"),
}
# The page that shows it, where it is asked for.
CONSOLE = {"console": ("teo_console", "console_node")}

# A node that has not ended so long after the signal [s] is killed: a clean end takes a fraction of a second.
_STOP_TIMEOUT = 5.0
# How often `wait` looks at the processes [s].
_LOOK_PERIOD = 0.1


class GraphError(Exception):
    """A process cannot start or ended by itself; the message carries the end of what it said."""


def executable_of(package: str, executable: str) -> Path:
    """Where an installed package keeps an executable, as `ros2 run` finds it.

    Raises:
        GraphError: No such package is on the path, or it has no such executable.
    """
    try:
        path = Path(get_package_prefix(package)) / "lib" / package / executable
    except PackageNotFoundError as error:
        raise GraphError(
            f"expected the package {package} on AMENT_PREFIX_PATH; source env.sh first"
        ) from error
    if not path.is_file():
        raise GraphError(f"expected the executable {executable} of {package} at {path}; build the workspace")
    return path


class Graph:
    """Processes that are all stopped, by SIGINT as Ctrl-C does, when the `with` block ends."""

    def __init__(self, *, log_folder: Path | None = None) -> None:
        """Prepare to start processes.

        Args:
            log_folder: Where each process's output goes, as NAME.log. None: it is printed, each line with
                the name of its process before it.
        """
        self._log_folder = log_folder
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._logs: dict[str, IO[bytes]] = {}
        self._printers: dict[str, threading.Thread] = {}
        self._told: set[str] = set()  # who got the signal to end: a second one would interrupt a clean end
        if log_folder is not None:
            log_folder.mkdir(parents=True, exist_ok=True)

    def __enter__(self) -> Graph:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.tell_to_end()
        for name in list(self._processes):
            self.stop(name)

    def start_nodes(self, arguments: Sequence[str] = (), *, view: bool = False) -> None:
        """Start every node that takes part in signing, each with these arguments.

        Args:
            arguments: Of every node.
            view: Whether to start the console as well.

        Raises:
            GraphError: A node is not installed.
        """
        for name, (package, executable) in (NODES | (CONSOLE if view else {})).items():
            self.start(name, str(executable_of(package, executable)), *arguments)

    def start(self, name: str, *command: str) -> None:
        """Start a command under a name of its own."""
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE if self._log_folder is None else self._open_log(name),
            stderr=subprocess.STDOUT,
            process_group=0,  # Ctrl-C in a terminal reaches us alone, and each process once, through us
        )
        self._processes[name] = process
        if process.stdout is not None:
            self._printers[name] = threading.Thread(
                target=_print_lines, args=(name, process.stdout), daemon=True
            )
            self._printers[name].start()

    def _open_log(self, name: str) -> IO[bytes]:
        self._logs[name] = self._path_of(name).open("wb")
        return self._logs[name]

    def _path_of(self, name: str) -> Path:
        if self._log_folder is None:
            raise GraphError("expected a log folder; what the processes said was printed")
        return self._log_folder / f"{name}.log"

    def tell_to_end(self, number: int = signal.SIGINT) -> None:
        """Send every process the signal to end, unless it got one before."""
        for name in self._processes:
            self._tell(name, number)

    def _tell(self, name: str, number: int) -> None:
        if name not in self._told and self._processes[name].poll() is None:
            self._processes[name].send_signal(number)
        self._told.add(name)

    def stop(self, name: str) -> int:
        """Stop one process and give its exit status."""
        self._tell(name, signal.SIGINT)
        self._told.discard(name)
        process = self._processes.pop(name)
        try:
            status = process.wait(_STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        if name in self._logs:
            self._logs.pop(name).close()
        if name in self._printers:
            self._printers.pop(name).join(_STOP_TIMEOUT)  # a grandchild may hold the pipe open
        return status

    def wait(self) -> tuple[str, int]:
        """Wait until one of the processes ends by itself; give its name and exit status."""
        while True:
            for name, process in self._processes.items():
                if process.poll() is not None:
                    return name, process.returncode
            time.sleep(_LOOK_PERIOD)

    def process_id(self, name: str) -> int:
        """Number by which the system knows a process that was started."""
        return self._processes[name].pid

    def check(self) -> None:
        """Raise `GraphError` if a process has ended by itself."""
        for name, process in self._processes.items():
            if process.poll() is not None:
                status, said = process.returncode, self.tail(name)
                raise GraphError(f"expected {name} to keep running, it ended with status {status}:\n{said}")

    def tail(self, name: str, lines: int = 15) -> str:
        """Give the last lines that a process wrote to its log."""
        text = self._path_of(name).read_text(encoding="utf-8", errors="replace")
        return "\n".join(text.splitlines()[-lines:])


def _print_lines(name: str, output: IO[bytes]) -> None:
    with output:
        for line in output:
            # One write for each line, so that those of several processes do not mix.
            print(f"[{name}] {line.decode(errors='replace').rstrip()}\n", end="", flush=True)
