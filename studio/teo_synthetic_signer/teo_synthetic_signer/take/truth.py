# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is known for certain about a rendered image."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel


@dataclass(frozen=True, eq=False, kw_only=True)
class Truth:
    """Where the keypoints of the rendered person are, and which of them the camera could see.

    Places are in the camera's optical frame (x right, y down, z forward) [m]; all are known, also of those
    that are hidden or outside the image. A keypoint is visible if it is in the image and nothing lies
    between it and the camera but its own skin.

    Attributes:
        body: Of BODY_25. Shape (25, 3).
        left_hand: Of HAND_21, the person's own left. Shape (21, 3).
        right_hand: Likewise.
        face: Of FACE_70. Shape (70, 3).
        body_visible: Shape (25,).
        left_hand_visible: Shape (21,).
        right_hand_visible: Shape (21,).
        face_visible: Shape (70,).
    """

    body: FloatArray
    left_hand: FloatArray
    right_hand: FloatArray
    face: FloatArray
    body_visible: BoolArray
    left_hand_visible: BoolArray
    right_hand_visible: BoolArray
    face_visible: BoolArray


@dataclass(frozen=True, eq=False, kw_only=True)
class TruthFrame:
    """What is true at one moment, with or without an image of it.

    Attributes:
        stamp: Since the start of the take [s].
        camera: That looks.
        truth: Where the keypoints of the signer are.
        others: And those of each companion.
    """

    stamp: float
    camera: CameraModel
    truth: Truth
    others: tuple[Truth, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class SyntheticFrame(TruthFrame):
    """One rendered image.

    Attributes:
        color: Red, green, blue. Shape (height, width, 3).
        depth: Along the optical axis, as the sensor model measures it [m]; NaN where it measures nothing.
            Shape (height, width), aligned to the colour image.
    """

    color: NDArray[np.uint8]
    depth: DepthArray
