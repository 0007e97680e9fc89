# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Has the planning process plan, and hears its answers in a thread."""

from __future__ import annotations

import contextlib
import signal
import socket
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable
from multiprocessing.connection import Connection

from teo_lut_executor.execution.interface import PlanWanted, ReturnWanted
from teo_lut_executor.planning_worker import Answer, NotPlanned, Opened, PlannerSettings, Ready

# Time after which a plan that is not there is not coming [s], and so much more for each token: the process is
# killed then. On two cores the slowest of random sentences took 171 s for 40 tokens with a load of seven, and
# two letters 40 s with one of eighteen.
_PLANNING_DEADLINE = 60.0
_PLANNING_DEADLINE_OF_TOKEN = 6.0

# The same for a process that loads [s]: that takes 7 s of a core, and minutes where others go first.
_LOADING_DEADLINE = 600.0

# How long the process may take to end once its socket is closed [s]; it is killed then.
_END_TIMEOUT = 1.0

# Not with `-m`: the answers' classes would be those of a module `__main__`, which nobody else knows.
_COMMAND = "from teo_lut_executor.planning_worker import main; main()"


class PlanningProcess:
    """A planner in another process; one that dies, or does not answer in time, is started again.

    What it was planning is tried once more.
    """

    def __init__(self, settings: PlannerSettings, wake: Callable[[], object]) -> None:
        """Start the process.

        Args:
            settings: What its planner is made of.
            wake: Called in another thread when `answers` has something to give.
        """
        self._settings = settings
        self._wake = wake
        self._lock = threading.Lock()
        self._answers: deque[Answer] = deque()
        self._open: dict[int, PlanWanted | ReturnWanted] = {}  # not answered yet, by number, in order
        self._lost_with = 0  # number of the request that the process before this one died with
        self._deadline = threading.Timer(0.0, int)
        self._closed = False
        self.ready = False
        self.restarts = 0
        self._start()

    def ask(self, wanted: PlanWanted | ReturnWanted) -> None:
        """Have something planned."""
        with self._lock:
            self._open[wanted.number] = wanted
            if len(self._open) == 1:
                self._set_deadline()
            self._send(wanted)

    def configure(self, settings: PlannerSettings) -> None:
        """Plan with other settings from the next request on."""
        with self._lock:
            self._settings = settings
            self._send(settings)

    def answers(self) -> list[Answer]:
        """What was answered since this was called last, in order."""
        taken = []
        while self._answers:
            taken.append(self._answers.popleft())
        return taken

    def close(self) -> None:
        """End the process."""
        with self._lock:
            self._closed = True
            self._deadline.cancel()
            self._send(None)  # it ends, and with it the thread that hears it
        self._end()
        self._thread.join(_END_TIMEOUT)

    @property
    def pid(self) -> int:
        """Of the process."""
        return self._process.pid

    def _start(self) -> None:
        ours, its = socket.socketpair()
        command = [sys.executable, "-c", _COMMAND, str(its.fileno())]
        # In a group of its own: Ctrl-C goes to the whole group of a terminal's processes, and this one ends
        # with the one that asks.
        self._process = subprocess.Popen(
            command, pass_fds=[its.fileno()], stdin=subprocess.DEVNULL, process_group=0
        )
        its.close()
        self._connection = Connection(ours.detach())
        self._send(self._settings)
        self._thread = threading.Thread(target=self._hear, args=(self._connection,), daemon=True)
        self._thread.start()
        self._set_deadline()

    def _set_deadline(self) -> None:
        """Kill the process if the answer that is next does not come in time: its end is noticed then."""
        self._deadline.cancel()
        if self.ready and not self._open:
            return
        seconds = _LOADING_DEADLINE
        if self.ready:
            wanted = next(iter(self._open.values()))
            tokens = wanted.sentence.tokens if isinstance(wanted, PlanWanted) else ()
            seconds = _PLANNING_DEADLINE + _PLANNING_DEADLINE_OF_TOKEN * len(tokens)
        # A thread of its own: the others may wait for the process, whose socket is full or half read.
        self._deadline = threading.Timer(seconds, self._process.kill)
        self._deadline.daemon = True
        self._deadline.start()

    def _send(self, request: object) -> None:
        # Where it has died, the thread that hears it notices, and names what it was asked.
        with contextlib.suppress(OSError):
            self._connection.send(request)

    def _end(self) -> None:
        try:
            self._process.wait(_END_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _hear(self, connection: Connection) -> None:
        while True:
            try:
                answer = connection.recv()
            except (EOFError, OSError):
                break
            with self._lock:
                if isinstance(answer, Ready):
                    self.ready = True
                elif not isinstance(answer, Opened):
                    del self._open[answer.number]
                self._set_deadline()
                self._answers.append(answer)
            self._wake()
        with self._lock:
            if not self._closed:
                self._begin_again()
        self._wake()

    def _begin_again(self) -> None:
        """The process died: start another, which tries what this one was planning, once more only."""
        self._end()
        self.ready = False
        self.restarts += 1
        number = next(iter(self._open), 0)
        if number and number == self._lost_with:
            del self._open[number]
            status = self._process.returncode
            message = (
                f"the planner's process ended twice while it planned this, now with status {status}"
                f"{' (killed, perhaps as no plan came in time)' if status == -signal.SIGKILL else ''}"
            )
            self._answers.append(NotPlanned(number=number, code="planner_lost", message=message))
        self._lost_with = number
        self._start()
        for wanted in self._open.values():
            self._send(wanted)
