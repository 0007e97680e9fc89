# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the retriever sees, as pictures and as a film that runs at the pace of the recording.

A picture shows skeletons over the colour image, depth beside them, and who is who.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import cv2
import numpy as np

from teo_skeleton_retriever.arrays import DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.image_decoding import ColorArray
from teo_skeleton_retriever.camera.rgbd_image import RgbdImage
from teo_skeleton_retriever.image_retriever import Retrieved
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21, Layout
from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus, Skeleton
from teo_skeleton_retriever.output.output_file import output_file

_Rgb = tuple[int, int, int]

# From what is trusted most to what is least.
STATUS_COLORS: dict[KeypointStatus, _Rgb] = {
    KeypointStatus.MEASURED: (60, 230, 90),
    KeypointStatus.OPTIMISED: (80, 170, 255),
    KeypointStatus.HELD: (255, 165, 30),
    KeypointStatus.LOST: (255, 60, 60),
}
_SIGNER, _OTHER, _INK = (255, 255, 255), (150, 150, 150), (0, 0, 0)
_UNKNOWN_DEPTH = (40, 40, 40)
_NEAREST, _FARTHEST = 0.5, 3.5  # [m] shown from red to blue: where a signer and what is behind them stand
_CROWN = 0.22  # [m] from the eyes, or ears, to above the hair
_INSET = 0.28  # of the picture's width
_DESIGN_WIDTH = 640.0  # [px] for which the widths of lines and letters below are given
_DASH = 6.0  # [px] likewise
_RATE_IMAGES = 30
_FONT = cv2.FONT_HERSHEY_SIMPLEX
_SHIFT = 3  # bits of a pixel's fraction that OpenCV draws with
_FAR_OUT = 4  # widths of the picture beyond its edge; OpenCV's fixed point overflows farther out


class Overlay:
    """Draws one image after the other; remembers their stamps for the rate."""

    def __init__(self) -> None:
        self._stamps: deque[float] = deque(maxlen=_RATE_IMAGES)

    def draw(self, image: RgbdImage, result: Retrieved) -> ColorArray:
        """Draw what was found in an image. Shape (height, width, 3), RGB.

        Points in space are drawn where the camera images them: green where measured, blue where they follow
        from lengths and shapes, orange and dashed where held. A red cross is where the detector saw a
        keypoint that has no place in space. The signer's bones are lined in white.
        """
        picture: ColorArray = image.color.copy()
        scale = max(picture.shape[1] / _DESIGN_WIDTH, 0.5)
        for skeleton in sorted(result.skeletons, key=lambda skeleton: skeleton.is_signer):
            _draw_person(picture, skeleton, image.camera, scale)
        _draw_unfollowed(picture, result, scale)
        _draw_inset(picture, image.depth, result.skeletons, image.camera, scale)
        _draw_texts(picture, self._lines(image.stamp, result), scale)
        return picture

    def _lines(self, stamp: float, result: Retrieved) -> list[str]:
        if self._stamps and stamp <= self._stamps[-1]:
            self._stamps.clear()
        self._stamps.append(stamp)
        rate = ""
        if len(self._stamps) > 1:
            rate = f"{(len(self._stamps) - 1) / (self._stamps[-1] - self._stamps[0]):.0f} fps  "
        times = f"detector {result.detector_time * 1e3:.0f} ms  own {result.own_time * 1e3:.1f} ms"
        return [rate + times, f"depth known {result.depth_share * 100:.0f} %"]


def _draw_person(picture: ColorArray, skeleton: Skeleton, camera: CameraModel, scale: float) -> None:
    edge = _SIGNER if skeleton.is_signer else _OTHER
    _draw_part(picture, skeleton.face, FACE_70, camera, edge=None, width=1.0 * scale, joint=0.0)
    _draw_part(picture, skeleton.body, BODY_25, camera, edge=edge, width=2.5 * scale, joint=3.5 * scale)
    for hand in (skeleton.left_hand, skeleton.right_hand):
        _draw_part(picture, hand, HAND_21, camera, edge=None, width=1.4 * scale, joint=1.4 * scale)
    _draw_label(picture, skeleton, camera, scale)


def _draw_part(
    picture: ColorArray,
    keypoints: Keypoints3D,
    layout: Layout,
    camera: CameraModel,
    *,
    edge: _Rgb | None,
    width: float,
    joint: float,
) -> None:
    pixels = _on_picture(camera.project(keypoints.points), picture)
    status = [KeypointStatus(value) for value in keypoints.status]
    bones = [(layout.index[a], layout.index[b]) for a, b in layout.bones]
    shown = [(a, b) for a, b in bones if np.isfinite(pixels[[a, b]]).all()]
    if edge is not None:
        for a, b in shown:
            _line(picture, pixels[a], pixels[b], edge, width * 2.0)
    for a, b in shown:
        weaker = max(status[a], status[b], key=list(STATUS_COLORS).index)
        dashed = weaker is KeypointStatus.HELD
        _line(picture, pixels[a], pixels[b], STATUS_COLORS[weaker], width, dashed=dashed)
    if joint:
        for pixel, kind in zip(pixels, status, strict=True):
            if np.isfinite(pixel).all():
                _dot(picture, pixel, STATUS_COLORS[kind], joint)
    for pixel, kind in zip(_on_picture(keypoints.pixels, picture), status, strict=True):
        if kind is KeypointStatus.LOST and np.isfinite(pixel).all():
            _cross(picture, pixel, max(joint, width))


