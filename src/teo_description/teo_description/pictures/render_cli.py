# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Command: draw a pose of a robot, or a planned motion as a film and a film strip."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.progress import track

from teo_description.errors import DescriptionError
from teo_description.humanoid import Humanoid
from teo_description.motion_files import Motion, read_motion, read_pose
from teo_description.pictures.camera import Camera, camera_named
from teo_description.pictures.rendering import MotionVideo, Renderer, film_strip, save_png
from teo_description.robot import Robot

_console = Console(stderr=True)
# No markup in the help: it would swallow units in brackets.
_app = typer.Typer(add_completion=False, rich_markup_mode=None)


@_app.command()
def _render(
    more: Annotated[
        list[str] | None,
        typer.Argument(metavar="POSE", help="More of the pose, as for --pose.", show_default=False),
    ] = None,
    pose: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|NAME=VALUE",
            help="Pose: a JSON file of joint positions [rad], or NAME=VALUE [rad] (or NAME=90deg). "
            "Joints not named are at home.",
        ),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="PNG of the pose.")] = None,
    csv: Annotated[
        Path | None, typer.Option(help="Motion: header, then time [s] and a column of [rad] per joint.")
    ] = None,
    mp4: Annotated[Path | None, typer.Option(help="Film of the motion, H.264.")] = None,
    strip: Annotated[Path | None, typer.Option(help="PNG with moments of the motion side by side.")] = None,
    camera: Annotated[
        str, typer.Option(help="front (upper body and face), hand (the right one, near) or full.")
    ] = "front",
    size: Annotated[str, typer.Option(help="Width and height of a picture [pixel].")] = "640x480",
    fps: Annotated[float, typer.Option(help="Frames per second of the film.")] = 25.0,
    moments: Annotated[
        int, typer.Option(min=1, max=200, help="Pictures on the strip, evenly spread over the motion.")
    ] = 12,
    columns: Annotated[int, typer.Option(min=1, max=50, help="Pictures a row on the strip.")] = 6,
    robot: Annotated[str, typer.Option(help="Name of a folder with robot.yaml; see `robots list`.")] = "teo",
) -> None:
    """Draw a pose to a PNG, or a motion to a film and a film strip.

    Examples: render --pose pose.json NAME=-90deg OTHER=1.2 --out pose.png;
    render --csv plan.csv --mp4 motion.mp4 --strip motion.png --camera hand
    """
    try:
        renderer = Renderer(Robot.load(robot))
        view = _view(camera, size, renderer.humanoid)
        if csv is not None:
            if pose or more or out:
                raise DescriptionError("bad_options", "expected either --csv or a pose with --out, got both")
            _render_motion(renderer, csv, mp4, strip, view, fps, moments, columns)
        elif out is not None:
            if mp4 or strip:
                raise DescriptionError(
                    "bad_options", "expected --csv with --mp4 and --strip; a pose goes to --out"
                )
            positions = read_pose([*(pose or ()), *(more or ())], renderer.humanoid)
            save_png(out, renderer.render(positions, view))
            _console.print(f"wrote {out}", highlight=False)
        else:
            raise DescriptionError(
                "bad_options", "expected --out FILE for a pose, or --csv FILE with --mp4 or --strip"
            )
    except DescriptionError as error:
        _complain(str(error))
        raise typer.Exit(2 if error.code == "bad_options" else 1) from error
    except OSError as error:
        _complain(f"cannot write {error.filename}: {error.strerror}")
        raise typer.Exit(1) from error


def _complain(sentence: str) -> None:
    _console.print(f"render: {sentence}", style="red", markup=False, highlight=False, soft_wrap=True)


def _view(camera: str, size: str, humanoid: Humanoid) -> Camera:
    parts = re.fullmatch(r"(\d{1,5})x(\d{1,5})", size)
    if parts is None:
        raise DescriptionError("bad_options", f"expected a size as 640x480, got {size!r}")
    return camera_named(camera, humanoid).sized(int(parts[1]), int(parts[2]))


def _render_motion(
    renderer: Renderer,
    csv: Path,
    mp4: Path | None,
    strip: Path | None,
    view: Camera,
    fps: float,
    moments: int,
    columns: int,
) -> None:
    if mp4 is None and strip is None:
        raise DescriptionError("bad_options", "expected --mp4 or --strip, or both, with --csv")
    motion = read_motion(csv, renderer.humanoid)
    if mp4 is not None:
        _film(motion, renderer, mp4, view, fps)
        _console.print(f"wrote {mp4} ({motion.duration:.2f} s)", highlight=False)
    if strip is not None:
        count = moments if motion.duration > 0.0 else 1
        times = np.linspace(0.0, motion.duration, count)
        frames = [renderer.render(motion.at(time), view) for time in times]
        save_png(strip, film_strip(frames, [f"{time:.2f} s" for time in times], columns))
        _console.print(f"wrote {strip}", highlight=False)


def _film(motion: Motion, renderer: Renderer, mp4: Path, view: Camera, fps: float) -> None:
    with MotionVideo(mp4, frames_per_second=fps) as video:
        # The last pose is shown too, hence one frame more than fit.
        count = int(np.ceil(motion.duration * fps)) + 1
        hidden = not _console.is_terminal
        for index in track(range(count), "drawing", console=_console, transient=True, disable=hidden):
            video.add(renderer.render(motion.at(index / fps), view))


def main() -> None:
    """Entry point of ``render``."""
    _app()
