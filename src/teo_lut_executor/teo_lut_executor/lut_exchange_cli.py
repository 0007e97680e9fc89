"""`lut import` and `lut export`: signs from and in the formats of other programs."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from teo_description.files import write_atomically
from teo_lut_executor.lut_capture_cli import (
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
from teo_lut_executor.lut_error import LutError
from teo_lut_executor.plan_error import PlanError

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)

_DAY = "%Y-%m-%d"


class ExportFormat(StrEnum):
    """What `lut export` writes."""

    PLAY_MOTION2 = "play_motion2"
    YARP = "yarp"


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
    from teo_lut_executor.capture.bag_capture import Job, Settings
    from teo_lut_executor.capture.pose_capture import capture_pose_file
    from teo_lut_executor.capture.take import Cut
    from teo_lut_executor.lut import default_lut_directory

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


def export(
    glosses: Annotated[list[str], typer.Argument(metavar="GLOSS...", help="Which signs.")],
    out: Annotated[
        Path, typer.Option(help="play_motion2: a .yaml file. yarp: a directory; a folder for each sign.")
    ],
    format_: Annotated[
        ExportFormat,
        typer.Option("--format", help="play_motion2: parameters. yarp: tables for TEO's PlaybackThread."),
    ] = ExportFormat.PLAY_MOTION2,
    period: Annotated[float, typer.Option(help="Time between two rows [s].")] = 0.02,
    replace: Annotated[bool, typer.Option("--replace", help="Replace what is there already.")] = False,
    lut: TableDirectory = None,
) -> None:
    """Write signs as TEO would make them, from rest to rest, for programs that play motions."""
    from teo_description.robot import Robot
    from teo_lut_executor.lut import Lut, default_lut_directory
    from teo_lut_executor.planner import Planner
    from teo_lut_executor.sign_export import sign_motion
    from teo_lut_executor.sign_export_play_motion2 import play_motion2_parameters
    from teo_lut_executor.sign_export_playback import playback_mask, save_playback_tables

    try:
        signs = Lut.open(lut or default_lut_directory())
        chosen = [signs[gloss] for gloss in dict.fromkeys(glosses)]
        if format_ is ExportFormat.PLAY_MOTION2 and out.exists() and not replace:
            raise LutError("exists", f"{out}: expected a file that is not there, or --replace")
        planner = Planner(signs, robot=Robot.load(), least_standing="sketched")
        motions = [
            sign_motion(planner, sign, period=period)
            for sign in track(chosen, description="planning", console=_errors, transient=True)
        ]
        if format_ is ExportFormat.PLAY_MOTION2:
            out.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(out, play_motion2_parameters(motions).encode())
            _output.print(f"wrote {out}: {len(motions)} motions", soft_wrap=True)
            return
        for motion in motions:
            for file in save_playback_tables(out, motion, replace=replace):
                _output.print(
                    f"wrote {file}: {len(motion.times)} rows; timeIdx 0, timeScale 1, "
                    f"{playback_mask(file.stem)}",
                    soft_wrap=True,
                )
    except LutError as error:
        fail(error)
    except PlanError as error:
        fail(LutError(error.code, str(error)))
    except OSError as error:
        fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))
