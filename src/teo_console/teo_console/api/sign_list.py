# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The signs of the table as the project's own command lists them, kept for a while."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import msgspec
from msgspec import Struct

from teo_console.errors import ConsoleError
from teo_console.jobs import project_commands
from teo_console.jobs.queue import JobQueue
from teo_console.review.series import CHOICES

# Signs that are taught elsewhere are seen after this long [s]; listing takes a second of a core.
_FRESH = 30.0


class ListedSign(Struct, frozen=True, kw_only=True):
    """One sign as `lut list --json` tells it."""

    gloss: str
    language: str
    kind: str
    handedness: str
    duration: float
    standing: str
    source: str
    licence: str
    handshapes: tuple[str, ...]
    motion_hash: str


class SignList:
    """Lists the table when it is asked for."""

    def __init__(self, lookups: JobQueue, jobs: JobQueue) -> None:
        """List nothing yet.

        Args:
            lookups: Lists the table.
            jobs: Compares all of its signs, which takes longer.
        """
        self._lookups = lookups
        self._jobs = jobs
        self._signs: dict[str, ListedSign] = {}
        self._listed = -_FRESH
        self._nearest: dict[str, Sequence[str]] = {}
        self._nearest_of: frozenset[str] = frozenset()

    async def signs(self) -> dict[str, ListedSign]:
        """Every sign by its gloss.

        Raises:
            ConsoleError: The command failed.
        """
        if time.monotonic() - self._listed > _FRESH:
            job = await self._lookups.run(project_commands.list_signs())
            listed = msgspec.convert(job.result["signs"], list[ListedSign])
            self._signs = {sign.gloss: sign for sign in listed}
            self._listed = time.monotonic()
        return self._signs

    async def get(self, gloss: str) -> ListedSign:
        """One sign.

        Raises:
            ConsoleError: "unknown_sign", or the command failed.
        """
        signs = await self.signs()
        if gloss not in signs:
            raise ConsoleError(
                "unknown_sign", f"expected a sign of the table, which has {len(signs)}, got {gloss!r}"
            )
        return signs[gloss]

    async def nearest(self, gloss: str) -> Sequence[str]:
        """The words that look most like a sign, the nearest first; none of what is no word.

        Raises:
            ConsoleError: The command failed.
        """
        motions = frozenset(sign.motion_hash for sign in (await self.signs()).values())
        if motions != self._nearest_of:
            job = await self._jobs.run(project_commands.nearest_signs(CHOICES - 1))
            found: dict[str, list[dict[str, Any]]] = job.result
            self._nearest = {name: [other["gloss"] for other in near] for name, near in found.items()}
            self._nearest_of = motions
        return self._nearest.get(gloss, ())

    def changed(self) -> None:
        """Forget the list: the table was written to."""
        self._listed = -_FRESH
