# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Command: which robots there are, what is known of one, and whether it is true."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import msgspec
import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from teo_common.arrays import Array
from teo_description.errors import DescriptionError
from teo_description.humanoid import available_robots, load_humanoid, robot_folders
from teo_description.kinematic_checks import Finding, frame_checks, hand_checks, limit_checks, symmetry_checks
from teo_description.robot import Robot
from teo_description.space_checks import ArmReach, collision_checks, reach_checks

if TYPE_CHECKING:
    from teo_description.pictures.rendering import Image, Renderer

# How far the camera of the hand map is from the palm, and what it leaves out before it [m]: the own trunk.
_HAND_DISTANCE, _HAND_NEAR = 0.6, 0.4

# No markup: it would swallow units in brackets.
_console = Console(highlight=False, markup=False, soft_wrap=True)
_errors = Console(stderr=True, style="red", highlight=False, markup=False, soft_wrap=True)
_app = typer.Typer(
    add_completion=False, rich_markup_mode=None, help="Robots as data: robots/NAME/robot.yaml."
)
_Name = Annotated[str, typer.Argument(help="Name of a folder with robot.yaml.")]


@_app.command("list")
def _list() -> None:
    """Name the robots that there are and where they are looked for."""
    for name in available_robots():
        try:
            said = load_humanoid(name).file.title
        except DescriptionError as error:
            said = str(error)
        _console.print(f"{name:12} {said}")
    _console.print(f"looked for in {', '.join(map(str, robot_folders()))}")


@_app.command("show")
def _show(name: _Name) -> None:
    """Say what is known of a robot: its joints by limb, with limits and greatest speeds."""
    try:
        humanoid = load_humanoid(name)
        limits = humanoid.limits()
    except DescriptionError as error:
        _fail(error)
    _console.print(f"{humanoid.name}: {humanoid.file.title}")
    _console.print(f"description {humanoid.description_hash[:12]}, {humanoid.urdf_path()}")
    table = Table("limb", "joint", "from [deg]", "to [deg]", "speed [deg/s]")
    for limb, joints in humanoid.limbs.items():
        for joint in joints:
            row = humanoid.columns([joint])[0]
            figures = np.degrees([limits.lower[row], limits.upper[row], limits.velocity[row]])
            table.add_row(limb, joint, *(f"{figure:.0f}" for figure in figures))
    _console.print(table, soft_wrap=False)


@_app.command("links")
def _links(urdf: Annotated[Path, typer.Argument(help="A URDF that has no robot.yaml yet.")]) -> None:
    """Say of each link of a URDF where it is, what moves it, and the box that holds its meshes."""
    from teo_description.urdf_links import describe_links

    try:
        for line in describe_links(urdf):
            _console.print(line)
    except DescriptionError as error:
        _fail(error)


@_app.command("check")
def _check(
    name: _Name,
    out: Annotated[
        Path | None, typer.Option(help="Folder for pictures: each axis of the hand, home and ready.")
    ] = None,
) -> None:
    """Walk through a robot: its frames, axes, mirror symmetry, limits, hands, touch, shapes and reach.

    Exit status: 0 it is fit to sign, 1 it is not.
    """
    try:
        robot = Robot.load(name)
        for line in _frames(robot):
            _console.print(line)
        failed = []
        for finding in _findings(robot):
            _console.print(f"{finding.mark:4} {finding.what}: {finding.measured}")
            if not finding.ok and finding.needed:
                failed.append(finding)
        if out is not None:
            _draw(robot, out)
    except DescriptionError as error:
        _fail(error)
    if failed:
        fields = ", ".join(dict.fromkeys(finding.field for finding in failed))
        sentence = f"{len(failed)} checks failed; look at {fields} in robot.yaml"
        _errors.print(f"robots: {sentence}")
        raise typer.Exit(1)


@_app.command("pose")
def _pose(
    name: _Name,
    palm: Annotated[str, typer.Option(help="Where the right palm is: x,y,z [m].")],
    elbow: Annotated[str, typer.Option(help="Where the right elbow is: x,y,z [m].")],
    fingers: Annotated[str, typer.Option(help="Which way the fingers point: x,y,z.")],
) -> None:
    """Find the arm for a posture, with its mirror image: what `postures` and `detour` want in degrees."""
    try:
        robot = Robot.load(name)
        arm = ArmReach(robot, "right").posture(*(_vector(text) for text in (palm, elbow, fingers)))
    except DescriptionError as error:
        _fail(error)
    humanoid = robot.humanoid
    signs = humanoid.mirror_signs(list(arm))
    image = {humanoid.mirrored_name(n): x * s for (n, x), s in zip(arm.items(), signs.tolist(), strict=True)}
    for posture in (arm, image):
        for joint, angle in posture.items():
            _console.print(f"{joint}: {math.degrees(angle):.0f}.0")
    placed = robot.placement(robot.configuration({**arm, **image}), humanoid.file.hand.palm)[:3, 3]
    nearest = robot.clearance(robot.configuration({**arm, **image}))
    _console.print(
        f"palm at {', '.join(f'{x:.2f}' for x in placed)}; {nearest.first} and {nearest.second} are "
        f"{nearest.distance * 1e3:.0f} mm apart"
    )


