# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the messages of a camera to arrays, and the usual names of its topics.

Takes messages of rclpy and those that are read from bags alike.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.compressed_image import decode_compressed_color, decode_compressed_depth
from teo_skeleton_retriever.camera.raw_image import COLOR_ENCODINGS, ColorArray, decode_color, decode_depth

COLOR_TOPIC = "camera/color/image_raw"
DEPTH_TOPIC = "camera/aligned_depth_to_color/image_raw"
CAMERA_INFO_TOPIC = "camera/color/camera_info"


_DEPTH_ENCODINGS = ("16UC1", "mono16", "32FC1")
_NANOSECONDS = 1_000_000_000


def stamp_of(message: Any) -> int:
    """Give the stamp of a message with a header [ns]."""
    return int(message.header.stamp.sec) * _NANOSECONDS + int(message.header.stamp.nanosec)


def color_of(message: Any) -> ColorArray:
    """Decode a sensor_msgs/Image or CompressedImage of colour.

    Returns:
        RGB; may share its memory with the message. Shape (height, width, 3).

    Raises:
        RetrieverError: It cannot be decoded.
    """
    if _is_compressed(message):
        return decode_compressed_color(message.data)
    return decode_color(
        message.data,
        width=message.width,
        height=message.height,
        encoding=message.encoding,
        step=message.step,
    )


def depth_of(message: Any) -> DepthArray:
    """Decode a sensor_msgs/Image or CompressedImage of depth [m], NaN where unknown. Shape (height, width).

    Raises:
        RetrieverError: It cannot be decoded.
    """
    if _is_compressed(message):
        return decode_compressed_depth(message.data, message.format)
    return decode_depth(
        message.data,
        width=message.width,
        height=message.height,
        encoding=message.encoding,
        step=message.step,
        big_endian=bool(message.is_bigendian),
    )


def shows_depth(message: Any) -> bool | None:
    """Tell by its encoding whether an image is one of depth; None if it is neither depth nor colour."""
    if _is_compressed(message):
        return message.format.partition(";")[0].strip() in _DEPTH_ENCODINGS
    if message.encoding in _DEPTH_ENCODINGS:
        return True
    return False if message.encoding in COLOR_ENCODINGS else None


def camera_of(message: Any, *, rectified: bool = False) -> CameraModel:
    """Read a sensor_msgs/CameraInfo.

    Args:
        message: Of ROS 2, or of ROS 1, where the matrices have capital names.
        rectified: Whether the images were rectified, and so have the projection of P and no distortion.

    Raises:
        RetrieverError: It describes no usable camera; a driver that is not calibrated sends zeros.
    """
    matrix = np.array(_field(message, "k"), dtype=np.float64).reshape(3, 3)
    if rectified:
        matrix = np.array(_field(message, "p"), dtype=np.float64).reshape(3, 4)[:, :3].copy()
    width, height = int(message.width), int(message.height)
    # The matrix is the whole sensor's; the image may be a part of it, and binned (sensor_msgs/CameraInfo).
    region, binning = message.roi, (max(int(message.binning_x), 1), max(int(message.binning_y), 1))
    matrix[:2, 2] -= (region.x_offset, region.y_offset)
    matrix[:2] /= np.array(binning)[:, None]
    if region.width and region.height:
        width, height = int(region.width), int(region.height)
    distortion = np.array(_field(message, "d"), dtype=np.float64)
    # Coefficients of zero bend nothing, whatever the model that a driver names beside them.
    straight = rectified or not distortion.any()
    return CameraModel.from_camera_info(
        width=width // binning[0],
        height=height // binning[1],
        k=matrix,
        d=np.zeros(0) if straight else distortion,
        distortion_model="" if straight else str(message.distortion_model),
    )


def _is_compressed(message: Any) -> bool:
    return hasattr(message, "format")


def _field(message: Any, name: str) -> Any:
    return getattr(message, name if hasattr(message, name) else name.upper())
