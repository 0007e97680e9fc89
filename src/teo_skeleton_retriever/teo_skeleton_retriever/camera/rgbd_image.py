# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A colour image with the depth of each of its pixels and its camera, from messages and from files.

Takes messages of rclpy and those that are read from bags alike.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.image_decoding import (
    COLOR_ENCODINGS,
    DEPTH_ENCODINGS,
    ColorArray,
    decode_color,
    decode_compressed_color,
    decode_compressed_depth,
    decode_depth,
    metres,
)
from teo_skeleton_retriever.errors import RetrieverError


@dataclass(frozen=True, eq=False)
class RgbdImage:
    """What a camera saw at one time.

    Attributes:
        stamp: When the colour image was taken [s].
        color: RGB. Shape (height, width, 3).
        depth: Along the optical axis [m], aligned to the colour image, NaN where unknown.
            Shape (height, width).
        camera: Of both.

    Raises:
        RetrieverError: The three are not of the same size.
    """

    stamp: float
    color: ColorArray
    depth: DepthArray
    camera: CameraModel

    def __post_init__(self) -> None:
        height, width = self.color.shape[:2]
        if self.depth.shape != (height, width):
            raise RetrieverError(
                "depth_size",
                f"expected depth of the colour image's {width} x {height} px, got "
                f"{self.depth.shape[1]} x {self.depth.shape[0]}; align depth to colour",
            )
        if (self.camera.width, self.camera.height) != (width, height):
            raise RetrieverError(
                "camera_info_size",
                f"expected camera_info of the colour image's {width} x {height} px, got "
                f"{self.camera.width} x {self.camera.height}",
            )


def read_rgbd_image(color: Path, depth: Path, camera_info: Path) -> RgbdImage:
    """Read an image; its stamp is 0.

    Args:
        color: PNG, JPEG or what else OpenCV reads.
        depth: PNG or TIFF of 16 bits [mm], or TIFF or EXR of floats [m], aligned to colour.
        camera_info: JSON with width, height, k, d and distortion_model, as in sensor_msgs/CameraInfo.

    Raises:
        RetrieverError: A file cannot be read, or is not what it should be.
    """
    pixels = decode_compressed_color(_content(color, "a colour image"))
    return RgbdImage(stamp=0.0, color=pixels, depth=_depth(depth), camera=_camera(camera_info))


def _content(path: Path, what: str) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise RetrieverError("unreadable_file", f"expected {what} in {path}: {error.strerror}") from None


def _depth(path: Path) -> DepthArray:
    data = np.frombuffer(_content(path, "a depth image"), np.uint8)
    image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
    if image is None:
        raise RetrieverError("not_an_image", f"expected a depth image in {path}, got {len(data)} other bytes")
    return metres(image)


def _camera(path: Path) -> CameraModel:
    content = _content(path, "camera_info")
    try:
        info = json.loads(content)
        return CameraModel.from_camera_info(
            width=int(info["width"]),
            height=int(info["height"]),
            k=np.array(info["k"], dtype=np.float64),
            d=np.array(info.get("d", ()), dtype=np.float64),
            distortion_model=str(info.get("distortion_model", "")),
        )
    except (ValueError, KeyError, TypeError) as error:
        raise RetrieverError(
            "bad_camera_info",
            f"expected JSON with width, height, k, d, distortion_model in {path}: "
            f"{type(error).__name__} {error}",
        ) from None


COLOR_TOPIC = "camera/color/image_raw"
DEPTH_TOPIC = "camera/aligned_depth_to_color/image_raw"
CAMERA_INFO_TOPIC = "camera/color/camera_info"


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


def image_of(color: Any, depth: Any, camera_info: Any, *, rectified: bool) -> RgbdImage:
    """Make an image of a message of colour, one of depth and one of the camera; see `camera_of`.

    Raises:
        RetrieverError: One cannot be decoded, or they do not fit together.
    """
    return RgbdImage(
        stamp=stamp_of(color) * 1e-9,
        color=color_of(color),
        depth=depth_of(depth),
        camera=camera_of(camera_info, rectified=rectified),
    )


def shows_depth(message: Any) -> bool | None:
    """Tell by its encoding whether an image is one of depth; None if it is neither depth nor colour."""
    if _is_compressed(message):
        return message.format.partition(";")[0].strip() in DEPTH_ENCODINGS
    if message.encoding in DEPTH_ENCODINGS:
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