def _vector(text: str) -> Array:
    try:
        x, y, z = (float(number) for number in text.split(","))
    except ValueError as error:
        raise DescriptionError("bad_point", f"expected x,y,z, got {text!r}") from error
    return np.array([x, y, z])


def _frames(robot: Robot) -> Iterator[str]:
    """Where the frames are that the file names, at home."""
    hand, collision = robot.humanoid.file.hand, robot.humanoid.file.collision
    parts = msgspec.structs.asdict(collision.right_arm)
    asked = {
        "hand.palm": (hand.palm,),
        **{f"hand.fingers.{name}": frames for name, frames in hand.fingers.items()},
        "hand.thumb": hand.thumb,
        **{f"collision.right_arm.{part}": links for part, links in parts.items()},
        "collision.torso": collision.torso,
    }
    yield "frames at home: place in base_link [m], and where their x and z point"
    q = robot.configuration({})
    for field, names in asked.items():
        for name, pose in zip(names, robot.placements(q, names), strict=True):
            place, x, z = (
                ", ".join(f"{value:.{digits}f}" for value in pose[:3, column])
                for column, digits in ((3, 3), (0, 2), (2, 2))
            )
            yield f"{field:29} {name:28} at ({place}), x ({x}), z ({z})"


def _findings(robot: Robot) -> Iterator[Finding]:
    from teo_description.shape_checks import shape_checks  # here: a second that listing does without

    checks = (frame_checks, symmetry_checks, limit_checks, hand_checks, collision_checks, shape_checks)
    for check in (*checks, reach_checks):
        yield from check(robot)


def _draw(robot: Robot, folder: Path) -> None:
    # Here: listing needs no OpenCV.
    from teo_description.pictures.rendering import Renderer, film_strip, save_png

    renderer, humanoid = Renderer(robot), robot.humanoid
    folder.mkdir(parents=True, exist_ok=True)
    ready = dict(zip(humanoid.commanded_joints, humanoid.ready.tolist(), strict=True))
    views = [({}, "front"), (ready, "front"), (ready, "full"), (ready, "hand")]
    frames = [renderer.render(positions, camera) for positions, camera in views]
    save_png(folder / "postures.png", film_strip(frames, ["home", *("ready",) * 3], 4))
    save_png(folder / "hand.png", _hand_sheet(robot, renderer))
    _console.print(f"wrote postures.png and hand.png in {folder}")


def _hand_sheet(robot: Robot, renderer: Renderer) -> Image:
    """The hand map: a row for each axis of the right hand, from its lower limit to its upper one.

    The others are at their lower limits, the arms away from the body; the hand is seen from before its palm
    and from the thumb's side.
    """
    from teo_description.pictures.rendering import Camera, film_strip

    humanoid = robot.humanoid
    names = humanoid.hand("right")
    limits = humanoid.limits(names)
    apart = humanoid.with_both_arms(humanoid.hanging, humanoid.file.detour.apart_deg)
    away = dict(zip(humanoid.commanded_joints, apart.tolist(), strict=True))
    palm = robot.placement(robot.configuration(away), humanoid.file.hand.palm)
    towards = palm[:3, 2] - 0.5 * palm[:3, 1]
    middle = palm[:3, :3] @ np.array([0.04, 0.0, 0.0])
    eye = middle + _HAND_DISTANCE * towards / np.linalg.norm(towards)
    camera = Camera(
        position=(float(eye[0]), float(eye[1]), float(eye[2])),
        target=(float(middle[0]), float(middle[1]), float(middle[2])),
        field_of_view=math.radians(26.0),
        size=(260, 260),
        near=_HAND_NEAR,
        follows=humanoid.file.hand.palm,
    )
    straight = away | dict(zip(names, limits.lower.tolist(), strict=True))
    frames, captions = [], []
    for name, low, high in zip(names, limits.lower.tolist(), limits.upper.tolist(), strict=True):
        for share in (0.0, 0.5, 1.0):
            value = low + share * (high - low)
            frames.append(renderer.render({**straight, name: value}, camera))
            captions.append(f"{name} {math.degrees(value):.0f}°")
    return film_strip(frames, captions, 6)


def _fail(error: DescriptionError) -> NoReturn:
    _errors.print(f"robots: {error.code}: {error}")
    raise typer.Exit(1) from error


def main() -> None:
    """Entry point of ``robots``."""
    _app()
