# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What all of /api works with: the signs, jobs, recordings, reviews, and where files are kept."""

from __future__ import annotations

import asyncio
import os
import shutil
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path

import msgspec
from msgspec import Struct

from teo_console.errors import ConsoleError
from teo_console.jobs.commands import Commands
from teo_console.jobs.queue import JobQueue
from teo_console.jobs.recordings import Recordings
from teo_console.protocol import Gloss
from teo_console.review.store import ReviewStore
from teo_description.humanoid import DEFAULT_ROBOT
from teo_sign_languages import DEFAULT_LANGUAGE

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


class WithGloss(Struct, frozen=True, forbid_unknown_fields=True):
    """A request that names a sign, and says no more."""

    gloss: Gloss


def gloss_key(gloss: str) -> str:
    """A gloss as people type it, to as the table has it: capitals, "_" for blanks."""
    return "_".join(gloss.upper().split())


class SignList:
    """Lists the table when it is asked for."""

    def __init__(self, commands: Commands, lookups: JobQueue) -> None:
        """List nothing yet.

        Args:
            commands: On the table.
            lookups: Lists it.
        """
        self._commands = commands
        self._lookups = lookups
        self._signs: dict[str, ListedSign] = {}
        self._listed = -_FRESH

    async def signs(self) -> dict[str, ListedSign]:
        """Every sign by its gloss.

        Raises:
            ConsoleError: The command failed.
        """
        if time.monotonic() - self._listed > _FRESH:
            job = await self._lookups.run(self._commands.list_signs())
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

    def changed(self) -> None:
        """Forget the list: the table was written to."""
        self._listed = -_FRESH


@dataclass(frozen=True, kw_only=True)
class Table:
    """What belongs to one sign language on one robot: nothing of it meets what belongs to another."""

    commands: Commands
    signs: SignList
    reviews: ReviewStore


# Begins the name of a console's folder of recordings; the number of its process ends it.
_RECORDINGS = "recordings-"


@dataclass(frozen=True, kw_only=True)
class Folders:
    """Where files are kept.

    Attributes:
        kept: Recordings that were kept on purpose.
        reviews: The file of the reviews of the default language and robot; those of others stand in
            `reviews/<language>/<robot>/` beside it, as their tables of signs do.
        signwriting: What `draw_signwriting` has drawn; need not be there.
        cache: What can be made again: films of signs, recordings while they are looked at.
    """

    kept: Path
    reviews: Path
    signwriting: Path
    cache: Path

    @classmethod
    def of_user(cls) -> Folders:
        """In the user's folders (XDG base directories)."""
        data = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "teo"
        cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "teo_console"
        return cls(
            kept=data / "recordings",
            reviews=data / "reviews.sqlite",
            signwriting=data / "signwriting",
            cache=cache,
        )

    def reviews_of(self, commands: Commands) -> Path:
        """The file of the reviews of one language and robot."""
        if (commands.language, commands.robot) == (DEFAULT_LANGUAGE, DEFAULT_ROBOT):
            return self.reviews
        return self.reviews.parent / "reviews" / commands.language / commands.robot / self.reviews.name


@dataclass
class Preparation:
    """Something that takes several commands, one after the other: pages ask how far it is.

    Attributes:
        total: How many steps there are.
    """

    total: int
    done: int = 0
    result: str = ""
    code: str = ""
    message: str = ""


class Workbench:
    """Made and used in the server's event loop."""

    def __init__(self, folders: Folders, commands: Commands) -> None:
        """Open what is kept.

        Raises:
            ConsoleError: "bad_reviews".
            OSError: A folder cannot be made.
        """
        self.folders = folders
        self.jobs = JobQueue()
        # What takes a second or two, and what nobody is told of, waits for no film that is looked through.
        self.lookups = JobQueue()
        _delete_what_was_left(folders.cache)
        # One console of a user each: several do not delete each other's recordings.
        self.recordings = Recordings(folders.cache / f"{_RECORDINGS}{os.getpid()}", self.lookups)
        self._tables: dict[Commands, Table] = {}
        self.use(commands)
        self.preparations: dict[str, Preparation] = {}
        self._preparing: asyncio.Task[None] | None = None

    @property
    def table(self) -> Table:
        """What pages work on now. Whoever works on for a while keeps it: another may be used meanwhile."""
        return self._table

    def use(self, commands: Commands) -> None:
        """Work on the signs of a language and robot from now on.

        Raises:
            ConsoleError: "bad_reviews".
            OSError: A folder cannot be made.
        """
        if commands not in self._tables:
            self._tables[commands] = Table(
                commands=commands,
                signs=SignList(commands, self.lookups),
                reviews=ReviewStore(self.folders.reviews_of(commands)),
            )
        self._table = self._tables[commands]

    def prepare(self, name: str, total: int, work: Callable[[Preparation], Awaitable[str]]) -> None:
        """Begin something that takes a while; its result is what the work returns.

        Raises:
            ConsoleError: "busy": something is being prepared already.
        """
        if self._preparing is not None and not self._preparing.done():
            raise ConsoleError("busy", "expected one series to be prepared at a time: wait for the other")
        preparation = self.preparations[name] = Preparation(total)

        async def go() -> None:
            try:
                preparation.result = await work(preparation)
            except ConsoleError as error:
                preparation.code, preparation.message = error.code, str(error)

        self._preparing = asyncio.create_task(go())

    async def close(self) -> None:
        """End whatever runs and delete what nobody kept."""
        if self._preparing is not None:
            self._preparing.cancel()
        await self.jobs.close()
        await self.lookups.close()
        self.recordings.close()
        for table in self._tables.values():
            table.reviews.close()


def _delete_what_was_left(cache: Path) -> None:
    """Delete recordings of consoles that were killed before they could."""
    for folder in cache.glob(f"{_RECORDINGS}*"):
        number = folder.name.removeprefix(_RECORDINGS)
        if not Path(f"/proc/{number}").exists():
            shutil.rmtree(folder, ignore_errors=True)
