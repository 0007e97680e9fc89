# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Playing a bag in time: when its messages are due, and reading them before they are."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from queue import Full, Queue

from teo_common.mcap_salvage import StoredMessage


class Schedule:
    """Translates the times of a bag to moments of a steady clock, at a rate that may change, with pauses.

    Args:
        origin: Time of the bag that is due at once [ns].
        now: Moment at which playing starts [s of a steady clock].
        rate: Seconds of the bag in one second of the clock.
        paused: Begin with a pause.

    Attributes:
        rate: As above; `set_rate` changes it.
        paused: True in a pause.
    """

    def __init__(self, origin: int, now: float, *, rate: float = 1.0, paused: bool = False) -> None:
        self._bag = origin
        self._now = now
        self.rate = rate
        self.paused = paused

    def due(self, time: int) -> float:
        """Return the moment [s] at which a time of the bag [ns] is due, as if a pause had just ended."""
        return self._now + (time - self._bag) * 1e-9 / self.rate

    def time_at(self, now: float) -> int:
        """Return the time of the bag [ns] at a moment [s]."""
        if self.paused:
            return self._bag
        return self._bag + round((now - self._now) * self.rate * 1e9)

    def pause(self, now: float) -> None:
        """Stop the time of the bag at a moment [s]."""
        self._settle(now)
        self.paused = True

    def resume(self, now: float) -> None:
        """Let the time of the bag run on from a moment [s]."""
        self._settle(now)
        self.paused = False

    def set_rate(self, rate: float, now: float) -> None:
        """Change the rate from a moment [s] on."""
        self._settle(now)
        self.rate = rate

    def _settle(self, now: float) -> None:
        self._bag = self.time_at(now)
        self._now = now


# Longest time in which the end is not looked for [s].
_STEP = 0.05


class ReadAhead:
    """Reads messages in a thread of its own, so that unpacking a chunk does not hold publishing up.

    Args:
        messages: What is to be read; the thread's alone from now on. What it raises is raised to whoever
            iterates.
        size: Messages that are read before they are taken.
    """

    def __init__(self, messages: Iterator[StoredMessage], size: int) -> None:
        self._messages = messages
        self._queue: Queue[StoredMessage | BaseException | None] = Queue(maxsize=max(size, 1))
        self._closed = False
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._read, name="bag reader", daemon=True)
        self._thread.start()

    def wait_filled(self, stopped: Callable[[], bool]) -> None:
        """Wait until the first messages are there, all of them if they are few."""
        while not self._ended.is_set() and not self._queue.full() and not stopped():
            time.sleep(_STEP / 10)

    def __iter__(self) -> Iterator[StoredMessage]:
        while True:
            item = self._queue.get()
            if item is None:
                return
            if isinstance(item, BaseException):
                raise item
            yield item

    def close(self) -> None:
        """End the thread."""
        self._closed = True
        self._thread.join()

    def _read(self) -> None:
        last: BaseException | None = None
        try:
            for message in self._messages:
                if not self._put(message):
                    return
        except BaseException as error:  # raised again where the messages are taken
            last = error
        self._ended.set()
        self._put(last)

    def _put(self, item: StoredMessage | BaseException | None) -> bool:
        while not self._closed:
            try:
                self._queue.put(item, timeout=_STEP)
            except Full:
                continue
            return True
        return False
