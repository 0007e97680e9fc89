# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands of `lut` that other packages bring: what needs a camera's software is not on every robot."""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import EntryPoint, entry_points
from typing import NamedTuple

import typer

from teo_lut_executor.cli.options import fail
from teo_signs.errors import LutError

# Entry points of this group are commands: name, and a function with typer's annotations. Its context's `obj`
# are the directories of the table that is used without --lut, in the order in which a gloss is sought there.
GROUP = "teo_lut_executor.lut_commands"


class _Known(NamedTuple):
    """A command that belongs to `lut` for its users though another package has it."""

    does: str
    provider: str
    requirements: str


_CAPTURE = ("teo_sign_capture", "requirements/capture.txt")
_AUTHORING = ("teo_sign_authoring", "requirements/authoring.txt")
_KNOWN = {
    "capture": _Known("A sign from recordings of a person.", *_CAPTURE),
    "coverage": _Known("What of a text has signs.", "teo_sign_translator", "requirements/run.txt"),
    "ease": _Known("Postures of words that are quicker to reach.", *_AUTHORING),
    "import": _Known(
        "Signs from a clip in which a person's points were found, or from SignWriting.", *_CAPTURE
    ),
    "recognise": _Known("Which signs of the table a demonstration may be.", *_CAPTURE),
    "fit": _Known("How well signs fit a robot.", *_AUTHORING),
    "retarget": _Known("A language's table for another robot.", *_AUTHORING),
    "record": _Known("A sign from the person before the camera, now.", *_CAPTURE),
}


def add_plugins(app: typer.Typer) -> None:
    """Add the commands of other packages; one that should be there and is not says what to install."""
    found = {point.name: point for point in entry_points(group=GROUP)}
    for name, point in sorted(found.items()):
        try:
            app.command(name)(point.load())
        except ImportError as error:
            _add_placeholder(app, name, _reason_not_loaded(point, error))
    for name in _KNOWN.keys() - found.keys():
        known = _KNOWN[name]
        _add_placeholder(
            app,
            name,
            f"lut {name}: expected the package {known.provider}, which is not installed; "
            f"install {known.requirements} and build the package",
        )


def _reason_not_loaded(point: EntryPoint, error: ImportError) -> str:
    provider = point.module.partition(".")[0]
    install = f"; install {_KNOWN[point.name].requirements}" if point.name in _KNOWN else ""
    return f"lut {point.name}: expected what {provider} needs, got: {error}{install}"


def _add_placeholder(app: typer.Typer, name: str, reason: str) -> None:
    def missing() -> None:
        fail(LutError("not_installed", reason))

    does = _KNOWN[name].does if name in _KNOWN else "A command of another package."
    missing.__doc__ = f"{does} (not installed)"
    anything = {"allow_extra_args": True, "ignore_unknown_options": True}
    command: Callable[[], None] = missing
    app.command(name, context_settings=anything)(command)
