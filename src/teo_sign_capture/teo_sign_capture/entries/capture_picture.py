# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Demonstration and robot side by side: what a teacher looks at before trusting an entry."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import cv2
import numpy as np

from teo_common.arrays import Array
from teo_description.pictures.rendering import Image, film_strip, save_png, write_video
from teo_sign_capture.entries.sign_entry import Captured
from teo_sign_capture.entries.take import SignTake
from teo_sign_capture.recordings.colour_images import colour_images, video_pictures
from teo_sign_capture.recordings.recording import Recording, skeletons_of
from teo_signs.pictures import FRAME_RATE, render_sign

_MOMENTS = 7
# [px] Width and height of each picture: seven beside each other are as wide as a screen.
_SIZE = (320, 240)
# [px/m] The drawn person fills the height from hands that hang to hands above the head.
_SCALE = 0.8 * _SIZE[1]
# [px] Where the origin of the person's axes is drawn, between the shoulders.
_MIDDLE = (_SIZE[0] // 2, int(0.42 * _SIZE[1]))
_PAPER, _INK, _RIGHT, _LEFT = (250, 250, 252), (70, 75, 85), (200, 60, 40), (40, 90, 190)
_TRUNK = ((2, 5), (2, 9), (5, 12), (9, 12), (1, 0), (0, 15), (0, 16), (15, 17), (16, 18))
_ARMS = {"right": ((2, 3), (3, 4)), "left": ((5, 6), (6, 7))}
_FINGERS = tuple(
    (0 if bone == 0 else 4 * finger + bone, 4 * finger + bone + 1) for finger in range(5) for bone in range(4)
)

# Draws the demonstration at a time from the beginning of the stroke [s].
_Drawer = Callable[[float], Image]


def save_capture_picture(path: Path, captured: Captured, recording: Recording | None, cache: Path) -> None:
    """Draw moments of the demonstration over the same moments of the robot.

    Args:
        path: PNG file to write, whole or not at all.
        captured: The sign.
        recording: The bag of the take that leads; None draws its keypoints, for there are no images.
        cache: Where skeletons found in its images are.
    """
    take, sign = captured.take, captured.sign
    draw = _drawer(take, recording, cache)
    last = float(take.track.times[-1])
    shares = np.linspace(0.0, 1.0, _MOMENTS)
    above = [draw(share * last) for share in shares]
    below = [render_sign(sign, share * sign.duration, size=_SIZE) for share in shares]
    captions = [f"{take.source}  {take.span.start + share * last:.2f} s" for share in shares]
    captions += [f"{sign.robot}: {sign.gloss}  {share * sign.duration:.2f} s" for share in shares]
    save_png(path, film_strip(above + below, captions, columns=_MOMENTS))


def save_capture_film(path: Path, captured: Captured, recording: Recording | None, cache: Path) -> int:
    """Film demonstration and robot beside each other, at the speed of the demonstration.

    Returns:
        How many frames were written.
    """
    take, sign = captured.take, captured.sign
    draw = _drawer(take, recording, cache)
    last = float(take.track.times[-1])
    shares = np.linspace(0.0, 1.0, 1 + max(1, round(last * FRAME_RATE)))
    frames = (
        np.hstack([draw(share * last), render_sign(sign, share * sign.duration, size=_SIZE)])
        for share in shares
    )
    return write_video(path, frames, [sign.gloss] * len(shares), frames_per_second=FRAME_RATE)


def _drawer(take: SignTake, recording: Recording | None, cache: Path) -> _Drawer:
    start = take.span.start
    end = start + float(take.track.times[-1])
    if recording is None or (recording.is_flat and recording.has_skeletons):
        return lambda time: _draw_person(take, time)
    if recording.is_flat:
        images = video_pictures(recording.path, start=start, end=end, size=_SIZE)
    else:
        skeletons = skeletons_of(recording, cache)
        images = colour_images(recording.path, skeletons, start=start, end=end, size=_SIZE)
    if not images:
        return lambda time: _draw_person(take, time)
    times = np.array([when for when, _ in images])
    return lambda time: images[int(np.argmin(np.abs(times - time)))][1]


def _draw_person(take: SignTake, time: float) -> Image:
    """The keypoints of a take at a time, as from the front: the person's left is on the right."""
    frame = int(np.argmin(np.abs(take.track.times - time)))
    picture = np.full((_SIZE[1], _SIZE[0], 3), _PAPER, np.uint8)
    body = take.track.body.positions[frame]
    _lines(picture, body, _TRUNK, _INK, 2)
    for side, colour in (("right", _RIGHT), ("left", _LEFT)):
        _lines(picture, body, _ARMS[side], colour, 2)
        _lines(picture, take.track.hand(side).positions[frame], _FINGERS, colour, 1)
    return picture


def _lines(
    picture: Image, points: Array, bones: Sequence[tuple[int, int]], colour: tuple[int, int, int], width: int
) -> None:
    for first, second in bones:
        ends = points[[first, second]]
        if np.isfinite(ends).all():
            pixels = [
                (round(_MIDDLE[0] + _SCALE * float(y)), round(_MIDDLE[1] - _SCALE * float(z)))
                for _, y, z in ends
            ]
            cv2.line(picture, pixels[0], pixels[1], colour, width, cv2.LINE_AA)
