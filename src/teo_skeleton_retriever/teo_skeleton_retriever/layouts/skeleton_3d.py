# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People in space: keypoints with confidence, status and standard deviation."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.layouts.body_frame import BodyFrame
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21, Layout

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
