# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Pictures and films of TEO, without a display: what other packages import."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path

import cv2

from teo_common.atomic_files import write_atomically
from teo_description.errors import DescriptionError
from teo_description.pictures.camera import CAMERAS, Camera
from teo_description.pictures.captions import captioned
from teo_description.pictures.film_strip import film_strip
from teo_description.pictures.motion_video import MotionVideo, write_video
from teo_description.pictures.renderer import Image, Renderer

__all__ = [
    "CAMERAS",
    "Camera",
    "Image",
    "MotionVideo",
    "Renderer",
    "captioned",
    "film_strip",
    "render_pose",
    "save_png",
    "write_video",
]

_own = threading.local()


def render_pose(positions: Mapping[str, float], camera: Camera | str = "front") -> Image:
    """Draw a pose with a renderer that each thread makes once; see `Renderer.render`."""
    if not hasattr(_own, "renderer"):
        _own.renderer = Renderer()
    renderer: Renderer = _own.renderer
    return renderer.render(positions, camera)


def save_png(path: Path, image: Image) -> None:
    """Write a picture as PNG, whole or not at all.

    Raises:
        DescriptionError: ``wrong_shape`` for an empty picture.
    """
    if image.size == 0:
        raise DescriptionError("wrong_shape", f"expected a picture, got an array of shape {image.shape}")
    _, encoded = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR))
    write_atomically(path, encoded.tobytes())
