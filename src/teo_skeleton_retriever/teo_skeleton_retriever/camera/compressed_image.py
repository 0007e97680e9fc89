# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Images as image_transport's plugins `compressed` and `compressedDepth` send them.

Source: compressed_image_transport and compressed_depth_image_transport, of image_transport_plugins 4.0.
"""

from __future__ import annotations

import struct

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.color_image import Bytes, ColorArray
from teo_skeleton_retriever.camera.depth_image import MAX_PIXELS, metres
from teo_skeleton_retriever.camera.rvl import decode_rvl
from teo_skeleton_retriever.errors import RetrieverError

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
    if encoding not in ("16UC1", "mono16", "32FC1"):
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
    if not 0 < width * height <= MAX_PIXELS:
        raise RetrieverError("bad_size", f"expected 1 to {MAX_PIXELS} pixels, got {width} x {height}")
    return decode_rvl(bytes(data[_RVL_SIZE.size :]), width * height).reshape(height, width)


def _decoded(data: Bytes, mode: int) -> np.ndarray | None:
    content = np.frombuffer(data, dtype=np.uint8)
    if not len(content):
        return None
    try:
        return cv2.imdecode(content, mode)
    except cv2.error:  # a header that promises more pixels than OpenCV allows
        return None
