# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A command to run, and what is known of its run."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

_State = Literal["waiting", "running", "done", "failed", "cancelled"]


@dataclass(frozen=True, kw_only=True)
class Limits:
    """What a command may use.

    Attributes:
        seconds: Time from its start to its end [s]; of processor time twice as much, on two cores.
        memory: Address space of each of its processes [B].
        file: Largest file that it writes [B].
    """

    seconds: float = 120.0
    memory: int = 8 * 1024**3
    file: int = 256 * 1024**2


@dataclass(frozen=True, kw_only=True)
class Command:
    """A command of the project.

    Attributes:
        name: What it is for, in one word, as pages know it: "capture", "coverage".
        arguments: The program and what it is told.
        limits: What it may use.
    """

    name: str
    arguments: tuple[str, ...]
    limits: Limits = field(default_factory=Limits)


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a command says that it is.

    Attributes:
        what: What it does now; empty before it has said so.
        done: How much of it is done.
        total: Of how much; 0 where it does not know.
    """

    what: str = ""
    done: int = 0
    total: int = 0


class Job:
    """One run of a command. Fields change as it goes; `ended` is set when nothing will change any more."""

    def __init__(self, command: Command, number: int, then: Callable[[], None]) -> None:
        """A job that waits.

        Args:
            command: What to run.
            number: Counts the jobs of the queue.
            then: To be called when it has run.
        """
        self.id = secrets.token_urlsafe(12)  # who has it may look at it and cancel it
        self.command = command
        self.number = number
        self.then = then
        self.state: _State = "waiting"
        self.progress = Progress()
        self.result: Any = None
        """The last JSON value that the command printed."""
        self.output = ""
        """All that it printed on standard output."""
        self.code = ""
        """Why it failed."""
        self.message = ""
        self.ended = asyncio.Event()

    @property
    def is_over(self) -> bool:
        """Whether it ended, in whatever way."""
        return self.state in ("done", "failed", "cancelled")

    def told(self, ahead: int) -> dict[str, Any]:
        """What a page is told of it.

        Args:
            ahead: Jobs that come before it.
        """
        return {
            "id": self.id,
            "name": self.command.name,
            "state": self.state,
            "ahead": ahead,
            "progress": vars(self.progress),
            "result": self.result,
            "code": self.code,
            "message": self.message,
        }
