# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images that are not compressed: colour as RGB, depth in metres.

Source: REP-118: 32FC1 is in metres with NaN or infinity for nothing, 16UC1 in millimetres with 0 for nothing.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.errors import RetrieverError

_MILLIMETRE = np.float32(0.001)
_TYPES = {"16UC1": "u2", "mono16": "u2", "32FC1": "f4"}
# 67 million: twice 8K; larger sizes come from a corrupt message.
MAX_PIXELS = 1 << 26


def decode_depth(
    data: bytes | bytearray | memoryview,
    *,
    width: int,
    height: int,
    encoding: str,
    step: int = 0,
    big_endian: bool = False,
) -> DepthArray:
    """Decode the fields of a sensor_msgs/Image.

    Args:
        data: Rows of `step` bytes.
        width: [px].
        height: [px].
        encoding: "16UC1" or "mono16" [mm], "32FC1" [m].
        step: Bytes from a row to the next; 0 for rows without padding.
        big_endian: Order of the bytes.

    Returns:
        Depth along the optical axis [m], NaN where unknown. Shape (height, width).

    Raises:
        RetrieverError: The encoding is none of depth, or the sizes do not fit together.
    """
    if encoding not in _TYPES:
        raise RetrieverError(
            "wrong_encoding", f"expected a depth encoding among {tuple(_TYPES)}, got {encoding!r:.40}"
        )
    kind = np.dtype(_TYPES[encoding]).newbyteorder(">" if big_endian else "<")
    if width <= 0 or height <= 0 or width * height > MAX_PIXELS:
        raise RetrieverError("bad_size", f"expected 1 to {MAX_PIXELS} pixels, got {width} x {height}")
    row = width * kind.itemsize
    step = step or row
    if step < row or len(data) < step * (height - 1) + row:
        raise RetrieverError(
            "wrong_length",
            f"expected {height} rows of {row} bytes or more, got {len(data)} bytes with a step of {step}",
        )
    rows = np.ndarray((height, width), dtype=kind, buffer=data, strides=(step, kind.itemsize))
    return metres(rows.astype(kind.newbyteorder("=")))


def metres(image: np.ndarray) -> DepthArray:
    """Bring an image of whole millimetres or of metres to metres.

    Args:
        image: As stored: uint16 [mm], float32 or float64 [m]. Shape (height, width).

    Returns:
        [m], NaN where unknown: zero, negative, NaN or infinite. Shape (height, width).

    Raises:
        RetrieverError: Another type or shape.
    """
    if image.ndim != 2 or image.dtype not in (np.uint16, np.float32, np.float64):
        raise RetrieverError(
            "wrong_type", f"expected a plane of uint16 or floats, got {image.dtype} of shape {image.shape}"
        )
    depth: DepthArray = image.astype(np.float32)
    if image.dtype == np.uint16:
        depth *= _MILLIMETRE
    depth[~(np.isfinite(depth) & (depth > 0.0))] = np.nan
    return depth


ColorArray = NDArray[np.uint8]
Bytes = bytes | bytearray | memoryview | np.ndarray


class _Encoding(NamedTuple):
    """Bytes per pixel, and OpenCV's conversion to RGB; None if it is that already."""

    channels: int
    conversion: int | None


_ENCODINGS = {
    "rgb8": _Encoding(3, None),
    "bgr8": _Encoding(3, cv2.COLOR_BGR2RGB),
    "8UC3": _Encoding(3, cv2.COLOR_BGR2RGB),  # says no order; what writes it is OpenCV, whose order is BGR
    "rgba8": _Encoding(4, cv2.COLOR_RGBA2RGB),
    "bgra8": _Encoding(4, cv2.COLOR_BGRA2RGB),
    "8UC4": _Encoding(4, cv2.COLOR_BGRA2RGB),
    "mono8": _Encoding(1, cv2.COLOR_GRAY2RGB),
    "8UC1": _Encoding(1, cv2.COLOR_GRAY2RGB),
    "yuv422": _Encoding(2, cv2.COLOR_YUV2RGB_UYVY),
    "uyvy": _Encoding(2, cv2.COLOR_YUV2RGB_UYVY),
    "yuv422_yuy2": _Encoding(2, cv2.COLOR_YUV2RGB_YUY2),
    "yuyv": _Encoding(2, cv2.COLOR_YUV2RGB_YUY2),
}
# What the encodings of raw sensors begin with, of which each pixel holds one colour, and what to do.
BAYER = "bayer_"
DEBAYER = "run image_proc's debayer node while recording, and use its image_color topic"
# Encodings of sensor_msgs/Image that are understood.
COLOR_ENCODINGS = tuple(_ENCODINGS)


def decode_color(data: Bytes, *, width: int, height: int, encoding: str, step: int = 0) -> ColorArray:
    """Decode the fields of a sensor_msgs/Image.

    Args:
        data: Rows of `step` bytes.
        width: [px].
        height: [px].
        encoding: One of `COLOR_ENCODINGS`. All are of single bytes, so that their order does not matter.
        step: Bytes from a row to the next; 0 for rows without padding.

    Returns:
        RGB; may share its memory with `data`. Shape (height, width, 3).

    Raises:
        RetrieverError: The encoding is not known, or the sizes do not fit together.
    """
    if encoding.startswith(BAYER):
        raise RetrieverError(
            "wrong_encoding",
            f"expected a colour image, got the raw mosaic {encoding!r:.40}: {DEBAYER}",
        )
    if encoding not in _ENCODINGS:
        raise RetrieverError(
            "wrong_encoding",
            f"expected a colour encoding among {', '.join(COLOR_ENCODINGS)}, got {encoding!r:.40}",
        )
    channels, conversion = _ENCODINGS[encoding]
    if width <= 0 or height <= 0 or width * height > MAX_PIXELS:
        raise RetrieverError("bad_size", f"expected 1 to {MAX_PIXELS} pixels, got {width} x {height}")
    if channels == 2 and width % 2:
        raise RetrieverError("bad_size", f"expected an even width in {encoding}, got {width} px")
    row = width * channels
    step = step or row
    if step < row or len(data) < step * (height - 1) + row:
        raise RetrieverError(
            "wrong_length",
            f"expected {height} rows of {row} bytes or more, got {len(data)} bytes with a step of {step}",
        )
    image: ColorArray = np.ndarray((height, width, channels), np.uint8, data, strides=(step, channels, 1))
    if conversion is None:
        return np.ascontiguousarray(image)
    return np.asarray(cv2.cvtColor(np.ascontiguousarray(image), conversion), dtype=np.uint8)
