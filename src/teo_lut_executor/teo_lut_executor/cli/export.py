# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`lut export`: signs in the formats of programs that play motions."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from teo_common.atomic_files import write_atomically
from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT
from teo_lut_executor.cli.options import LanguageCode, Replace, RobotName, TableDirectory, fail
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError, PlanError

_output = Console(highlight=False)
_errors = Console(stderr=True, highlight=False)


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
    replace: Replace = False,
    lut: TableDirectory = None,
    robot: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
) -> None:
    """Write signs as the robot would make them, from rest to rest, for programs that play motions."""
    from teo_description.robot import Robot
    from teo_motion.planner import Planner, sign_motion
    from teo_motion.sentence.signing_style import RestPosture
    from teo_signs.export import play_motion2_parameters, playback_mask, save_playback_tables
    from teo_signs.look_up_table import Lut

    try:
        signs = Lut.open(lut, language=language, robot=robot)
        chosen = [signs[gloss] for gloss in dict.fromkeys(glosses)]
        if format_ is ExportFormat.PLAY_MOTION2 and out.exists() and not replace:
            raise LutError("exists", f"{out}: expected a file that is not there, or --replace")
        # Other programs have a robot begin and end as it is parked.
        planner = Planner(
            signs, robot=Robot.load(robot), least_standing="sketched", rest_posture=RestPosture.HANGING
        )
        motions = [
            sign_motion(planner, sign, period=period)
            for sign in track(
                chosen, "planning", console=_errors, transient=True, disable=not _errors.is_terminal
            )
        ]
        if format_ is ExportFormat.PLAY_MOTION2:
            out.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(out, play_motion2_parameters(motions).encode())
            _output.print(f"wrote {out}: {len(motions)} motions", soft_wrap=True)
            return
        for motion in motions:
            files = save_playback_tables(out, motion, replace=replace)
            for file, joints in zip(files, motion.limbs.values(), strict=True):
                _output.print(
                    f"wrote {file}: {len(motion.times)} rows; timeIdx 0, timeScale 1, "
                    f"{playback_mask(len(joints))}",
                    soft_wrap=True,
                )
    except LutError as error:
        fail(error)
    except (PlanError, DescriptionError) as error:
        fail(LutError(error.code, str(error)))
    except OSError as error:
        fail(LutError("not_written", f"--out: expected a place to write to, got: {error}"))
