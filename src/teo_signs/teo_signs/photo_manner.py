# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A sign in one picture, as dictionaries photograph it, to lay beside such a photograph.

Both ends of the sign in one picture, an arrow along the way of each hand, its head doubled where the hand
goes that way again, and rays where a hand touches.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image as PILImage
from PIL import ImageOps, UnidentifiedImageError

from teo_description.humanoid import SIDES, Side
from teo_description.pictures.rendering import Image, camera_named, film_strip, save_png
from teo_description.robot import Robot
from teo_signs.errors import LutError
from teo_signs.pictures import FRONT, SIZE, pose_at, render_sign
from teo_signs.sign import Sign

# Pairs of a photograph and a robot beside each other.
_COLUMNS = 3

# Moments at which a sign is looked at, beside its knots: a hand that swings out between them is seen.
_MOMENTS = 30
# A way shorter than this is the hand turning in its place: no arrow [pixel].
_SHORTEST_WAY = 10.0
# A hand that has gone back by half of its way and comes this near to its end goes that way again.
_BACK, _AGAIN = 0.5, 0.7
# Signs keep 12 mm between parts that touch in a person's [m]: what is nearer than twice that is a touch.
_TOUCH = 0.024
# How much of the beginning is seen through the end.
_BEGINNING = 0.4
_WHITE, _BLACK = (255, 255, 255), (0, 0, 0)


def in_one_picture(robot: Robot, sign: Sign) -> Image:
    """Draw both ends of a sign, the ways between and the touches.

    Args:
        robot: The sign's robot.
        sign: The sign.
    """
    camera = camera_named(FRONT, robot.humanoid).sized(*SIZE)
    begins, ends = render_sign(sign, 0.0), render_sign(sign, sign.duration)
    picture: Image = np.ascontiguousarray(cv2.addWeighted(begins, _BEGINNING, ends, 1.0 - _BEGINNING, 0.0))
    for side in SIDES:
        _draw_way(picture, camera.pixels(_palm_way(robot, sign, side)))
    for point in _touches(robot, sign):
        _draw_rays(picture, camera.pixels(point[None])[0])
    return picture


def save_comparison(path: Path, pairs: Sequence[tuple[Sign, Path]]) -> None:
    """Lay signs beside pictures: a sheet of photograph and robot, photograph and robot.

    Args:
        path: A PNG file.
        pairs: Each sign and the file of its picture.

    Raises:
        LutError: "bad_picture" if a file is no picture.
    """
    cells: list[Image] = []
    captions: list[str] = []
    robots: dict[str, Robot] = {}
    for sign, file in pairs:
        robot = robots.setdefault(sign.robot, Robot.load(sign.robot))
        cells += [_picture(file), in_one_picture(robot, sign)]
        captions += [file.stem, f"{sign.gloss}  {sign.duration:.1f} s  {sign.provenance.standing}"]
    save_png(path, film_strip(cells, captions, columns=2 * _COLUMNS))


def _picture(file: Path) -> Image:
    """A picture on white, as large as fits a cell."""
    try:
        with PILImage.open(file) as opened:
            upright = ImageOps.exif_transpose(opened).convert("RGBA")
    except (OSError, UnidentifiedImageError, PILImage.DecompressionBombError) as error:
        raise LutError("bad_picture", f"{file}: expected a picture (PNG, JPEG, ...), got: {error}") from error
    on_white = PILImage.new("RGBA", upright.size, "white")
    on_white.alpha_composite(upright)
    return np.asarray(ImageOps.pad(on_white.convert("RGB"), SIZE, color="white"))


def _moments(sign: Sign) -> Iterator[dict[str, float]]:
    for time in np.union1d(sign.times, np.linspace(0.0, sign.duration, _MOMENTS)):
        yield pose_at(sign, float(time))


def _palm_way(robot: Robot, sign: Sign, side: Side) -> NDArray[np.float64]:
    """Where a palm is at every moment [m]. Shape (moments, 3)."""
    frame = robot.humanoid.file.hand.palm
    frame = frame if side == "right" else robot.humanoid.mirrored_name(frame)
    return np.array([robot.placement(robot.configuration(pose), frame)[:3, 3] for pose in _moments(sign)])


def _touches(robot: Robot, sign: Sign) -> Iterator[NDArray[np.float64]]:
    """Where a hand touches the body or the other hand: of each pair of parts, when they are nearest [m]."""
    nearest: dict[tuple[str, str], tuple[float, NDArray[np.float64]]] = {}
    for pose in _moments(sign):
        for contact in robot.contacts(robot.configuration(pose), _TOUCH):
            pair = contact.first, contact.second
            if contact.may_be_meant and contact.distance < nearest.get(pair, (np.inf,))[0]:
                nearest[pair] = contact.distance, (contact.first_point + contact.second_point) / 2.0
    for _, point in nearest.values():
        yield point


def _draw_way(picture: Image, way: NDArray[np.float64]) -> None:
    """An arrow from the beginning to where the hand is farthest from it for the first time."""
    away = np.linalg.norm(way - way[0], axis=1)
    farthest = float(away.max())
    if farthest < _SHORTEST_WAY:
        return
    end = int(np.flatnonzero(away >= 0.98 * farthest)[0])
    back = np.flatnonzero(away[end:] < _BACK * farthest)
    again = bool(len(back)) and float(away[end + back[0] :].max()) > _AGAIN * farthest
    along = way[: end + 1].round().astype(np.int32)
    for colour, thickness in ((_BLACK, 6), (_WHITE, 3)):
        cv2.polylines(
            picture, [along], isClosed=False, color=colour, thickness=thickness, lineType=cv2.LINE_AA
        )
    before = way[max(0, int(np.flatnonzero(away[: end + 1] <= 0.8 * farthest)[-1]))]
    forward = (way[end] - before) / max(float(np.linalg.norm(way[end] - before)), 1e-6)
    for head in range(1 + again):
        _draw_head(picture, way[end] - 9.0 * head * forward, forward)


def _draw_head(picture: Image, tip: NDArray[np.float64], forward: NDArray[np.float64]) -> None:
    aside = np.array([-forward[1], forward[0]])
    corners = np.array(
        [tip + 6.0 * forward, tip - 8.0 * forward + 8.0 * aside, tip - 8.0 * forward - 8.0 * aside]
    )
    shape = [corners.round().astype(np.int32)]
    cv2.fillPoly(picture, shape, _WHITE, lineType=cv2.LINE_AA)
    cv2.polylines(picture, shape, isClosed=True, color=_BLACK, thickness=2, lineType=cv2.LINE_AA)


def _draw_rays(picture: Image, at: NDArray[np.float64]) -> None:
    for angle in np.radians(np.arange(0, 360, 45)):
        way = np.array([np.cos(angle), np.sin(angle)])
        ends = [(at + reach * way).round().astype(int).tolist() for reach in (9.0, 17.0)]
        for colour, thickness in ((_BLACK, 4), (_WHITE, 2)):
            cv2.line(picture, ends[0], ends[1], colour, thickness, cv2.LINE_AA)
