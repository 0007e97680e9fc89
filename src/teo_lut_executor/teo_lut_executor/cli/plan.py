# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`plan`: the motion of a sentence in the printed form, without ROS running."""

from __future__ import annotations

import enum
import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from teo_common.atomic_files import write_atomically
from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT, Humanoid
from teo_description.robot import Robot
from teo_lut_executor.cli.options import LanguageCode, RobotName
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan, peak_torques, sample_at
from teo_motion.sentence.sentence_form import SentenceType, printed_form, without_marks
from teo_motion.trajectory.limits import DEFAULT_ACCELERATION, DEFAULT_JERK, MotionLimits
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError, PlanError
from teo_signs.look_up_table import Lut
from teo_signs.mirroring import MirroredSigns
from teo_signs.tokens import parse_printed

# Rows of a CSV a second [Hz], as TEO's own state is published.
_RATE = 100

# Joints whose torque is told: the trunk's, which bears the most, and one of each arm.
_SHOWN_TORQUES = 3

# A nanoradian: what is written stays within the limits that it stands on.
_DECIMALS = 9


class _Type(enum.Enum):
    """Names of `SentenceType` for people."""

    STATEMENT = "statement"
    YES_NO_QUESTION = "yes-no"
    WH_QUESTION = "wh"
    EXCLAMATION = "exclamation"


_out = Console()
_err = Console(stderr=True)
# No markup in the help: it would swallow units in brackets.
app = typer.Typer(add_completion=False, rich_markup_mode=None)


@app.command()
def _plan(
    sentence: Annotated[
        str,
        typer.Argument(
            metavar="GLOSSES",
            help="Glosses by spaces; A-N-A is spelled, digits are numbers, _ alone is a pause; "
            "a ? or ! behind makes it a question or an exclamation.",
        ),
    ],
    type_: Annotated[
        _Type | None, typer.Option("--type", help="Type of sentence; default: as its marks and glosses say.")
    ] = None,
    negated: Annotated[
        bool | None,
        typer.Option(
            "--negated/--affirmed", help="Whether it is negated; default: whether it has a negative sign."
        ),
    ] = None,
    csv: Annotated[
        Path | None,
        typer.Option(help="File for the motion, 100 rows a second: time [s], then [rad] for each joint."),
    ] = None,
    lut: Annotated[
        Path | None,
        typer.Option(help="Directory of the look-up table; default: the language's for the robot."),
    ] = None,
    robot_name: RobotName = DEFAULT_ROBOT,
    language: LanguageCode = DEFAULT_LANGUAGE,
    acceleration: Annotated[
        float, typer.Option(help="Greatest acceleration of the body's joints [rad/s^2].")
    ] = DEFAULT_ACCELERATION,
    jerk: Annotated[float, typer.Option(help="Greatest jerk of the body's joints [rad/s^3].")] = DEFAULT_JERK,
    hand_drive: Annotated[
        str, typer.Option(help="Gearmotors of the hands, one of the robot's; default: its own.")
    ] = "",
    left: Annotated[
        bool, typer.Option("--left", help="Sign as a left-handed signer: every sign as its mirror image.")
    ] = False,
    mp4: Annotated[Path | None, typer.Option(help="File for a film of the motion.")] = None,
    strip: Annotated[Path | None, typer.Option(help="PNG with the middle of every sign.")] = None,
) -> None:
    """Plan how a robot signs a sentence, and print when each token is signed.

    Exit status: 0 if it can be signed, 1 if not or if a file cannot be written, 2 for wrong options.

    Example: plan "TÚ AGUA BEBER?" --csv plan.csv --strip plan.png
    """
    try:
        robot, signs = Robot.load(robot_name), Lut.open(lut, language=language, robot=robot_name)
        limits = MotionLimits.of_robot(
            robot.humanoid, acceleration=acceleration, jerk=jerk, hand_drive=hand_drive
        )
        planner = Planner(
            MirroredSigns(signs, robot) if left else signs,
            limits=limits,
            robot=robot,
            language=signs.language,
        )
        tokens = parse_printed(without_marks(sentence))
        form = printed_form(sentence, tokens, signs.language.head)
        if type_ is not None:
            form = replace(form, type=SentenceType[type_.name])
        if negated is not None:
            form = replace(form, negated=negated)
        plan = planner.plan(tokens, form=form)
        _out.print(_table(plan))
        _out.print(_summary(plan, robot), highlight=False, soft_wrap=True)
        _write(plan, robot.humanoid, csv, mp4, strip)
    except (PlanError, LutError, DescriptionError) as error:
        _complain(f"{error.code}: {error}")
        raise typer.Exit(1) from None
    except OSError as error:
        _complain(f"cannot write {error.filename}: {error.strerror}")
        raise typer.Exit(1) from None


