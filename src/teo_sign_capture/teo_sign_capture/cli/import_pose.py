# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut import`: a sign from a clip in which a person's points were found."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from teo_sign_capture.cli.capture import (
    Draw,
    End,
    Hands,
    KindOption,
    Licence,
    Notes,
    Picture,
    Replace,
    StandingOption,
    Start,
    TableDirectory,
    fail,
    tell,
)
from teo_signs.errors import LutError

_errors = Console(stderr=True, highlight=False)

_DAY = "%Y-%m-%d"


def import_pose(
    file: Annotated[Path, typer.Argument(help="A .pose file: MediaPipe Holistic's or OpenPose's points.")],
    gloss: Annotated[str, typer.Option(help="Name of the sign.")],
    start: Start = None,
    end: End = None,
    lut: TableDirectory = None,
    replace: Replace = False,
    person: Annotated[int | None, typer.Option(help="Which of several people, from 0.")] = None,
    hands: Hands = None,
    kind: KindOption = "lexical",
    standing: StandingOption = None,
    recorded: Annotated[
        datetime | None, typer.Option(formats=[_DAY], help="Day of the recording, for the entry.")
    ] = None,
    licence: Licence = "not stated: ask the person who signs before passing it on",
    notes: Notes = "",
    picture: Picture = None,
    draw: Draw = True,
) -> None:
    """Capture a sign from a clip in which a person's points were found, lifted by the lengths of limbs.

    Exit status: 0 captured, 1 not (code and reason on standard error), 2 wrong options.
    """
    from teo_description.robot import Robot
    from teo_sign_capture.entries.bag_capture import Job, Settings
    from teo_sign_capture.entries.pose_capture import capture_pose_file
    from teo_sign_capture.entries.take import Cut
    from teo_signs.look_up_table import default_lut_directory

    table = lut or default_lut_directory()
    settings = Settings(
        table=table,
        replace=replace,
        kind=kind,
        standing=standing,
        licence=licence,
        notes=notes,
        pictures=(picture or table) if draw else None,
    )
    job = Job(gloss=gloss, bags=(), cut=Cut(start=start, end=end), handedness=hands, person=person)
    day = None if recorded is None else recorded.strftime(_DAY)
    try:
        with _errors.status(f"capturing {file.name}"):
            saved = capture_pose_file(Robot.load(), file, job, settings, recorded=day)
    except LutError as error:
        fail(error)
    tell(saved)
