# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The project's commands that the console runs, each with what it may use."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from teo_console.jobs.job import Command, Limits

# Of a film of half a minute, on a busy machine [s]; three seconds take ten on an idle one.
_FILM_SECONDS = 240.0
# Of what only reads the table or plans a sentence [s]: one to ten on an idle machine.
_TABLE_SECONDS = 90.0
# Of comparing every word of the table with every other [s]: twelve on an idle machine.
_NEAREST_SECONDS = 300.0
# A text is translated in batches; the longest that a page sends takes some ten [s].
_TEXT_SECONDS = 180.0
# TensorFlow Lite and OpenCV map libraries and thread stacks; what they use of it is a tenth.
_MEMORY = 12 * 1024**3

_LUT = ("ros2", "run", "teo_lut_executor", "lut")

Hands = Literal["right", "left", "both"]


@dataclass(frozen=True, kw_only=True)
class Teaching:
    """A sign to be captured.

    Attributes:
        gloss: Its name.
        hands: The hands that make it; None to see it in the film.
        licence: The terms to which the person agreed.
        notes: For the entry: who agreed to what.
        accept: Whether to take it although a gate speaks against it, one level of evidence lower.
        replace: Whether it may take the place of a sign of that name.
    """

    gloss: str
    hands: Hands | None
    licence: str
    notes: str
    accept: bool
    replace: bool


def list_signs() -> Command:
    """Every sign of the table, as JSON."""
    return _reading("list", _TABLE_SECONDS, "list", "--json")


def nearest_signs(count: int) -> Command:
    """For each word those that look most like it, as JSON."""
    return _reading(
        "nearest", _NEAREST_SECONDS, "nearest", "--kind", "lexical", "--json", "--count", str(count)
    )


def coverage(text: str) -> Command:
    """Which words of a text are signed, and what to record next, as JSON."""
    return _reading("coverage", _TEXT_SECONDS, "coverage", "--text", text, "--json")


def film(gloss: str, out: Path) -> Command:
    """A film of a sign."""
    return _reading("film", _TABLE_SECONDS, "render", "--out", str(out), "--", gloss)


def translate(text: str) -> Command:
    """The glosses of a text, as `plan` takes them."""
    arguments = ("ros2", "run", "teo_sign_translator", "translate", "--", text)
    return Command(
        name="translate", arguments=arguments, limits=Limits(seconds=_TEXT_SECONDS, memory=_MEMORY)
    )


def enter_reviews(export: Path) -> Command:
    """Enter an export of reviews into the user's own table; what came of it as JSON."""
    return _reading("enter", _TABLE_SECONDS, "review", str(export), "--json")


def plan(glosses: str, out: Path) -> Command:
    """The motion of a sentence from rest to rest, as CSV: what the robot would do."""
    arguments = ("ros2", "run", "teo_lut_executor", "plan", "--csv", str(out), "--", glosses)
    return Command(name="plan", arguments=arguments, limits=Limits(seconds=_TABLE_SECONDS, memory=_MEMORY))


def capture(recording: Path, cache: Path, teaching: Teaching, *, trial: Path | None) -> Command:
    """A sign from a recording, as JSON.

    Args:
        recording: Film or bag.
        cache: Where points that were found in it are kept for the next time.
        teaching: What it is to become.
        trial: Directory to write to instead of the user's own table.
    """
    options = ["--gloss", teaching.gloss, "--licence", teaching.licence, "--cache", str(cache), "--json"]
    options += ["--notes", teaching.notes] if teaching.notes else []
    options += ["--hands", teaching.hands] if teaching.hands else []
    options += ["--accept"] if teaching.accept else []
    options += ["--replace"] if teaching.replace else []
    options += ["--trial", str(trial)] if trial else []
    # The page shows the film itself, and the robot in motion.
    return _looking("capture", "capture", str(recording), "--no-draw", *options)


def recognise(recording: Path, cache: Path, meant: str) -> Command:
    """Which signs a recording looks like, and what differs from the one that was meant, as JSON."""
    options = ("--meant", meant, "--cache", str(cache), "--json")
    return _looking("recognise", "recognise", str(recording), *options)


def _reading(name: str, seconds: float, *arguments: str) -> Command:
    return Command(name=name, arguments=(*_LUT, *arguments), limits=Limits(seconds=seconds, memory=_MEMORY))


def _looking(name: str, *arguments: str) -> Command:
    return _reading(name, _FILM_SECONDS, *arguments)
