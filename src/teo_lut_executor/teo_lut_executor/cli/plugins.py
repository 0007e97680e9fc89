# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Commands of `lut` that other packages bring: what needs a camera's software is not on every robot."""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import EntryPoint, entry_points

import typer

from teo_lut_executor.cli.options import fail
from teo_signs.errors import LutError

# Entry points of this group are commands: name, and a function with typer's annotations.
GROUP = "teo_lut_executor.lut_commands"

# Commands that belong to `lut` for its users though another package has them, and what each does.
_KNOWN = {
    "capture": "A sign from recordings of a person.",
    "import": "A sign from a clip in which a person's points were found.",
    "record": "A sign from the person before the camera, now.",
}
_PROVIDER = "teo_sign_capture"


def add_plugins(app: typer.Typer) -> None:
    """Add the commands of other packages; one that should be there and is not says what to install."""
    found = {point.name: point for point in entry_points(group=GROUP)}
    for name, point in sorted(found.items()):
        try:
            app.command(name)(point.load())
        except ImportError as error:
            _add_placeholder(app, name, _reason_not_loaded(point, error))
    for name in _KNOWN.keys() - found.keys():
        _add_placeholder(
            app,
            name,
            f"lut {name}: expected the package {_PROVIDER}, which is not installed; "
            "install requirements/capture.txt and build the package",
        )


def _reason_not_loaded(point: EntryPoint, error: ImportError) -> str:
    provider = point.module.partition(".")[0]
    return f"lut {point.name}: expected what {provider} needs, got: {error}; install requirements/capture.txt"


def _add_placeholder(app: typer.Typer, name: str, reason: str) -> None:
    def missing() -> None:
        fail(LutError("not_installed", reason))

    missing.__doc__ = f"{_KNOWN.get(name, 'A command of another package.')} (not installed)"
    anything = {"allow_extra_args": True, "ignore_unknown_options": True}
    command: Callable[[], None] = missing
    app.command(name, context_settings=anything)(command)
