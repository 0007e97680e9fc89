# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pictures and films of a robot, without a display: what other packages import."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path

import cv2

from teo_common.atomic_files import write_atomically
from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT
from teo_description.pictures.camera import Camera, camera_named, cameras
from teo_description.pictures.captions import captioned
from teo_description.pictures.film_strip import film_strip
from teo_description.pictures.motion_video import MotionVideo, write_video
from teo_description.pictures.renderer import Image, Renderer
from teo_description.robot import Robot

__all__ = [
    "Camera",
    "Image",
    "MotionVideo",
    "Renderer",
    "camera_named",
    "cameras",
    "captioned",
    "film_strip",
    "render_pose",
    "save_png",
    "write_video",
]

_own = threading.local()


def render_pose(
    positions: Mapping[str, float], camera: Camera | str = "front", *, robot: str = DEFAULT_ROBOT
) -> Image:
    """Draw a pose with a renderer that each thread makes once for a robot; see `Renderer.render`."""
    renderers: dict[str, Renderer] = _own.__dict__.setdefault("renderers", {})
    if robot not in renderers:
        renderers[robot] = Renderer(Robot.load(robot))
    return renderers[robot].render(positions, camera)


def save_png(path: Path, image: Image) -> None:
    """Write a picture as PNG, whole or not at all.

    Raises:
        DescriptionError: ``wrong_shape`` for an empty picture.
    """
    if image.size == 0:
        raise DescriptionError("wrong_shape", f"expected a picture, got an array of shape {image.shape}")
    # A third of the size of OpenCV's own choice, for 20 ms a film strip.
    packed = (cv2.IMWRITE_PNG_COMPRESSION, 6)
    _, encoded = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), packed)
    write_atomically(path, encoded.tobytes())
