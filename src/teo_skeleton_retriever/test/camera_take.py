# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person before a camera, as arrays and as messages: what a driver publishes and a bag holds."""

from __future__ import annotations

from array import array
from typing import Any

import cv2
import numpy as np
from builtin_interfaces.msg import Time
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import Header

from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D

WIDTH, HEIGHT = 320, 240
FOCAL = 300.0
DISTANCE = 1.5  # [m] of the person's skin; the wall is behind
WALL = 3.0
RATE = 30.0
FRAME_ID = "camera_color_optical_frame"
START = 1_700_000_000 * 10**9  # [ns]
PERIOD = round(1e9 / RATE)

_BODY = {
    "Nose": (160, 50),
    "Neck": (160, 80),
    "RShoulder": (130, 80),
    "RElbow": (120, 120),
    "RWrist": (130, 155),
    "LShoulder": (190, 80),
    "LElbow": (200, 120),
    "LWrist": (190, 155),
    "MidHip": (160, 170),
    "RHip": (143, 170),
    "LHip": (177, 170),
}


def person(shift: float = 0.0, scale: float = 1.0) -> Person2D:
    """Keypoints of someone who stands `shift` pixels to the right of the middle."""
    body = np.zeros((25, 3))
    for name, (x, y) in _BODY.items():
        body[BODY_25.index[name]] = (x * scale + shift, y * scale, 0.9)
    return Person2D(body=body)


def color(scale: int = 1) -> np.ndarray:
    """A picture with something in it, RGB."""
    rows, columns = np.mgrid[: HEIGHT * scale, : WIDTH * scale]
    return np.stack([columns % 256, rows % 256, (columns + rows) % 256], axis=2).astype(np.uint8)


def depth(scale: int = 1) -> np.ndarray:
    """A person-shaped board before a wall [m]."""
    image = np.full((HEIGHT * scale, WIDTH * scale), WALL, dtype=np.float32)
    image[30 * scale : 200 * scale, 100 * scale : 220 * scale] = DISTANCE
    return image


def camera(scale: int = 1) -> CameraModel:
    return CameraModel(
        width=WIDTH * scale,
        height=HEIGHT * scale,
        fx=FOCAL * scale,
        fy=FOCAL * scale,
        cx=(WIDTH * scale - 1) / 2,
        cy=(HEIGHT * scale - 1) / 2,
    )


def header(stamp: int) -> Header:
    seconds, nanoseconds = divmod(stamp, 10**9)
    return Header(stamp=Time(sec=seconds, nanosec=nanoseconds), frame_id=FRAME_ID)


def image_message(pixels: np.ndarray, encoding: str, stamp: int, /, **changes: Any) -> Image:
    """A sensor_msgs/Image; `changes` are fields to spoil."""
    message = Image(
        header=header(stamp),
        height=pixels.shape[0],
        width=pixels.shape[1],
        encoding=encoding,
        step=pixels.strides[0],
        data=array("B", pixels.tobytes()),
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


def color_message(stamp: int, scale: int = 1, **changes: Any) -> Image:
    return image_message(color(scale), "rgb8", stamp, **changes)


def depth_message(stamp: int, scale: int = 1, **changes: Any) -> Image:
    return image_message((depth(scale) * 1000.0).astype(np.uint16), "16UC1", stamp, **changes)


def compressed_color(stamp: int) -> CompressedImage:
    _, data = cv2.imencode(".png", color()[:, :, ::-1])
    return CompressedImage(
        header=header(stamp), format="rgb8; png compressed bgr8", data=array("B", data.tobytes())
    )


def compressed_depth(stamp: int) -> CompressedImage:
    _, data = cv2.imencode(".png", (depth() * 1000.0).astype(np.uint16))
    return CompressedImage(
        header=header(stamp), format="16UC1; compressedDepth png", data=array("B", bytes(12) + data.tobytes())
    )


def camera_info(stamp: int, scale: int = 1, **changes: Any) -> CameraInfo:
    model = camera(scale)
    message = CameraInfo(
        header=header(stamp),
        height=model.height,
        width=model.width,
        distortion_model="plumb_bob",
        d=[0.0] * 5,
        k=[model.fx, 0.0, model.cx, 0.0, model.fy, model.cy, 0.0, 0.0, 1.0],
        r=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p=[model.fx, 0.0, model.cx, 0.0, 0.0, model.fy, model.cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message
