# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the camera saw while a sign was made, near enough to see the hands."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
from rosbags.highlevel import AnyReader

from teo_common.arrays import Array
from teo_description.pictures.rendering import Image
from teo_sign_capture.recordings.skeleton_bag import TYPE
from teo_sign_capture.recordings.video import video_images

# [s] An image this far outside the stroke still shows its beginning or end: three images at 30 Hz.
_NEAREST = 0.1
# Margin around the keypoints, as a share of the width of the shoulders: from the nose to the crown and a
# little more.
_MARGIN = 0.45
# Nose, right shoulder, elbow and wrist, left shoulder, elbow and wrist in BODY_25.
_UPPER_BODY = (0, 2, 3, 4, 5, 6, 7)
_PAPER = (250, 250, 252)


class _Seen(NamedTuple):
    """The person in the images: stamp from which a track's times count [ns], and what the keypoints span.

    `low` and `high` are the corners of that [px], with a margin; NaN if nothing was seen.
    """

    first: int
    low: Array
    high: Array


def colour_images(
    bag: Path, skeletons: Path, *, start: float, end: float, size: tuple[int, int]
) -> list[tuple[float, Image]]:
    """Colour images of a stroke, cut out around the person.

    Args:
        bag: The recording.
        skeletons: The bag of its skeletons, from which times count.
        start: Of the stroke [s].
        end: Of the stroke [s].
        size: Width and height of the images wanted [px].

    Returns:
        Time from the beginning of the stroke [s] and image, in order; nothing where the bag has no images.
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
    images: list[tuple[float, Image]] = []
    for found in opened.messages([topic]):
        time = (stamp_of(found.message) - seen.first) * 1e-9 - start
        if -_NEAREST <= time <= end - start + _NEAREST:
            image = color_of(found.message)
            images.append((time, fitted(_around(image, seen, size), size)))
    return images


def video_pictures(
    video: Path, *, start: float, end: float, size: tuple[int, int]
) -> list[tuple[float, Image]]:
    """Whole images of a stroke in a video.

    Args:
        video: The video.
        start: Of the stroke [s].
        end: Of the stroke [s].
        size: Width and height of the images wanted [px].

    Returns:
        Time from the beginning of the stroke [s] and image, in order.
    """
    images: list[tuple[float, Image]] = []
    for when, image in video_images(video):
        if when > end + _NEAREST:
            break
        if when >= start - _NEAREST:
            images.append((when - start, fitted(image, size)))
    return images


def fitted(image: Image, size: tuple[int, int]) -> Image:
    """The whole image in a size [px], with paper beside it where the shapes differ."""
    height, width = image.shape[:2]
    share = min(size[0] / width, size[1] / height)
    small = cv2.resize(image, (round(width * share), round(height * share)), interpolation=cv2.INTER_AREA)
    picture = np.full((size[1], size[0], 3), _PAPER, np.uint8)
    top, left = (size[1] - small.shape[0]) // 2, (size[0] - small.shape[1]) // 2
    picture[top : top + small.shape[0], left : left + small.shape[1]] = small
    return picture


def _around(image: Image, seen: _Seen, size: tuple[int, int]) -> Image:
    """The part of an image that shows the person, in the shape of the size wanted."""
    if not np.isfinite([seen.low, seen.high]).all():
        return image
    height, width = image.shape[:2]
    middle, span = (seen.low + seen.high) / 2.0, seen.high - seen.low
    rows = min(max(span[1], span[0] * size[1] / size[0]), height, width * size[1] / size[0])
    half = np.array([rows * size[0] / size[1], rows]) / 2.0
    middle = np.clip(middle, half, np.maximum(np.array([width, height]) - half, half))
    left, top = np.maximum(np.round(middle - half), 0).astype(int)
    right, bottom = np.round(middle + half).astype(int)
    return image[top:bottom, left:right]


def _seen(skeletons: Path, start: float, end: float) -> _Seen:
    first = 0
    bodies: list[list[list[float]]] = []
    with AnyReader([skeletons]) as reader:
        connections = [one for one in reader.connections if one.msgtype == TYPE]
        for connection, _, data in reader.messages(connections=connections):
            message: Any = reader.deserialize(data, connection.msgtype)
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
