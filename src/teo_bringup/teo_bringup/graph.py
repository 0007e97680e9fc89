# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The project's nodes as processes of their own: start them, keep them up, stop them."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from types import TracebackType

from ament_index_python.packages import PackageNotFoundError, get_package_prefix

from teo_bringup.supervised_process import Event, Keeper, SupervisedProcess

# Package and executable of each node.
NODES = {
    "translator": ("teo_sign_translator", "translator_node"),
    "executor": ("teo_lut_executor", "executor_node"),
    "driver": ("teo_sim_driver", "driver_node"),
    "console": ("teo_console", "console_node"),
    "retriever": ("teo_skeleton_retriever", "retriever_node"),
    "capture": ("teo_sign_capture", "capture_node"),
}
# What signs.
SIGNING = ("translator", "executor", "driver")

# How often the processes are looked at [s].
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
    """Processes that are all stopped, by SIGINT as Ctrl-C does, when the `with` block ends.

    Start them from the main thread: they are told to end when the thread ends that started them.
    """

    def __init__(self, log_folder: Path, *, printed: bool = False) -> None:
        """Prepare to start processes.

        Args:
            log_folder: Where each process's output goes, as NAME.log.
            printed: Whether it is printed too, each line with the name of its process before it, and with it
                what becomes of the processes.
        """
        self._log_folder = log_folder
        self._printed = printed
        self._processes: dict[str, SupervisedProcess] = {}
        log_folder.mkdir(parents=True, exist_ok=True)

    def __enter__(self) -> Graph:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.tell_to_end()
        for name in list(self._processes):
            self.stop(name)

    def start_nodes(self, names: Iterable[str] = SIGNING, arguments: Sequence[str] = ()) -> None:
        """Start nodes, each with these arguments.

        Args:
            names: Of `NODES`.
            arguments: Of every node.

        Raises:
            GraphError: A node is not installed.
        """
        for name in names:
            self.start(name, str(executable_of(*NODES[name])), *arguments)

    def start(self, name: str, *command: str) -> None:
        """Start a command under a name of its own."""
        log = self._log_folder / f"{name}.log"
        process = SupervisedProcess(name, command, log=log, printed=self._printed)
        process.start()
        self._processes[name] = process

    def tell_to_end(self, number: int = signal.SIGINT) -> None:
        """Send every process the signal to end, unless it got one before."""
        for process in self._processes.values():
            process.tell_to_end(number)

    def stop(self, name: str) -> int:
        """Stop one process and give its exit status."""
        return self._processes.pop(name).stop()

    def is_ready(self, *names: str) -> bool:
        """Whether these nodes have said that they can serve, all that were started if none is named."""
        return all(self._processes[name].ready for name in names or self._processes)

    def wait(self) -> tuple[str, int]:
        """Wait until one of the processes ends by itself; give its name and exit status."""
        while True:
            for process in self._processes.values():
                if process.status is not None:
                    return self._ended(process)
            time.sleep(_LOOK_PERIOD)

    def keep_up(self, *, restarts: bool, when_ready: Callable[[], None]) -> tuple[str, int]:
        """Start what fails again, until a process ends for good; give its name and exit status.

        Args:
            restarts: Whether anything is started again.
            when_ready: Called when every process can serve, and again when that has come back.
        """
        keepers = [Keeper(process, restarts=restarts) for process in self._processes.values()]
        while True:
            for keeper in keepers:
                name = keeper.process.name
                match keeper.look(time.monotonic()):
                    case Event.READY:
                        self._say(f"{name} is ready")
                        if all(each.ready for each in keepers):
                            when_ready()
                    case Event.FAILED:
                        self._say(f"{name} ended with status {keeper.process.status}; it is started again")
                    case Event.ENDED:
                        return self._ended(keeper.process)
            time.sleep(_LOOK_PERIOD)

    def process_id(self, name: str) -> int:
        """Number by which the system knows a process that was started."""
        return self._processes[name].id

    def check(self) -> None:
        """Raise `GraphError` if a process has ended by itself."""
        for name, process in self._processes.items():
            if process.status is not None:
                _, status = self._ended(process)
                raise GraphError(
                    f"expected {name} to keep running, it ended with status {status}:\n{self.tail(name)}"
                )

    def tail(self, name: str, lines: int = 15) -> str:
        """Give the last lines that a process wrote to its log."""
        log = self._log_folder / f"{name}.log"
        text = log.read_text(encoding="utf-8", errors="replace") if log.is_file() else ""
        return "\n".join(text.splitlines()[-lines:])

    def _ended(self, process: SupervisedProcess) -> tuple[str, int]:
        """Give the name and status of a process that has ended, once all that it said is in its log."""
        assert process.status is not None
        process.hear_out()
        return process.name, process.status

    def _say(self, text: str) -> None:
        if self._printed:
            print(f"[up] {text}", file=sys.stderr, flush=True)
