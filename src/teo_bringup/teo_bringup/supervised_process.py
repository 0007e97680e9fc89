# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One process under supervision: what it says, whether it can serve, how it ends, when it starts again."""

from __future__ import annotations

import logging
import os
import signal
import socket
import subprocess
import threading
from collections import deque
from enum import Enum, auto
from logging.handlers import RotatingFileHandler
from pathlib import Path
from typing import IO

# A node that has not ended so long after the signal [s] is killed: a clean end takes a fraction of a second.
_STOP_TIMEOUT = 5.0
# A month's lines of a robot, one a minute, are a tenth of it [bytes]; then one older file is kept beside it.
_LOG_SIZE = 10_000_000
# Of a datagram to a supervisor: some words [bytes].
_NOTE_SIZE = 4096


class SupervisedProcess:
    """A command that is started, listened to and stopped, and may be started again.

    It gets the signal to end if we die, whatever kills us: a node that outlives its supervisor would command
    the robot beside the one that the next supervisor starts. Start it from the main thread, whose end counts.
    """

    def __init__(self, name: str, command: tuple[str, ...], *, log: Path, printed: bool) -> None:
        """Prepare the process; `start` starts it.

        Args:
            name: What we call it.
            command: Program and arguments.
            log: File for what it says, begun anew here.
            printed: Whether what it says is printed, each line with its name before it.
        """
        self.name = name
        self._command = command
        self._printed = printed
        log.unlink(missing_ok=True)
        self._file = RotatingFileHandler(log, maxBytes=_LOG_SIZE, backupCount=1, encoding="utf-8")
        # systemd's protocol: whoever is started with NOTIFY_SOCKET sends READY=1 there (sd_notify(3)). For an
        # empty name the kernel finds one, without a file.
        self._notes = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._notes.bind("")
        self._is_ready = False

    def start(self) -> None:
        """Start it; again, if it has ended."""
        self._is_ready = False
        self._told = False  # whether it got the signal to end: a second one would interrupt a clean end
        address = self._notes.getsockname().decode()
        self._process = subprocess.Popen(
            ("setpriv", "--pdeathsig", "INT", "--", *self._command),
            env=os.environ | {"NOTIFY_SOCKET": address.replace("\0", "@", 1)},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            process_group=0,  # Ctrl-C in a terminal reaches us alone, and each process once, through us
        )
        assert self._process.stdout is not None
        self._listener = threading.Thread(target=self._listen, args=(self._process.stdout,), daemon=True)
        self._listener.start()

    def _listen(self, output: IO[bytes]) -> None:
        with output:
            for line in output:
                text = line.decode(errors="replace").rstrip("\n")
                self._file.emit(logging.makeLogRecord({"msg": text}))
                if self._printed:
                    # One write for each line, so that those of several processes do not mix.
                    print(f"[{self.name}] {text}\n", end="", flush=True)

    @property
    def id(self) -> int:
        """Number by which the system knows it."""
        return self._process.pid

    @property
    def status(self) -> int | None:
        """Its exit status, negative for the signal that killed it; None while it runs."""
        return self._process.poll()

    @property
    def ready(self) -> bool:
        """Whether it has said, since it was started, that it can serve."""
        try:
            while True:
                self._is_ready |= b"READY=1" in self._notes.recv(_NOTE_SIZE).split(b"\n")
        except BlockingIOError:
            return self._is_ready

    def tell_to_end(self, number: int = signal.SIGINT) -> None:
        """Send it the signal to end, unless it got one before."""
        if not self._told and self.status is None:
            self._process.send_signal(number)
        self._told = True

    def stop(self) -> int:
        """Tell it to end, wait for that, and give its exit status."""
        self.tell_to_end()
        try:
            status = self._process.wait(_STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            status = self._process.wait()
        self.hear_out()
        self._notes.close()
        self._file.close()
        return status

    def hear_out(self) -> None:
        """Wait for the last words of a process that has ended."""
        self._listener.join(_STOP_TIMEOUT)  # no longer: a process that it started may hold the pipe open


# A node that fails is started again a second later, five times a minute at most, as systemd's units usually
# are: what fails more often does not come to serve.
RESTART_DELAY = 1.0
MOST_RESTARTS, RESTARTS_WITHIN = 5, 60.0


class Event(Enum):
    """What a look at a process found."""

    NOTHING = auto()
    READY = auto()
    """It can serve, since this look."""
    FAILED = auto()
    """It has ended and will be started again."""
    ENDED = auto()
    """It has ended for good."""


class Keeper:
    """Looks after one process.

    For good is an end that was meant (status 0), that of a process which had not been ready since it was
    started (a restart would meet the same parameters and files), and a failure that comes too often.
    """

    def __init__(self, process: SupervisedProcess, *, restarts: bool = True) -> None:
        """Look after a process that runs; `restarts`: whether it is ever started again."""
        self.process = process
        self._restarts = restarts
        self._restarted: deque[float] = deque(maxlen=MOST_RESTARTS)
        self._due: float | None = None
        self._was_ready = False

    @property
    def ready(self) -> bool:
        """Whether the process ran and could serve when it was last looked at."""
        return self._was_ready

    def look(self, now: float) -> Event:
        """Look at the process, and start it again if that is due.

        Args:
            now: Of a clock that never goes back [s].
        """
        if self._due is not None:
            if now >= self._due:
                self._due = None
                self._restarted.append(now)
                self.process.start()
            return Event.NOTHING
        was_ready, self._was_ready = self._was_ready, self.process.ready
        if self.process.status is not None:
            may_return = self._was_ready and self.process.status != 0 and self._restarts
            self._was_ready = False
            if not may_return or self._is_frequent(now):
                return Event.ENDED
            self._due = now + RESTART_DELAY
            return Event.FAILED
        return Event.READY if self._was_ready and not was_ready else Event.NOTHING

    def _is_frequent(self, now: float) -> bool:
        return len(self._restarted) == MOST_RESTARTS and now - self._restarted[0] < RESTARTS_WITHIN