def _table(plan: Plan) -> Table:
    # Rich takes "[s]" for markup.
    table = Table("token", "kind", r"start \[s]", r"duration \[s]", "stretch")
    for timing in plan.timings:
        token = timing.token
        cells = (f"{value:.2f}" for value in (timing.start, timing.duration, timing.stretch))
        table.add_row(token.gloss or "-", token.kind.name.lower(), *cells)
    return table


def _summary(plan: Plan, robot: Robot) -> str:
    lines = [f"{plan.duration:.2f} s from rest to rest, signs stretched {plan.stretch:.2f} times"]
    if plan.nearest is not None:
        near = plan.nearest
        lines.append(
            f"nearest to itself: {near.distance * 1000.0:.0f} mm between {near.first} and {near.second} "
            f"at {near.time:.2f} s"
        )
    peaks = (
        f"{peak.joint} {peak.torque:.1f} N m ({100.0 * peak.share:.0f} % of its limit, at {peak.time:.2f} s)"
        for peak in peak_torques(plan, robot)[:_SHOWN_TORQUES]
    )
    lines.append(f"most torque, over limits that are placeholders: {', '.join(peaks)}")
    if plan.head:
        gestures = (f"{item.kind.value} {item.start:.2f} .. {item.end:.2f} s" for item in plan.head)
        lines.append(f"head: {', '.join(gestures)}")
    return "\n".join(lines)


def _write(plan: Plan, humanoid: Humanoid, csv: Path | None, mp4: Path | None, strip: Path | None) -> None:
    if csv is not None:
        rows = _write_csv(csv, plan)
        _out.print(f"wrote {csv} ({rows} rows)", highlight=False, markup=False)
    if strip is None and mp4 is None:
        return
    from teo_lut_executor.cli.plan_film import frames, write_film, write_strip  # drawing is an extra

    if strip is not None:
        write_strip(strip, plan, humanoid)
        _out.print(f"wrote {strip}", highlight=False, markup=False)
    if mp4 is not None:
        hidden = not _err.is_terminal
        shown = track(frames(plan), "drawing", console=_err, transient=True, disable=hidden)
        write_film(mp4, plan, humanoid, shown)
        _out.print(f"wrote {mp4}", highlight=False, markup=False)


def _write_csv(path: Path, plan: Plan) -> int:
    """Write a plan as CSV, whole or not at all: time [s], then positions [rad] of each joint.

    Args:
        path: File to write; its folder exists.
        plan: What to write, from 0 s to the first row at rest.

    Returns:
        Number of rows below the header.

    Raises:
        OSError: The file cannot be written.
    """
    rows = math.ceil(plan.duration * _RATE) + 1
    times = np.arange(rows) / _RATE
    positions = sample_at(plan.motions, times).positions
    lines = [",".join(("time", *plan.names))]
    lines += [
        f"{time:.2f}," + ",".join(f"{value:.{_DECIMALS}f}" for value in row)
        for time, row in zip(times.tolist(), positions.tolist(), strict=True)
    ]
    write_atomically(path, ("\n".join(lines) + "\n").encode())
    return rows


def _complain(sentence: str) -> None:
    _err.print(f"plan: {sentence}", style="red", markup=False, highlight=False, soft_wrap=True)


def main() -> None:
    """Run the command line."""
    for stream in (sys.stdout, sys.stderr):
        # Whatever the locale says, glosses go out as UTF-8.
        stream.reconfigure(encoding="utf-8", errors="backslashreplace")  # type: ignore[union-attr]
    app()


if __name__ == "__main__":
    main()
