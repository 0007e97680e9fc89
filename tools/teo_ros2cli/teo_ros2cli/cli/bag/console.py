# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How the `ros2 bag` verbs speak of what is wrong, and how a signal ends them."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

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


class StopSignals:
    """Notes from its making on that SIGINT or SIGTERM came, instead of letting it end the process."""

    def __init__(self) -> None:
        self.came = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._note)

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        self.came = True
