# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pictures and films of the signs of a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image as PILImage

from teo_common.atomic_files import write_atomically
from teo_description.humanoid import load_humanoid
from teo_description.pictures.rendering import (
    Image,
    camera_named,
    film_strip,
    render_pose,
    save_png,
    write_video,
)
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
