# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the commands of `lut` share: options, and how they fail."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console

from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign

TableDirectory = Annotated[
    Path | None,
    typer.Option(
        "--lut", help="Directory of the table; your own and, beneath it, the language's without it."
    ),
]
RobotName = Annotated[str, typer.Option("--robot", help="Name of the robot that makes the signs.")]
LanguageCode = Annotated[str, typer.Option("--language", help="Sign language, by its ISO 639-3 code.")]
AsJson = Annotated[bool, typer.Option("--json", help="As one JSON object, for programs.")]
Replace = Annotated[bool, typer.Option("--replace", help="Replace what is there already.")]

_errors = Console(stderr=True, highlight=False)


def fail(error: LutError) -> NoReturn:
    """Print an error's code and sentence and exit with status 1."""
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error


def open_table(directory: Path | None, robot: str, language: str) -> Lut:
    """Open the table that --lut, --robot and --language name, or end with its error."""
    try:
        return Lut.open(directory, language=language, robot=robot)
    except LutError as error:
        fail(error)


def signs_of_kind(signs: Lut, kind: str) -> list[Sign]:
    """The table's signs of one kind; an entry that cannot be read ends the command with its error."""
    try:
        return [sign for sign in signs.values() if sign.kind == kind]
    except LutError as error:
        fail(error)
