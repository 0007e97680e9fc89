# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the `ros2 bag` verbs speak of what is wrong, and how signals and keys reach them."""

from __future__ import annotations

import os
import select
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from teo_ros2cli.errors import Ros2CliError


def warn(sentence: str) -> None:
    """Print a warning."""
    print(f"[WARN] [ros2bag]: {sentence}", file=sys.stderr)


@contextmanager
def bag_errors() -> Iterator[None]:
    """Let the text of an error in the block, or in a function decorated so, say that the bag tool speaks."""
    try:
        yield
    except Ros2CliError as error:
        raise Ros2CliError(error.code, f"[ERROR] [ros2bag]: {error}") from error


def stop_signals() -> Callable[[], bool]:
    """Keep SIGINT and SIGTERM from ending the process; return a function that tells whether one has come."""
    came: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _frame: came.append(number))
    return lambda: bool(came)


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
