# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pictures and films of the signs of a table.

A sign in one picture is drawn as dictionaries photograph it, to lay beside such a photograph: both its ends,
an arrow along the way of each hand, its head doubled where the hand goes that way again, and rays where a
hand touches.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from io import BytesIO
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image as PILImage
from PIL import ImageOps, UnidentifiedImageError

from teo_common.atomic_files import write_atomically
from teo_description.humanoid import SIDES, Side, load_humanoid
from teo_description.pictures.rendering import (
    Image,
    camera_named,
    film_strip,
    render_pose,
    save_png,
    write_video,
)
from teo_description.robot import Robot
from teo_signs.errors import LutError
from teo_signs.sign import Sign

# Frames of a film a second [Hz].
FRAME_RATE = 25.0

# The robot from the waist up as somebody spoken to sees it, and that person's look at the right hand: cameras
# of the robot's description.
FRONT, CLOSE_UP = "sign", "sign_hand"

#: Width and height of a picture [pixel].
SIZE = (480, 480)

_STRIP_MOMENTS = 6

# Least motion of a joint for which a sign is shown by several moments [rad].
_MOVES = np.radians(3.0)

# Shortest film [s]: a still sign would be over in a blink.
_STILL_FILM = 1.0

_SHEET_COLUMNS = 6
_OVERVIEW_COLUMNS = 16
# Width and height of a sign in the overview [pixel].
_OVERVIEW_SIZE = 150
_OVERVIEW_COLOURS = 128


def pose_at(sign: Sign, time: float) -> dict[str, float]:
    """Positions of the sign's joints at a time from its start [rad], in straight lines between its knots."""
    return {
        joint: float(np.interp(time, sign.times, column))
        for joint, column in zip(sign.joints, sign.knots.T, strict=True)
    }


def render_sign(sign: Sign, time: float, camera: str = FRONT, size: tuple[int, int] = SIZE) -> Image:
    """Draw the sign's robot at a time from the sign's start [s]."""
    view = camera_named(camera, load_humanoid(sign.robot)).sized(*size)
    return render_pose(pose_at(sign, time), view, robot=sign.robot)


def moves(sign: Sign) -> bool:
    """Whether anything moves in a sign."""
    return bool(np.ptp(sign.knots, axis=0).max() > _MOVES)


def save_picture(path: Path, sign: Sign) -> None:
    """Draw a sign: front and close-up, at its middle or, if it moves, at moments spread over it."""
    moments = np.linspace(0.0, sign.duration, _STRIP_MOMENTS) if moves(sign) else [sign.duration / 2.0]
    frames = [render_sign(sign, float(moment), camera) for camera in (FRONT, CLOSE_UP) for moment in moments]
    captions = [f"{sign.gloss}  {moment:.2f} s" for moment in moments] if moves(sign) else [sign.gloss]
    save_png(path, film_strip(frames, captions, columns=max(2, len(moments))))


def save_film(path: Path, sign: Sign) -> int:
    """Film a sign at its own speed, from the front; a short one is held at its end.

    Returns:
        How many frames were written.
    """
    count = 1 + round(max(sign.duration, _STILL_FILM) * FRAME_RATE)
    frames = (render_sign(sign, frame / FRAME_RATE) for frame in range(count))
    return write_video(path, frames, [sign.gloss] * count, frames_per_second=FRAME_RATE)


def save_sheet(path: Path, signs: Iterable[Sign]) -> None:
    """Draw many signs on one sheet, front and close-up of each; a moving one at its beginning and its end."""
    frames: list[Image] = []
    captions: list[str] = []
    for sign in signs:
        for frame, caption in _cells(sign):
            frames.append(frame)
            captions.append(caption)
    save_png(path, film_strip(frames, captions, columns=_SHEET_COLUMNS))


def save_overview(path: Path, signs: Iterable[Sign]) -> None:
    """Draw many signs on one small picture: from the front, each at two moments, in few colours.

    The moments are its beginning and where it is farthest from it: many signs end as they begin.
    """
    size = (_OVERVIEW_SIZE, _OVERVIEW_SIZE)
    frames: list[Image] = []
    captions: list[str] = []
    for sign in signs:
        frames += [render_sign(sign, moment, size=size) for moment in (0.0, _farthest(sign))]
        captions += [sign.gloss, ""]
    sheet = film_strip(frames, captions, columns=_OVERVIEW_COLUMNS)
    # A picture of grey robots needs no 16 million colours, and a page of documentation no 8 MB.
    # Chosen to cover all colours there are: the finger tips' blue is a thousandth of the picture.
    few = PILImage.fromarray(sheet).quantize(
        _OVERVIEW_COLOURS, method=PILImage.Quantize.MAXCOVERAGE, dither=PILImage.Dither.NONE
    )
    written = BytesIO()
    few.save(written, "PNG", optimize=True)
    write_atomically(path, written.getvalue())


def _farthest(sign: Sign) -> float:
    """Time at which a joint is farthest from where it begins; of several, the last [s]."""
    away = np.abs(sign.knots - sign.knots[0]).max(axis=1)
    return float(sign.times[np.flatnonzero(away >= away.max() - 1e-6)[-1]])


def _cells(sign: Sign) -> Iterator[tuple[Image, str]]:
    """One picture of each sign that is still, two of each that moves: front and close-up side by side."""
    moments = [(0.0, "begins"), (sign.duration, "ends")] if moves(sign) else [(sign.duration / 2.0, "")]
    for moment, word in moments:
        pair = [render_sign(sign, moment, camera, (240, 240)) for camera in (FRONT, CLOSE_UP)]
        yield np.hstack(pair), f"{sign.gloss}  {word}".strip()


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
    """Draw both ends of a sign on its robot, the ways between and the touches."""
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
