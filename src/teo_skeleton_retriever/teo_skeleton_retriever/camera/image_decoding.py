# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images as drivers send them: colour as RGB, depth in metres, raw or compressed.

Sources: REP-118: 32FC1 is in metres with NaN or infinity for nothing, 16UC1 in millimetres with 0 for
nothing. The plugins `compressed` and `compressedDepth` of image_transport_plugins 4.0. For RVL A. D. Wilson,
"Fast Lossless Depth Image Compression", ISS 2017: RVL splits numbers in groups of three bits, the lowest
first, each in a nibble whose top bit says that another follows; eight nibbles, the first on top, are a
little-endian word of 32 bits. The image is runs: how many pixels are unknown, how many known follow, and for
each of these by how much it differs from the known pixel before it (0 before the first); signs alternate: 0,
-1, 1, -2, 2, ...
"""

from __future__ import annotations

import struct
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.errors import RetrieverError

_MILLIMETRE = np.float32(0.001)
_TYPES = {"16UC1": "u2", "mono16": "u2", "32FC1": "f4"}
# Encodings of depth in sensor_msgs/Image.
DEPTH_ENCODINGS = tuple(_TYPES)
# 67 million: twice 8K; larger sizes come from a corrupt message.
_MAX_PIXELS = 1 << 26

ColorArray = NDArray[np.uint8]
Bytes = bytes | bytearray | memoryview | np.ndarray


def decode_depth(
    data: Bytes,
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
    step = _checked_step(data, width, height, kind.itemsize, step)
    rows = np.ndarray((height, width), dtype=kind, buffer=data, strides=(step, kind.itemsize))
    return metres(rows.astype(kind.newbyteorder("=")))


def _checked_step(data: Bytes, width: int, height: int, pixel: int, step: int) -> int:
    """Bytes from a row to the next; refuses sizes that do not fit together, of `pixel` bytes a pixel."""
    if width <= 0 or height <= 0 or width * height > _MAX_PIXELS:
        raise RetrieverError("bad_size", f"expected 1 to {_MAX_PIXELS} pixels, got {width} x {height}")
    row = width * pixel
    step = step or row
    if step < row or len(data) < step * (height - 1) + row:
        raise RetrieverError(
            "wrong_length",
            f"expected {height} rows of {row} bytes or more, got {len(data)} bytes with a step of {step}",
        )
    return step


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
    if channels == 2 and width % 2:
        raise RetrieverError("bad_size", f"expected an even width in {encoding}, got {width} px")
    step = _checked_step(data, width, height, channels, step)
    image: ColorArray = np.ndarray((height, width, channels), np.uint8, data, strides=(step, channels, 1))
    if conversion is None:
        return np.ascontiguousarray(image)
    return np.asarray(cv2.cvtColor(np.ascontiguousarray(image), conversion), dtype=np.uint8)


# Before the depth image: a number for the format that nothing reads, and both terms of the quantisation.
_HEADER = struct.Struct("<iff")
_RVL_SIZE = struct.Struct("<II")
_PNG = b"\x89PNG"


def decode_compressed_color(data: Bytes) -> ColorArray:
    """Decode a JPEG, PNG or any other file of an image that OpenCV reads, whatever the message calls it.

    Returns:
        RGB. Shape (height, width, 3).

    Raises:
        RetrieverError: The data are no image.
    """
    image = _decoded(data, cv2.IMREAD_COLOR_RGB)
    if image is None:
        raise RetrieverError("not_an_image", f"expected JPEG or PNG, got {len(data)} bytes that are neither")
    return np.asarray(image, dtype=np.uint8)


def decode_compressed_depth(data: Bytes, message_format: str) -> DepthArray:
    """Decode what the plugin `compressedDepth` sends: 12 bytes of header, then PNG or RVL.

    Args:
        data: Of the message.
        message_format: Of the message: "16UC1; compressedDepth png", "32FC1; compressedDepth rvl" and so on;
            before ROS 2 without the last word, for PNG. A depth image sent by the plugin `compressed` as
            PNG ("16UC1; png compressed") is understood as well.

    Returns:
        Depth along the optical axis [m], NaN where unknown. Shape (height, width).

    Raises:
        RetrieverError: The format is none of these, or the data are not of the format.
    """
    encoding = message_format.partition(";")[0].strip()
    if encoding not in _TYPES:
        raise RetrieverError(
            "wrong_encoding", f"expected '16UC1; ...' or '32FC1; ...', got the format {message_format!r:.60}"
        )
    quantised = encoding == "32FC1"
    if "compressedDepth" not in message_format and bytes(data[:4]) == _PNG and not quantised:
        return metres(_plane_of_png(data))
    if len(data) <= _HEADER.size:
        raise RetrieverError(
            "wrong_length", f"expected a header of {_HEADER.size} bytes and more, got {len(data)}"
        )
    _, a, b = _HEADER.unpack(bytes(data[: _HEADER.size]))
    body = data[_HEADER.size :]
    plane = _plane_of_rvl(body) if message_format.rstrip().endswith("rvl") else _plane_of_png(body)
    return _dequantised(plane, a, b) if quantised else metres(plane)


def _dequantised(plane: np.ndarray, a: float, b: float) -> DepthArray:
    """Undo the plugin's quantisation of the inverse depth: n = a / depth + b, 0 where unknown."""
    steps = plane.astype(np.float32) - np.float32(b)
    with np.errstate(divide="ignore"):
        return metres(np.where((plane > 0) & (steps > 0.0), np.float32(a) / steps, np.nan).astype(np.float32))


