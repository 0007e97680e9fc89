# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Demonstration and robot side by side: what a teacher looks at before trusting an entry."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from teo_common.arrays import Array
from teo_description.pictures.rendering import Image, film_strip, save_png, write_video
from teo_sign_capture.entries.sign_entry import Captured
from teo_sign_capture.entries.take import SignTake
from teo_sign_capture.recordings.recording import Recording, skeletons_of
from teo_sign_capture.recordings.skeleton_bag import TYPE, open_bag
from teo_sign_capture.recordings.video import video_images
from teo_signs.pictures import FRAME_RATE, render_sign

_MOMENTS = 7
# [px] Width and height of each picture: seven beside each other are as wide as a screen.
_SIZE = (320, 240)
_WIDTH, _HEIGHT = _SIZE
# [px/m] The drawn person fills the height from hands that hang to hands above the head.
_SCALE = 0.8 * _HEIGHT
# [px] Where the origin of the person's axes is drawn, between the shoulders.
_MIDDLE = (_WIDTH // 2, int(0.42 * _HEIGHT))
_PAPER, _INK, _RIGHT, _LEFT = (250, 250, 252), (70, 75, 85), (200, 60, 40), (40, 90, 190)
_TRUNK = ((2, 5), (2, 9), (5, 12), (9, 12), (1, 0), (0, 15), (0, 16), (15, 17), (16, 18))
_ARMS = {"right": ((2, 3), (3, 4)), "left": ((5, 6), (6, 7))}
_FINGERS = tuple(
    (0 if bone == 0 else 4 * finger + bone, 4 * finger + bone + 1) for finger in range(5) for bone in range(4)
)

# Draws the demonstration at a time from the beginning of the stroke [s].
_Drawer = Callable[[float], Image]


def save_capture_picture(path: Path, captured: Captured, recording: Recording, cache: Path) -> None:
    """Draw moments of the demonstration over the same moments of the robot.

    Args:
        path: PNG file to write, whole or not at all.
        captured: The sign.
        recording: Of the take that leads; where it has no images, its keypoints are drawn.
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


def save_capture_film(path: Path, captured: Captured, recording: Recording, cache: Path) -> None:
    """Film demonstration and robot beside each other, at the speed of the demonstration, into an MP4 file.

    Arguments are those of `save_capture_picture`.
    """
    take, sign = captured.take, captured.sign
    draw = _drawer(take, recording, cache)
    last = float(take.track.times[-1])
    shares = np.linspace(0.0, 1.0, 1 + max(1, round(last * FRAME_RATE)))
    frames = (
        np.hstack([draw(share * last), render_sign(sign, share * sign.duration, size=_SIZE)])
        for share in shares
    )
    write_video(path, frames, [sign.gloss] * len(shares), frames_per_second=FRAME_RATE)


def _drawer(take: SignTake, recording: Recording, cache: Path) -> _Drawer:
    start = take.span.start
    end = start + float(take.track.times[-1])
    images: list[_Timed] = []
    if not recording.is_flat:
        images = _colour_images(recording.path, skeletons_of(recording, cache), start, end)
    elif not recording.has_skeletons:
        images = _video_pictures(recording.path, start, end)
    if not images:
        return lambda time: _draw_person(take, time)
    times = np.array([when for when, _ in images])
    return lambda time: images[int(np.argmin(np.abs(times - time)))][1]


def _draw_person(take: SignTake, time: float) -> Image:
    """The keypoints of a take at a time, as from the front: the person's left is on the right."""
    frame = int(np.argmin(np.abs(take.track.times - time)))
    picture = np.full((_HEIGHT, _WIDTH, 3), _PAPER, np.uint8)
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


# [s] An image this far outside the stroke still shows its beginning or end: three images at 30 Hz.
_NEAREST = 0.1
# Margin around the keypoints, as a share of the width of the shoulders: from the nose to the crown and a
# little more.
_MARGIN = 0.45
# Nose, right shoulder, elbow and wrist, left shoulder, elbow and wrist in BODY_25.
_UPPER_BODY = (0, 2, 3, 4, 5, 6, 7)
# An image, and its time from the beginning of the stroke [s].
_Timed = tuple[float, Image]


class _Seen(NamedTuple):
    """The person in the images: stamp from which a track's times count [ns], and what the keypoints span.

    `low` and `high` are the corners of that [px], with a margin; NaN if nothing was seen.
    """

    first: int
    low: Array
    high: Array


def _colour_images(bag: Path, skeletons: Path, start: float, end: float) -> list[_Timed]:
    """Colour images of a bag from when to when [s], cut out around the person; nothing where it has none.

    Times count from the first message of the bag of its skeletons.
    """
    # Only who draws needs the code that reads cameras' images.
    from teo_skeleton_retriever.bags.bag_images import choose_topics
    from teo_skeleton_retriever.bags.bag_reader import Bag
    from teo_skeleton_retriever.camera.rgbd_image import color_of, stamp_of
    from teo_skeleton_retriever.errors import RetrieverError

    opened = Bag(bag)
    try:
        topic = choose_topics(opened).color
    except RetrieverError:
        return []
    seen = _seen(skeletons, start, end)
    images: list[_Timed] = []
    for found in opened.messages([topic]):
        time = (stamp_of(found.message) - seen.first) * 1e-9 - start
        if -_NEAREST <= time <= end - start + _NEAREST:
            images.append((time, _fitted(_around(color_of(found.message), seen))))
    return images


def _video_pictures(video: Path, start: float, end: float) -> list[_Timed]:
    """Whole images of a video from when to when [s]."""
    images: list[_Timed] = []
    for when, image in video_images(video):
        if when > end + _NEAREST:
            break
        if when >= start - _NEAREST:
            images.append((when - start, _fitted(image)))
    return images


def _fitted(image: Image) -> Image:
    """The whole image in the size of a picture, with paper beside it where the shapes differ."""
    height, width = image.shape[:2]
    share = min(_WIDTH / width, _HEIGHT / height)
    small = cv2.resize(image, (round(width * share), round(height * share)), interpolation=cv2.INTER_AREA)
    picture = np.full((_HEIGHT, _WIDTH, 3), _PAPER, np.uint8)
    top, left = (_HEIGHT - small.shape[0]) // 2, (_WIDTH - small.shape[1]) // 2
    picture[top : top + small.shape[0], left : left + small.shape[1]] = small
    return picture


def _around(image: Image, seen: _Seen) -> Image:
    """The part of an image that shows the person, in the shape of a picture."""
    if not np.isfinite([seen.low, seen.high]).all():
        return image
    height, width = image.shape[:2]
    middle, span = (seen.low + seen.high) / 2.0, seen.high - seen.low
    rows = min(max(span[1], span[0] * _HEIGHT / _WIDTH), height, width * _HEIGHT / _WIDTH)
    half = np.array([rows * _WIDTH / _HEIGHT, rows]) / 2.0
    middle = np.clip(middle, half, np.maximum(np.array([width, height]) - half, half))
    left, top = np.maximum(np.round(middle - half), 0).astype(int)
    right, bottom = np.round(middle + half).astype(int)
    return image[top:bottom, left:right]


def _seen(skeletons: Path, start: float, end: float) -> _Seen:
    first = 0
    bodies: list[list[list[float]]] = []
    bag = open_bag(skeletons)
    for found in bag.messages([topic for topic, kind in bag.kinds.items() if kind == TYPE]):
        message = found.message
        stamp = message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec
        first = first or stamp
        if not start <= (stamp - first) * 1e-9 <= end:
            continue
        bodies += [
            [list(skeleton.body[index].pixel) for index in _UPPER_BODY]
            for skeleton in message.skeletons
            if skeleton.is_signer and skeleton.body
        ]
    pixels = np.array(bodies, dtype=float).reshape(-1, len(_UPPER_BODY), 2)
    nothing = np.full((1, *pixels.shape[1:]), np.nan)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # keypoints that were never seen
        middle = np.nanmedian(np.concatenate([pixels, nothing]), axis=0)
        margin = _MARGIN * np.linalg.norm(middle[1] - middle[4])
        low, high = (
            reduce(np.concatenate([pixels, nothing]), axis=(0, 1)) for reduce in (np.nanmin, np.nanmax)
        )
    return _Seen(first, low - margin, high + margin)