def _draw_label(picture: ColorArray, skeleton: Skeleton, camera: CameraModel, scale: float) -> None:
    pixels = _on_picture(camera.project(skeleton.body.points), picture)
    known = np.isfinite(pixels).all(axis=1)
    if not known.any():
        return
    column, row = pixels[known][np.argmin(pixels[known, 1])]
    distance = float(np.nanmedian(skeleton.body.points[known, 2]))
    text = f"{skeleton.track_id}{' signer' if skeleton.is_signer else ''}  {distance:.2f} m"
    size = 0.5 * scale
    (width, height), _ = cv2.getTextSize(text, _FONT, size, max(round(scale), 1))
    left = int(np.clip(column - width / 2, 2, max(picture.shape[1] - width - 2, 2)))
    bottom = int(np.clip(row - _CROWN * camera.fy / distance, 20 * scale, picture.shape[0] - 4))
    back = _SIGNER if skeleton.is_signer else _OTHER
    pad = round(4 * scale)
    cv2.rectangle(
        picture, (left - pad, bottom - height - pad), (left + width + pad, bottom + pad), back, cv2.FILLED
    )
    cv2.putText(picture, text, (left, bottom), _FONT, size, _INK, max(round(scale), 1), cv2.LINE_AA)


def _draw_unfollowed(picture: ColorArray, result: Retrieved, scale: float) -> None:
    """Mark what the detector saw while nobody is followed: someone on trial, or without depth."""
    if result.skeletons:
        return
    for person in result.people:
        for pixel in _on_picture(person.body[person.body[:, 2] > 0.0, :2], picture):
            if np.isfinite(pixel).all():
                _cross(picture, pixel, 3.0 * scale)


def _draw_inset(
    picture: ColorArray,
    depth: DepthArray,
    skeletons: Sequence[Skeleton],
    camera: CameraModel,
    scale: float,
) -> None:
    """Draw the depth in the lower right corner, with the keypoints of the bodies and hands on it."""
    height, width = depth.shape
    size = (round(width * _INSET), round(height * _INSET))
    small = cv2.resize(depth, size, interpolation=cv2.INTER_NEAREST)
    share = np.clip((_FARTHEST - small) / (_FARTHEST - _NEAREST), 0.0, 1.0)
    known = np.isfinite(small)
    colors = cv2.applyColorMap((np.where(known, share, 0.0) * 255).astype(np.uint8), cv2.COLORMAP_TURBO)
    inset = np.ascontiguousarray(colors[:, :, ::-1])
    inset[~known] = _UNKNOWN_DEPTH
    for skeleton in skeletons:
        for part in (skeleton.body, skeleton.left_hand, skeleton.right_hand):
            for pixel in _on_picture(camera.project(part.points) * _INSET, inset):
                if np.isfinite(pixel).all():
                    _dot(inset, pixel, _SIGNER, 1.2 * scale)
    text = f"depth {_NEAREST:g} to {_FARTHEST:g} m"
    _text(inset, text, (round(4 * scale), size[1] - round(5 * scale)), 0.4 * scale, scale)
    margin = round(6 * scale)
    top, left = picture.shape[0] - size[1] - margin, picture.shape[1] - size[0] - margin
    picture[top : top + size[1], left : left + size[0]] = inset
    cv2.rectangle(picture, (left - 1, top - 1), (left + size[0], top + size[1]), _SIGNER, 1)


def _draw_texts(picture: ColorArray, lines: Sequence[str], scale: float) -> None:
    step = round(18 * scale)
    for i, line in enumerate(lines):
        _text(picture, line, (round(6 * scale), step * (i + 1)), 0.5 * scale, scale)
    row = picture.shape[0] - round(8 * scale)
    column = round(6 * scale)
    for status, color in STATUS_COLORS.items():
        word = status.name.lower()
        _text(picture, word, (column, row), 0.45 * scale, scale, color)
        column += cv2.getTextSize(word, _FONT, 0.45 * scale, 1)[0][0] + round(12 * scale)


def _text(
    picture: ColorArray, text: str, where: tuple[int, int], size: float, scale: float, color: _Rgb = _SIGNER
) -> None:
    """Write with a dark edge, legible on any ground."""
    width = max(round(scale), 1)
    # A thicker stroke would not do for the edge: OpenCV spaces bold letters differently.
    for column, row in ((-width, 0), (width, 0), (0, -width), (0, width)):
        place = (where[0] + column, where[1] + row)
        cv2.putText(picture, text, place, _FONT, size, _INK, width, cv2.LINE_AA)
    cv2.putText(picture, text, where, _FONT, size, color, width, cv2.LINE_AA)


