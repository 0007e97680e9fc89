"""`lut export`: signs in the formats of other programs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console
from rich.progress import track

from teo_description.files import write_atomically
from teo_lut_executor.lut_error import LutError
from teo_lut_executor.plan_error import PlanError

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)

Directory = Annotated[
    Path | None, typer.Option("--lut", help="Directory of the table; the package's without it.")
]


class ExportFormat(StrEnum):
    """What `lut export` writes."""

    PLAY_MOTION2 = "play_motion2"
    YARP = "yarp"


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
    replace: Annotated[bool, typer.Option(help="Replace what is there already.")] = False,
    lut: Directory = None,
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
    except (LutError, PlanError) as error:
        _fail(error)
    except OSError as error:
        _fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))


def _fail(error: LutError | PlanError) -> NoReturn:
    _errors.print(f"{error.code}: {error}", markup=False, soft_wrap=True)
    raise typer.Exit(1)
