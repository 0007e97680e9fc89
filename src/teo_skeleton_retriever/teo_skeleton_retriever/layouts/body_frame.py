# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The coordinate frame of a body, in which movements do not depend on where the person stands and faces.

Axes as in REP-155: x out of the chest, y to the person's left, z towards the head.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen

# Up in an upright camera's optical frame.
CAMERA_UP = (0.0, -1.0, 0.0)
_MIN_SINE = 0.1  # the trunk and the line of the shoulders are never this close to parallel


@dataclass(frozen=True, eq=False)
class BodyFrame:
    """Where a body is and which way it faces.

    Attributes:
        origin: [m], in the camera's frame. Shape (3,).
        rotation: Its columns are the body's axes in the camera's frame. Shape (3, 3).
        anchor: Where the origin is: between the hips, or, while the hips are not seen, between the shoulders.
    """

    origin: FloatArray
    rotation: FloatArray
    anchor: Literal["hips", "shoulders"]

    def __post_init__(self) -> None:
        object.__setattr__(self, "origin", frozen(self.origin))
        object.__setattr__(self, "rotation", frozen(self.rotation))

    def from_camera(self, points: FloatArray) -> FloatArray:
        """Bring points of the camera's frame into the body's [m]. Shape (..., 3) each."""
        moved: FloatArray = (np.asarray(points, dtype=np.float64) - self.origin) @ self.rotation
        return moved

    def to_camera(self, points: FloatArray) -> FloatArray:
        """Bring points of the body's frame into the camera's [m]. Shape (..., 3) each."""
        moved: FloatArray = np.asarray(points, dtype=np.float64) @ self.rotation.T + self.origin
        return moved


def body_frame(
    *,
    left_shoulder: FloatArray,
    right_shoulder: FloatArray,
    left_hip: FloatArray | None = None,
    right_hip: FloatArray | None = None,
    up: FloatArray | tuple[float, float, float] = CAMERA_UP,
) -> BodyFrame | None:
    """Find the frame of a body.

    The line of the shoulders gives left and right exactly, the trunk gives up about: the shoulders are what
    signing is seen against, and the depth of hips behind a table or under clothes is poor.

    Args:
        left_shoulder: [m]. Shape (3,), as the others.
        right_shoulder: Likewise.
        left_hip: Likewise; None or not finite if not seen.
        right_hip: Likewise.
        up: Direction that stands in for the trunk while the hips are not seen.

    Returns:
        None if the shoulders are not seen or the points make no frame.
    """
    left_shoulder, right_shoulder = np.asarray(left_shoulder, float), np.asarray(right_shoulder, float)
    chest = (left_shoulder + right_shoulder) / 2.0
    hips = None if left_hip is None or right_hip is None else (np.asarray(left_hip) + right_hip) / 2.0
    anchored = hips is not None and bool(np.isfinite(hips).all())
    trunk = chest - hips if anchored and hips is not None else np.asarray(up, float)
    across = left_shoulder - right_shoulder
    lengths = float(np.linalg.norm(across)) * float(np.linalg.norm(trunk))
    if not np.isfinite(lengths) or lengths == 0.0:
        return None
    forward = _cross(across, trunk)
    if np.linalg.norm(forward) < _MIN_SINE * lengths:
        return None
    x = forward / np.linalg.norm(forward)
    y = across / np.linalg.norm(across)
    rotation = np.column_stack([x, y, _cross(x, y)])
    return BodyFrame(
        hips if anchored and hips is not None else chest, rotation, "hips" if anchored else "shoulders"
    )


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Vector product; numpy's takes ten times as long for two vectors."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
