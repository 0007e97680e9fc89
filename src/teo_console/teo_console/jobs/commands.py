# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The project's commands that the console runs, each with what it may use."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal


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
    limits: Limits = Limits()


# Of a film of half a minute, on a busy machine [s]; three seconds take ten on an idle one.
_FILM_SECONDS = 240.0
# Of what only reads the table or plans a sentence [s]: one to ten on an idle machine.
_TABLE_SECONDS = 90.0
# A text is translated in batches; the longest that a page sends takes some ten [s].
_TEXT_SECONDS = 180.0
# TensorFlow Lite and OpenCV map libraries and thread stacks; what they use of it is a tenth.
_MEMORY = 12 * 1024**3

_LUT = ("ros2", "run", "teo_lut_executor", "lut")
_PLAN = ("ros2", "run", "teo_lut_executor", "plan")
_TRANSLATE = ("ros2", "run", "teo_sign_translator", "translate")

Hands = Literal["right", "left", "both"]


@dataclass(frozen=True, kw_only=True)
class Commands:
    """The commands, on one table of signs.

    Attributes:
        robot: Name of the robot whose table it is.
        language: Code of its sign language.
    """

    robot: str
    language: str

    def list_signs(self) -> Command:
        """Every sign of the table, as JSON."""
        return self._lut("list", _TABLE_SECONDS, "list", "--json")

    def nearest_signs(self, words: Sequence[str], count: int) -> Command:
        """For each of these words those that look most like it, as JSON."""
        told = ("--kind", "lexical", "--json", "--count", str(count), "--", *words)
        return self._lut("nearest", _TABLE_SECONDS, "nearest", *told)

    def coverage(self, text: str) -> Command:
        """Which words of a text are signed, and what to record next, as JSON."""
        return self._lut("coverage", _TEXT_SECONDS, "coverage", "--text", text, "--json")

    def film(self, gloss: str, out: Path) -> Command:
        """A film of a sign."""
        return self._lut("film", _TABLE_SECONDS, "render", "--out", str(out), "--", gloss)

    def translate(self, text: str) -> Command:
        """The glosses of a text, as `plan` takes them."""
        return _command("translate", _TEXT_SECONDS, *_TRANSLATE, "--language", self.language, "--", text)

    def enter_reviews(self, export: Path) -> Command:
        """Enter an export of reviews into the user's own table; what came of it as JSON."""
        return self._lut("enter", _TABLE_SECONDS, "review", str(export), "--json")

    def plan(self, glosses: str, out: Path) -> Command:
        """The motion of a sentence from rest to rest, as CSV: what the robot would do."""
        told = (*self._table, "--csv", str(out), "--", glosses)
        return _command("plan", _TABLE_SECONDS, *_PLAN, *told)

    def capture(
        self,
        recording: Path,
        cache: Path,
        *,
        gloss: str,
        hands: Hands | None,
        licence: str,
        notes: str = "",
        accept: bool,
        replace: bool,
        trial: Path | None = None,
    ) -> Command:
        """A sign from a recording, as JSON.

        Args:
            recording: Film or bag.
            cache: Where points that were found in it are kept for the next time.
            gloss: Name of the sign.
            hands: The hands that make it; None to see it in the film.
            licence: The terms to which the person agreed.
            notes: For the entry: who agreed to what.
            accept: Whether to take it although a gate speaks against it, one level of evidence lower.
            replace: Whether it may take the place of a sign of that name.
            trial: Directory to write to instead of the user's own table.
        """
        options = ["--gloss", gloss, "--licence", licence, "--cache", str(cache), "--json"]
        options += ["--notes", notes] if notes else []
        options += ["--hands", hands] if hands else []
        options += ["--accept"] if accept else []
        options += ["--replace"] if replace else []
        options += ["--trial", str(trial)] if trial else []
        # The page shows the film itself, and the robot in motion.
        return self._lut("capture", _FILM_SECONDS, "capture", str(recording), "--no-draw", *options)

    def recognise(self, recording: Path, cache: Path, meant: str) -> Command:
        """Which signs a recording looks like, and what differs from the one that was meant, as JSON."""
        options = ("--meant", meant, "--cache", str(cache), "--json")
        return self._lut("recognise", _FILM_SECONDS, "recognise", str(recording), *options)

    def _lut(self, name: str, seconds: float, verb: str, *arguments: str) -> Command:
        return _command(name, seconds, *_LUT, verb, *self._table, *arguments)

    @property
    def _table(self) -> tuple[str, ...]:
        return ("--robot", self.robot, "--language", self.language)


def _command(name: str, seconds: float, *arguments: str) -> Command:
    return Command(name=name, arguments=arguments, limits=Limits(seconds=seconds, memory=_MEMORY))
