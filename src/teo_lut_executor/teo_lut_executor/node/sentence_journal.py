# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The journal of one executor: where it is, and what becomes of it when it cannot be kept."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from pathlib import Path

from rclpy.node import Node

from teo_lut_executor.execution.events import Sentence
from teo_lut_executor.execution.journal import Journal, Kept, MessageKey
from teo_signs.errors import PlanError


class SentenceJournal:
    """Keeps a `Journal` if there is to be one, and signs without where it cannot be kept."""

    def __init__(self, node: Node, *, folder: str) -> None:
        """Open the journal.

        Args:
            node: Whose it is; its full name and DDS domain name the file.
            folder: Where it is kept; empty for none.
        """
        self._journal: Journal | None = None
        self._left: tuple[Kept, ...] = ()
        if not folder:
            return
        name = node.get_fully_qualified_name().strip("/").replace("/", ".")
        file = f"domain{os.environ.get('ROS_DOMAIN_ID', '0')}.{name}.jsonl"
        path = Path(folder).expanduser() / file
        try:
            self._journal = Journal(path)
        except OSError as error:
            node.get_logger().warning(f"no journal is kept, a killed executor forgets sentences: {error}")
        else:
            self._left = self._journal.left

    @property
    def kept(self) -> bool:
        """Whether there is a journal."""
        return self._journal is not None

    def left(self, *, attempts: int, age: float) -> Iterator[tuple[Kept, PlanError | None]]:
        """What an executor before this one was killed with, and why it is not signed; None where it is.

        Args:
            attempts: How often a sentence is begun before it is given up [1].
            age: Up to which it is signed [s].
        """
        for kept in self._left:
            waited = time.time() - kept.accepted
            if kept.attempts >= attempts:
                error = PlanError("interrupted", "the executor ended while it signed it: send it again")
            elif waited > age:
                error = expired(waited)
            else:
                yield kept, None
                continue
            yield kept, error

    def begin(self) -> None:
        """Forget what was left: it was accepted anew or ended."""
        if self._journal is not None:
            self._journal.begin()

    def knows(self, message: MessageKey) -> bool:
        """Whether a message was accepted or refused before."""
        return self._journal is not None and self._journal.knows(message)

    def accepted(
        self, ticket: int, sentence: Sentence, *, attempts: int = 0, message: MessageKey | None = None
    ) -> None:
        """A sentence waits to be signed."""
        if self._journal is not None:
            self._journal.accepted(ticket, sentence, time.time(), attempts=attempts, message=message)

    def refused(self, message: MessageKey) -> None:
        """What came with a message is not accepted."""
        if self._journal is not None:
            self._journal.refused(message)

    def begun(self, ticket: int) -> None:
        """The robot begins to sign it."""
        if self._journal is not None:
            self._journal.begun(ticket)

    def ended(self, ticket: int) -> None:
        """It was signed, or it was told that it is not."""
        if self._journal is not None:
            self._journal.ended(ticket)

    def close(self) -> None:
        """Write no more."""
        if self._journal is not None:
            self._journal.close()


def expired(waited: float) -> PlanError:
    """Why a sentence is not signed that has waited for so long [s]."""
    return PlanError("expired", f"it waited for {waited:.0f} s: send it again")
