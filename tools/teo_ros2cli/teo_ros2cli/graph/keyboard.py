# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Single keys from the terminal, for pausing and the like."""

from __future__ import annotations

import os
import select
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

SPACE = " "
RIGHT = "\x1b[C"
UP = "\x1b[A"
DOWN = "\x1b[B"


@contextmanager
def keys(enabled: bool) -> Iterator[Callable[[], str] | None]:
    """Yield a function that returns the key pressed since it was last called, or an empty string.

    Yields None where there are no keys to read: not enabled, or no terminal. The terminal's mode is restored.
    """
    if not enabled or not sys.stdin or not sys.stdin.isatty():
        yield None
        return
    import termios
    import tty

    descriptor = sys.stdin.fileno()
    # A process in the background must not touch the terminal: it would be stopped.
    if os.getpgrp() != os.tcgetpgrp(descriptor):
        yield None
        return
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)
    try:
        yield lambda: _pressed(descriptor)
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)


def _pressed(descriptor: int) -> str:
    if not select.select([descriptor], [], [], 0)[0]:
        return ""
    # The keys with arrows send three characters at once.
    return os.read(descriptor, 3).decode("ascii", errors="ignore")
