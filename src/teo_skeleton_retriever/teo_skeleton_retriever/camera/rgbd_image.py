# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A colour image with the depth of each of its pixels, also from files."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.compressed_image import decode_compressed_color
from teo_skeleton_retriever.camera.raw_image import ColorArray, metres
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
    try:
        pixels = decode_compressed_color(color.read_bytes())
    except OSError as error:
        raise RetrieverError(
            "unreadable_file", f"expected a colour image in {color}: {error.strerror}"
        ) from None
    return RgbdImage(stamp=0.0, color=pixels, depth=_depth(depth), camera=_camera(camera_info))


def _depth(path: Path) -> DepthArray:
    try:
        data = np.frombuffer(path.read_bytes(), np.uint8)
    except OSError as error:
        raise RetrieverError(
            "unreadable_file", f"expected a depth image in {path}: {error.strerror}"
        ) from None
    image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
    if image is None:
        raise RetrieverError("not_an_image", f"expected a depth image in {path}, got {len(data)} other bytes")
    return metres(image)


def _camera(path: Path) -> CameraModel:
    try:
        info = json.loads(path.read_text(encoding="utf-8"))
        return CameraModel.from_camera_info(
            width=int(info["width"]),
            height=int(info["height"]),
            k=np.array(info["k"], dtype=np.float64),
            d=np.array(info.get("d", ()), dtype=np.float64),
            distortion_model=str(info.get("distortion_model", "")),
        )
    except OSError as error:
        raise RetrieverError("unreadable_file", f"expected camera_info in {path}: {error.strerror}") from None
    except (ValueError, KeyError, TypeError) as error:
        raise RetrieverError(
            "bad_camera_info",
            f"expected JSON with width, height, k, d, distortion_model in {path}: "
            f"{type(error).__name__} {error}",
        ) from None
