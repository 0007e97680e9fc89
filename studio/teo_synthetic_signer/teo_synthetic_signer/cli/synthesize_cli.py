# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`synthesize`: a rendered person who signs, as a ROS 2 bag with the truth in it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from teo_synthetic_signer.body.body_shapes import BODIES
from teo_synthetic_signer.camera.renderer import LIGHTS
from teo_synthetic_signer.camera.sensors import SENSORS
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.scripts import SCRIPTS, about
from teo_synthetic_signer.take.furniture import SCENES
from teo_synthetic_signer.take.take import Companion, Take, TakeOptions
from teo_synthetic_signer.take.take_files import FILM_SUFFIX, JPEG_QUALITY, write_film, write_take

_DEFAULTS = TakeOptions()
# A hand that is nearer than this to its place is there [m].
_WORTH_SAYING = 0.02
_out = Console()
_err = Console(stderr=True)
_app = typer.Typer(add_completion=False, rich_markup_mode=None)


@_app.command()
def _synthesize(
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder of the bag, to be made; or a film (.mp4) of the colour images alone.",
            show_default=False,
        ),
    ] = None,
    script: Annotated[
        str, typer.Option(help="What the person does: a name, see --list, or a script's file (.yaml).")
    ] = _DEFAULTS.script,
    body: Annotated[str, typer.Option(help="Who; see --list.")] = _DEFAULTS.body,
    scene: Annotated[str, typer.Option(help="What is around; see --list.")] = _DEFAULTS.scene,
    sensor: Annotated[str, typer.Option(help="What measures; see --list.")] = _DEFAULTS.sensor,
    distance: Annotated[float, typer.Option(help="From the camera to the person [m].")] = _DEFAULTS.distance,
    camera_height: Annotated[
        float, typer.Option(help="Of the camera above the floor [m].")
    ] = _DEFAULTS.camera_height,
    camera_pitch: Annotated[
        float | None, typer.Option(help="Of the camera downwards [deg]; looks at the chest if not given.")
    ] = None,
    camera_roll: Annotated[float, typer.Option(help="Of the camera about its view [deg].")] = 0.0,
    light: Annotated[str, typer.Option(help=f"One of {', '.join(LIGHTS)}.")] = _DEFAULTS.light,
    companion: Annotated[
        list[str] | None,
        typer.Option(help="BODY,SCRIPT,BEHIND,ASIDE of somebody else, to the signer's left [m]. Repeatable."),
    ] = None,
    size: Annotated[str, typer.Option(help="Columns x rows of the images [px].")] = "640x480",
    rate: Annotated[float, typer.Option(help="Frames per second [Hz].")] = _DEFAULTS.rate,
    seed: Annotated[int, typer.Option(min=0, help="Of the noise; the same gives the same bag.")] = 0,
    frames: Annotated[int, typer.Option(min=0, help="Only the first frames; 0 for all.")] = 0,
    truth_only: Annotated[
        bool, typer.Option("--truth-only", help="Only /truth/skeletons, no images: a third of the time.")
    ] = False,
    raw: Annotated[bool, typer.Option("--raw", help="Do not compress images.")] = False,
    jpeg_quality: Annotated[int, typer.Option(min=1, max=100, help="Of the colour images.")] = JPEG_QUALITY,
    perfect_depth: Annotated[
        bool, typer.Option("--perfect-depth", help="Depth without noise, holes or range.")
    ] = False,
    listing: Annotated[bool, typer.Option("--list", help="Print what there is to choose from.")] = False,
) -> None:
    """Render a person who signs to RGB-D, with the true place of every keypoint in /truth/skeletons.

    Exit status: 0 if the bag is written, 1 if it could not be, 2 for wrong options.
    """
    if listing:
        _print_choices()
        return
    if out is None:
        raise typer.BadParameter("expected a folder for the bag: --out FOLDER")
    width, height = parsed_size(size)
    try:
        options = TakeOptions(
            script=script,
            body=body,
            scene=scene,
            sensor=sensor,
            distance=distance,
            camera_height=camera_height,
            camera_pitch=None if camera_pitch is None else math.radians(camera_pitch),
            camera_roll=math.radians(camera_roll),
            light=light,
            companions=tuple(map(_companion, companion or [])),
            width=width,
            height=height,
            rate=rate,
            seed=seed,
            perfect_depth=perfect_depth,
        )
        take = Take(options)
    except SyntheticError as error:
        raise typer.BadParameter(error.sentence) from None
    count = min(frames, len(take)) if frames else len(take)
    rendered = (take.truth(i) if truth_only else take.frame(i) for i in range(count))
    columns = (TextColumn("rendering"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    try:
        with Progress(*columns, console=_err) as progress:
            task = progress.add_task("", total=count)
            if out.suffix == FILM_SUFFIX:
                written = write_film((take.frame(i) for i in range(count)), out)
            else:
                written = write_take(
                    rendered, out, raw=raw, truth_only=truth_only, quality=jpeg_quality, about=take.about_it
                )
            for number in written:
                progress.update(task, completed=number)
    except SyntheticError as error:
        _err.print(f"synthesize: {error}", style="red", markup=False, highlight=False)
        raise typer.Exit(1) from None
    if take.motion.shortfall > _WORTH_SAYING:
        _err.print(
            f"synthesize: hands stay up to {100.0 * take.motion.shortfall:.0f} cm off places out of reach",
            markup=False,
            highlight=False,
        )
    files = out.iterdir() if out.is_dir() else (out,)
    megabytes = sum(file.stat().st_size for file in files) / 1e6
    _out.print(
        f"{out}: {count} frames, {count / rate:.1f} s, {megabytes:.1f} MB",
        highlight=False,
        markup=False,
        soft_wrap=True,
    )


def _companion(words: str) -> Companion:
    parts = words.split(",")
    try:
        body, script, behind, aside = parts
        return Companion(body=body, script=script, behind=float(behind), aside=float(aside))
    except ValueError:
        raise typer.BadParameter(
            f"--companion: expected BODY,SCRIPT,BEHIND,ASIDE such as man_tall,still,0.5,0.8, got {words!r}"
        ) from None


def parsed_size(size: str) -> tuple[int, int]:
    """Read "columns x rows" of images [px]."""
    width, cross, height = size.lower().partition("x")
    if not (cross and width.isdigit() and height.isdigit()):
        raise typer.BadParameter(f"--size: expected columns x rows such as 640x480, got {size!r}")
    return int(width), int(height)


def _print_choices() -> None:
    scripts = Table("script", "what happens")
    for name in SCRIPTS:
        scripts.add_row(name, about(name))
    sensors = Table("sensor", "device", "depth [m]", "error at 1.0 / 1.5 / 2.5 m [mm]")
    for name, device in SENSORS.items():
        errors = " / ".join(
            f"{1000.0 * device.sigma(z):.1f}" if device.nearest <= z <= device.farthest else "-"
            for z in (1.0, 1.5, 2.5)
        )
        sensors.add_row(name, device.label, f"{device.nearest:g} to {device.farthest:g}", errors)
    _out.print(scripts, f"bodies: {', '.join(BODIES)}", f"scenes: {', '.join(SCENES)}", sensors)


def main() -> None:
    """Run `synthesize`."""
    _app()


if __name__ == "__main__":
    main()
