# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut retarget`: makes a language's table for a robot."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console
from rich.progress import Progress

from teo_common.errors import CodedError
from teo_description.errors import DescriptionError
from teo_sign_capture.cli.options import LanguageCode, RobotName
from teo_sign_languages import DEFAULT_LANGUAGE, LanguageError, load_language
from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut, user_lut_directory

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


def retarget(
    robot: RobotName,
    glosses: Annotated[
        list[str] | None, typer.Argument(metavar="[GLOSS]...", help="Which signs; all without it.")
    ] = None,
    language: LanguageCode = DEFAULT_LANGUAGE,
    out: Annotated[
        Path | None,
        typer.Option(help="Directory of the table; your own of that language and robot without it."),
    ] = None,
    replace: Annotated[bool, typer.Option("--replace", help="Make entries that are there anew.")] = False,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="Signs made at a time; one for each core without it.")
    ] = None,
) -> None:
    """Make the signs of a language for a robot, each from its recording, its score, or what TEO shows.

    Exit status: 0 all are there, 1 some are not (each with code and reason on standard error).
    """
    from teo_description.robot import Robot
    from teo_sign_authoring.transfer.language_signs import LanguageSigns
    from teo_sign_authoring.transfer.table_transfer import Transferred, transfer_table

    try:
        known = LanguageSigns(load_language(language), Robot.load(robot)).glosses
        unknown = [gloss for gloss in glosses or [] if gloss not in known]
        if unknown:
            message = f"expected signs of {language} ({len(known)} there are), got {', '.join(unknown)}"
            raise LutError("unknown_sign", message)
        table = out or user_lut_directory(language, robot)
        if table.is_dir():  # what is there stays, if it is of this language and robot
            Lut.open(table, language=language, robot=robot)
    except (LanguageError, LutError, DescriptionError) as error:
        _fail(error)
    chosen = tuple(glosses or known)
    with Progress(console=_errors, transient=True) as progress:
        task = progress.add_task(f"{language} for {robot}", total=len(chosen))

        def done(sign: Transferred) -> None:
            progress.advance(task)
            if sign.refused:
                _errors.print(f"{sign.code}: {sign.message}", markup=False, soft_wrap=True)

        count = jobs or os.cpu_count() or 1
        found = transfer_table(language, robot, chosen, table, replace=replace, jobs=count, done=done)
    refused = sum(sign.refused for sign in found)
    made = sum(sign.code == "made" for sign in found)
    _output.print(
        f"{table}: {made} signs made, {len(found) - made - refused} there already, {refused} refused",
        soft_wrap=True,
    )
    if refused:
        raise typer.Exit(1)


def _fail(error: CodedError) -> NoReturn:
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1) from error
