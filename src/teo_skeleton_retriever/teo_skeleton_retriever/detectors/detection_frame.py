# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the retriever is given for one image."""

from __future__ import annotations

import math
from dataclasses import dataclass

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.person_2d import Person2D


@dataclass(frozen=True, eq=False)
class DetectionFrame:
    """One image: who was seen in it, and its depth.

    Attributes:
        stamp: When it was taken [s].
        people: What the detector saw, in no particular order.
        depth: Along the optical axis [m], aligned to the colour image, NaN (or 0) where unknown.
            Shape (height, width).
        camera: Of both.

    Raises:
        RetrieverError: The stamp is not finite or the depth image has not the camera's size.
    """

    stamp: float
    people: tuple[Person2D, ...]
    depth: DepthArray
    camera: CameraModel

    def __post_init__(self) -> None:
        if not math.isfinite(self.stamp):
            raise RetrieverError("bad_stamp", f"expected a finite time [s], got {self.stamp}")
        size = (self.camera.height, self.camera.width)
        if self.depth.shape != size:
            raise RetrieverError(
                "wrong_size",
                f"expected depth of the camera's {size[1]} x {size[0]} px, got shape {self.depth.shape}; "
                "align depth to colour and take the camera_info of that resolution",
            )
