# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Depth images as floats in metres, NaN where nothing was measured.

Source: REP-118: 32FC1 is in metres with NaN or infinity for nothing, 16UC1 in millimetres with 0 for nothing.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.errors import RetrieverError

MILLIMETRE = np.float32(0.001)
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
        depth *= MILLIMETRE
    depth[~(np.isfinite(depth) & (depth > 0.0))] = np.nan
    return depth
