# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A colour image with the depth of each of its pixels."""

from __future__ import annotations

from dataclasses import dataclass

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.color_image import ColorArray
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
