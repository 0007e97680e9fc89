# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""When a process that ended is started again."""

from __future__ import annotations

from collections import deque
from enum import Enum, auto

from teo_bringup.supervised_process import SupervisedProcess

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
