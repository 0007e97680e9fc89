# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recordings that pages send: checked by content, bounded, deleted unless kept on purpose."""

from __future__ import annotations

import secrets
import shutil
import sys
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from teo_console.errors import ConsoleError
from teo_console.jobs import film_check
from teo_console.jobs.commands import Command, Limits
from teo_console.jobs.queue import JobQueue

# Bytes of a recording: a minute of a telephone's film at 8 Mbit/s; a bag of skeletons is a hundredth of it.
MOST_BYTES = 64 * 1024**2
# Recordings that lie here at a time, over all pages: a class of thirty.
_MOST_RECORDINGS = 32
# Age [s] after which a recording that nobody kept is deleted: longer than anybody looks at one sign.
_MOST_AGE = 3600.0
# Looking at a minute of film takes a second; memory for images of 4096 pixels a side in FFmpeg's threads.
_CHECK_LIMITS = Limits(seconds=30.0, memory=4 * 1024**3)

_MCAP_MAGIC = b"\x89MCAP0\r\n"


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A recording of this machine's, as yet nobody's.

    Attributes:
        id: Random name.
        path: The file, alone in its folder but for what is made of it.
        received: When it came [s].
        figures: Of a film: width, height [pixels], seconds, images.
    """

    id: str
    path: Path
    received: float
    figures: dict[str, Any] = field(default_factory=dict)

    @property
    def folder(self) -> Path:
        """Where the recording is, and what commands make of it."""
        return self.path.parent


class Recordings:
    """Keeps recordings while they are looked at. All methods belong to one event loop."""

    def __init__(self, folder: Path, jobs: JobQueue) -> None:
        """Begin with none; what an earlier run left behind is deleted.

        Args:
            folder: Where they lie; nobody else's files may.
            jobs: Looks at films.
        """
        self._folder = folder
        self._jobs = jobs
        self._recordings: dict[str, Recording] = {}
        self._coming = 0  # those of which a page has sent a part
        shutil.rmtree(folder, ignore_errors=True)

    async def receive(self, pieces: AsyncIterator[bytes], now: float) -> Recording:
        """Take a recording in.

        Args:
            pieces: Its bytes.
            now: The time [s].

        Raises:
            ConsoleError: "too_large", "bad_film" (no film, or not one that can be looked at), "busy".
        """
        self.forget_old(now)
        if len(self._recordings) + self._coming >= _MOST_RECORDINGS:
            raise ConsoleError(
                "busy", f"expected at most {_MOST_RECORDINGS} recordings at a time: discard some"
            )
        identifier = secrets.token_urlsafe(12)
        folder = self._folder / identifier
        folder.mkdir(parents=True, mode=0o700)
        self._coming += 1
        try:
            raw = folder / "received"
            await _write(raw, pieces)
            suffix, container = _kind(raw)
            path = raw.rename(folder / f"film{suffix}")
            figures = await self._look_at(path, container) if container else {}
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        finally:
            self._coming -= 1
        recording = Recording(id=identifier, path=path, received=now, figures=figures)
        self._recordings[identifier] = recording
        return recording

    def get(self, identifier: str) -> Recording:
        """The recording of that name.

        Raises:
            ConsoleError: "unknown_recording".
        """
        recording = self._recordings.get(identifier)
        if recording is None:
            raise ConsoleError(
                "unknown_recording",
                "expected a recording that is still here: it was discarded, or is too old",
            )
        return recording

    def discard(self, identifier: str) -> None:
        """Delete a recording and all that was made of it.

        Raises:
            ConsoleError: "unknown_recording".
        """
        recording = self.get(identifier)
        del self._recordings[identifier]
        shutil.rmtree(recording.folder, ignore_errors=True)

    def keep(self, identifier: str, directory: Path, name: str) -> Path:
        """Copy a recording to where it stays.

        Args:
            identifier: Which.
            directory: Where to; made if it is not there.
            name: Its new name, to which a random part and the suffix are added.

        Raises:
            ConsoleError: "unknown_recording".
            OSError: It cannot be written there.
        """
        recording = self.get(identifier)
        directory.mkdir(parents=True, exist_ok=True)
        kept = directory / f"{name}-{recording.id}{recording.path.suffix}"
        shutil.copyfile(recording.path, kept)
        return kept

    def forget_old(self, now: float) -> None:
        """Delete those that have lain here too long."""
        for recording in list(self._recordings.values()):
            if now - recording.received > _MOST_AGE:
                self.discard(recording.id)

    def close(self) -> None:
        """Delete all."""
        self._recordings.clear()
        shutil.rmtree(self._folder, ignore_errors=True)

    async def _look_at(self, path: Path, container: str) -> dict[str, Any]:
        command = Command(
            name="look",
            arguments=(sys.executable, "-I", film_check.__file__, container, str(path)),
            limits=_CHECK_LIMITS,
        )
        try:
            job = await self._jobs.run(command)
        except ConsoleError as error:
            if error.code in ("busy", "cancelled", "bad_film"):
                raise
            raise ConsoleError("bad_film", f"expected a film that can be looked at, got: {error}") from error
        figures: dict[str, Any] = job.result
        return figures


async def _write(path: Path, pieces: AsyncIterator[bytes]) -> None:
    size = 0
    with path.open("wb") as file:
        async for piece in pieces:
            size += len(piece)
            if size > MOST_BYTES:
                raise ConsoleError(
                    "too_large",
                    f"expected a recording of at most {MOST_BYTES // 2**20} MB: make a shorter one",
                )
            file.write(piece)


def _kind(path: Path) -> tuple[str, str]:
    """Suffix and FFmpeg's container of a recording by its first bytes; of a bag no container.

    Raises:
        ConsoleError: "bad_film": it is neither.
    """
    with path.open("rb") as file:
        first = file.read(12)
    if first.startswith(b"\x1a\x45\xdf\xa3"):
        return ".webm", "matroska"
    if first[4:8] == b"ftyp":
        return ".mp4", "mp4"
    if first.startswith(_MCAP_MAGIC):
        return ".mcap", ""
    raise ConsoleError(
        "bad_film", "expected a film (WebM, MP4, MOV) or a bag (MCAP), got a file that begins as none of them"
    )
