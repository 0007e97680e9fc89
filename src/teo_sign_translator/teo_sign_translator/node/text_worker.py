# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A bounded queue of texts and the thread that works through it, in order."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

Item = TypeVar("Item")


class TextWorker(Generic[Item]):
    """Hands items to a function one after the other, in a thread of its own; others queue meanwhile."""

    def __init__(self, work: Callable[[Item], None], *, size: int) -> None:
        """Start the thread.

        Args:
            work: Called with each item, in their order; must not raise.
            size: Items that may wait; may be changed at any time.
        """
        self._work = work
        self.size = size
        self._waiting: deque[Item] = deque()
        self._changed = threading.Condition()
        self._stopped = False
        # A daemon: a text that takes long must not keep the process from ending.
        self._thread = threading.Thread(target=self._run, name="translating", daemon=True)
        self._thread.start()

    def offer(self, item: Item) -> bool:
        """Take an item in; False if too many wait already, or the worker has been stopped."""
        with self._changed:
            if self._stopped or len(self._waiting) >= self.size:
                return False
            self._waiting.append(item)
            self._changed.notify()
            return True

    @property
    def waiting(self) -> int:
        """Items that wait, without the one that is worked on."""
        return len(self._waiting)

    def stop(self, timeout: float) -> list[Item]:
        """Accept no more items, and return those that still wait.

        Args:
            timeout: How long to wait for the item that is worked on [s].
        """
        with self._changed:
            self._stopped = True
            left = list(self._waiting)
            self._waiting.clear()
            self._changed.notify()
        self._thread.join(timeout)
        return left

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._stopped or self._waiting)
                if self._stopped:
                    return
                item = self._waiting.popleft()
            self._work(item)
