"""Ending a long command cleanly by SIGINT or SIGTERM."""

from __future__ import annotations

import signal
from types import FrameType


class StopSignals:
    """Notes from its making on that one of the signals came, instead of letting it end the process."""

    def __init__(self) -> None:
        self.came = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._note)

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        self.came = True