def _plane_of_png(data: Bytes) -> np.ndarray:
    image = _decoded(data, cv2.IMREAD_UNCHANGED)
    if image is None or image.dtype != np.uint16 or image.ndim != 2:
        got = "no image" if image is None else f"{image.dtype} of shape {image.shape}"
        raise RetrieverError("wrong_data", f"expected a PNG with one plane of 16 bits, got {got}")
    return image


def _plane_of_rvl(data: Bytes) -> np.ndarray:
    if len(data) < _RVL_SIZE.size:
        raise RetrieverError("wrong_length", f"expected the width and height in 8 bytes, got {len(data)}")
    width, height = _RVL_SIZE.unpack(bytes(data[: _RVL_SIZE.size]))
    if not 0 < width * height <= _MAX_PIXELS:
        raise RetrieverError("bad_size", f"expected 1 to {_MAX_PIXELS} pixels, got {width} x {height}")
    return decode_rvl(bytes(data[_RVL_SIZE.size :]), width * height).reshape(height, width)


def _decoded(data: Bytes, mode: int) -> np.ndarray | None:
    content = np.frombuffer(data, dtype=np.uint8)
    if not len(content):
        return None
    try:
        return cv2.imdecode(content, mode)
    except cv2.error:  # a header that promises more pixels than OpenCV allows
        return None


_SHIFTS = np.arange(28, -1, -4, dtype=np.uint32)
_MAX_NIBBLES = 11  # 33 bits: more than any number of pixels


def decode_rvl(data: bytes, pixels: int) -> NDArray[np.uint16]:
    """Decode an image.

    Args:
        data: Words of nibbles; bytes beyond the last pixel do not matter.
        pixels: Of the image.

    Returns:
        [mm], 0 where unknown. Shape (pixels,).

    Raises:
        RetrieverError: The data end before the image does, or are not RVL.
    """
    numbers = _numbers(data)
    image = np.zeros(pixels, dtype=np.uint16)
    known_runs: list[slice] = []
    pixel = place = 0
    while pixel < pixels:
        if place + 2 > len(numbers):
            raise RetrieverError("wrong_length", f"expected {pixels} pixels of RVL, got {pixel}")
        unknown, known = int(numbers[place]), int(numbers[place + 1])
        place += 2
        pixel += unknown
        if pixel + known > pixels or place + known > len(numbers):
            raise RetrieverError("wrong_data", f"expected {pixels} pixels of RVL, got a run beyond them")
        if unknown == known == 0:
            raise RetrieverError("wrong_data", "expected RVL, got a run of no pixels")
        image[pixel : pixel + known] = 1  # marked; the values follow for all at once
        known_runs.append(slice(place, place + known))
        pixel += known
        place += known
    if known_runs:
        coded = np.concatenate([numbers[run] for run in known_runs])
        differences = (coded >> 1) ^ -(coded & 1)
        image[image == 1] = np.cumsum(differences).astype(np.uint16)
    return image


def _numbers(data: bytes) -> NDArray[np.int64]:
    """Read all numbers of a stream; what is left of one that is cut off is dropped."""
    words = np.frombuffer(data, dtype="<u4", count=len(data) // 4)
    nibbles = ((words[:, None] >> _SHIFTS) & 15).ravel().astype(np.int64)
    ends = np.flatnonzero(nibbles < 8)
    if not len(ends):
        return np.zeros(0, dtype=np.int64)
    starts = np.concatenate([[0], ends[:-1] + 1])
    if np.any(ends - starts >= _MAX_NIBBLES):
        raise RetrieverError("wrong_data", "expected RVL, got a number of more than 33 bits")
    nibbles = nibbles[: ends[-1] + 1]
    position = np.arange(len(nibbles)) - np.repeat(starts, ends - starts + 1)
    return np.add.reduceat((nibbles & 7) << (3 * position), starts)