def _on_picture(pixels: FloatArray, picture: ColorArray) -> FloatArray:
    """Replace what is not known or far outside the picture by NaN. Shape (n, 2)."""
    height, width = picture.shape[:2]
    bound = _FAR_OUT * max(height, width)
    with np.errstate(invalid="ignore"):
        near = (np.abs(pixels) < bound).all(axis=1)
    kept: FloatArray = np.where(near[:, None], pixels, np.nan)
    return kept


def _fixed(pixel: FloatArray) -> tuple[int, int]:
    return round(float(pixel[0]) * (1 << _SHIFT)), round(float(pixel[1]) * (1 << _SHIFT))


def _line(
    picture: ColorArray, a: FloatArray, b: FloatArray, color: _Rgb, width: float, *, dashed: bool = False
) -> None:
    pieces = [(a, b)]
    if dashed:
        count = max(int(np.linalg.norm(b - a) / (_DASH * max(width / 2.5, 0.7))), 1)
        cuts = [a + (b - a) * i / count for i in range(count + 1)]
        pieces = [(cuts[i], cuts[i + 1]) for i in range(0, count, 2)]
    for start, end in pieces:
        cv2.line(picture, _fixed(start), _fixed(end), color, max(round(width), 1), cv2.LINE_AA, _SHIFT)


def _dot(picture: ColorArray, pixel: FloatArray, color: _Rgb, radius: float) -> None:
    fixed_radius = round(radius * (1 << _SHIFT))
    cv2.circle(picture, _fixed(pixel), fixed_radius, color, cv2.FILLED, cv2.LINE_AA, _SHIFT)


def _cross(picture: ColorArray, pixel: FloatArray, arm: float) -> None:
    color = STATUS_COLORS[KeypointStatus.LOST]
    for direction in ((1.0, 1.0), (1.0, -1.0)):
        offset = np.array(direction) * arm
        _line(picture, pixel - offset, pixel + offset, color, 1.0)


_TICKS = 1000  # in a second: a film's times are whole milliseconds
_LONGEST_GAP = 2.0  # [s] a longer gap between images, or a stamp set back, is not sat through


class OverlayVideo:
    """Writes pictures with their stamps to an MP4 file; see `overlay_video`."""

    def __init__(self, container: Any) -> None:
        self._container = container
        self._stream: Any = None
        self._start = 0.0
        self._last = 0.0
        self._ticks = -1

    def add(self, picture: ColorArray, stamp: float) -> None:
        """Append an RGB picture taken at a time [s]; one of another size than the first is scaled to it."""
        # The format wants even sizes.
        height, width = (size - size % 2 for size in picture.shape[:2])
        if self._stream is None:
            self._stream = self._container.add_stream("libx264", rate=30)
            self._stream.width, self._stream.height, self._stream.pix_fmt = width, height, "yuv420p"
            self._stream.codec_context.time_base = Fraction(1, _TICKS)
            # One thread leaves the rest of the machine to the detector.
            self._stream.codec_context.thread_count = 1
            self._stream.options = {"preset": "veryfast", "crf": "21"}
        size = (self._stream.width, self._stream.height)
        fitting = picture[:height, :width] if (width, height) == size else cv2.resize(picture, size)
        frame = av.VideoFrame.from_ndarray(fitting, format="rgb24")
        if not 0.0 <= stamp - self._last <= _LONGEST_GAP:
            # Go on a tick later, as if this had been taken then.
            self._start = stamp - (self._ticks + 1) / _TICKS
        self._last = stamp
        self._ticks = max(round((stamp - self._start) * _TICKS), self._ticks + 1)
        frame.pts, frame.time_base = self._ticks, Fraction(1, _TICKS)
        self._container.mux(self._stream.encode(frame))

    def finish(self) -> None:
        """Write what the encoder holds back."""
        if self._stream is None:
            raise _NoPictureError
        self._container.mux(self._stream.encode(None))


class _NoPictureError(Exception):
    """There is nothing to make a film of."""


@contextmanager
def overlay_video(path: Path) -> Iterator[OverlayVideo]:
    """Write an MP4 file, which appears when the block ends well and there was a picture.

    Args:
        path: File to write, replaced if it exists; its folder exists.

    Raises:
        RetrieverError: There is no such folder, or the name does not end in .mp4.
    """
    # faststart: the index comes first, so that a browser can start before it has everything.
    options = {"movflags": "faststart"}
    with (
        suppress(_NoPictureError),
        output_file(path, ".mp4") as temporary,
        av.open(str(temporary), "w", format="mp4", options=options) as container,
    ):
        film = OverlayVideo(container)
        yield film
        film.finish()
