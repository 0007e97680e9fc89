# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People in space: keypoints with confidence, status and standard deviation, and the frame of a body.

Movements seen in the body's frame do not depend on where the person stands and faces. Its axes are those of
REP-155: x out of the chest, y to the person's left, z towards the head.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21, Layout

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


def frame_of_body(body: FloatArray) -> BodyFrame | None:
    """The frame of a body by its 25 keypoints, NaN where not known [m]; None as in `body_frame`."""
    return body_frame(
        left_shoulder=body[BODY_25.index["LShoulder"]],
        right_shoulder=body[BODY_25.index["RShoulder"]],
        left_hip=body[BODY_25.index["LHip"]],
        right_hip=body[BODY_25.index["RHip"]],
    )


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Vector product; numpy's takes ten times as long for two vectors."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


# The parts of a skeleton and the layout of each.
SKELETON_PARTS: dict[str, Layout] = {
    "body": BODY_25,
    "left_hand": HAND_21,
    "right_hand": HAND_21,
    "face": FACE_70,
}


class KeypointStatus(IntEnum):
    """How the position of a keypoint was found."""

    LOST = 0
    """not known: never seen, or not for too long"""
    MEASURED = 1
    """seen by the detector, and its depth measured"""
    HELD = 2
    """not seen now, where it was last or is by the keypoints around it"""
    OPTIMISED = 3
    """seen by the detector; its depth follows from the lengths of limbs or the shape of the hand"""


@dataclass(frozen=True, eq=False)
class Keypoints3D:
    """The keypoints of one part of a person, in the order of its layout.

    Attributes:
        points: Centres of the joints in the camera's optical frame (x right, y down, z forward) [m]; NaN
            where lost. Shape (n, 3).
        confidence: Of the detector, 0 to 1; 0 where lost. Shape (n,).
        status: Of `KeypointStatus`. Shape (n,).
        sigma: Standard deviation along x, y and z [m]; NaN where lost. Shape (n, 3).
        pixels: Where the detector saw it [px]; NaN where it did not. Shape (n, 2).
    """

    points: FloatArray
    confidence: FloatArray
    status: NDArray[np.uint8]
    sigma: FloatArray
    pixels: FloatArray

    def __post_init__(self) -> None:
        for name in ("points", "confidence", "sigma", "pixels"):
            object.__setattr__(self, name, frozen(getattr(self, name)))
        status = np.array(self.status, dtype=np.uint8)
        status.flags.writeable = False
        object.__setattr__(self, "status", status)

    @classmethod
    def lost(cls, n: int) -> Keypoints3D:
        """Give n keypoints of which nothing is known."""
        return cls(
            points=np.full((n, 3), np.nan),
            confidence=np.zeros(n),
            status=np.zeros(n, dtype=np.uint8),
            sigma=np.full((n, 3), np.nan),
            pixels=np.full((n, 2), np.nan),
        )

    def part(self, rows: slice) -> Keypoints3D:
        """Keep some of the keypoints."""
        return Keypoints3D(
            self.points[rows], self.confidence[rows], self.status[rows], self.sigma[rows], self.pixels[rows]
        )

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True, eq=False, kw_only=True)
class Skeleton:
    """One person at the time of one image.

    Attributes:
        track_id: Stays with the person through crossings and gaps; never given to another.
        is_signer: Whether this is the one person whose signing is followed.
        body: In BODY_25.
        left_hand: In HAND_21, the person's own left.
        right_hand: Likewise.
        face: In FACE_70.
        body_frame: The person's own frame, x out of the chest; None while the shoulders are not known.
    """

    track_id: int
    is_signer: bool
    body: Keypoints3D
    left_hand: Keypoints3D
    right_hand: Keypoints3D
    face: Keypoints3D
    body_frame: BodyFrame | None
