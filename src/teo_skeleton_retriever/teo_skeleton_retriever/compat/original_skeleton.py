# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the original knows of one person at one time: 17 keypoints ("SkeletonStd") and the planes of the body.

Source: robotology/assistive-rehab, library `skeleton` and module `skeletonRetriever` (BSD-3-Clause).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.layouts.layout import Layout

# The parent of each keypoint, in the order of the data.
PARENTS: dict[str, str | None] = {
    "shoulderCenter": None,
    "head": "shoulderCenter",
    "shoulderLeft": "shoulderCenter",
    "elbowLeft": "shoulderLeft",
    "handLeft": "elbowLeft",
    "shoulderRight": "shoulderCenter",
    "elbowRight": "shoulderRight",
    "handRight": "elbowRight",
    "hipCenter": "shoulderCenter",
    "hipLeft": "hipCenter",
    "kneeLeft": "hipLeft",
    "ankleLeft": "kneeLeft",
    "footLeft": "ankleLeft",
    "hipRight": "hipCenter",
    "kneeRight": "hipRight",
    "ankleRight": "kneeRight",
    "footRight": "ankleRight",
}

SKELETON_STD = Layout(
    "SkeletonStd",
    tuple(PARENTS),
    tuple((parent, child) for child, parent in PARENTS.items() if parent is not None),
)

FROM_BODY_25: dict[str, str] = {
    "Nose": "head",
    "Neck": "shoulderCenter",
    "RShoulder": "shoulderRight",
    "RElbow": "elbowRight",
    "RWrist": "handRight",
    "LShoulder": "shoulderLeft",
    "LElbow": "elbowLeft",
    "LWrist": "handLeft",
    "MidHip": "hipCenter",
    "RHip": "hipRight",
    "RKnee": "kneeRight",
    "RAnkle": "ankleRight",
    "LHip": "hipLeft",
    "LKnee": "kneeLeft",
    "LAnkle": "ankleLeft",
    "LBigToe": "footLeft",
    "RBigToe": "footRight",
}

# What stands in where the keypoint of `FROM_BODY_25` was not seen.
FALLBACKS: dict[str, str] = {"footLeft": "LSmallToe", "footRight": "RSmallToe"}

# Where a centre was not seen itself, it is put between these two, without a pixel.
MIDPOINTS: dict[str, tuple[str, str]] = {
    "shoulderCenter": ("shoulderLeft", "shoulderRight"),
    "hipCenter": ("hipLeft", "hipRight"),
}

# People are told apart by the pixels of these; a skeleton with neither is refused.
_PIVOTS = ("shoulderCenter", "hipCenter")

# Limbs whose length is calibrated, each named by its far end.
LIMBS: tuple[str, ...] = (
    *("elbowLeft", "handLeft", "elbowRight", "handRight"),
    *("kneeLeft", "ankleLeft", "footLeft", "kneeRight", "ankleRight", "footRight"),
)

# Chains whose depths are optimised together.
CHAINS: tuple[tuple[str, ...], ...] = (
    ("shoulderLeft", "elbowLeft", "handLeft"),
    ("shoulderRight", "elbowRight", "handRight"),
    ("hipLeft", "kneeLeft", "ankleLeft", "footLeft"),
    ("hipRight", "kneeRight", "ankleRight", "footRight"),
)


class BodyPlanes(NamedTuple):
    """Normals of the planes; NaN while their keypoints were never seen. Shape (3,) each."""

    sagittal: FloatArray
    """unit, from the right shoulder to the left"""
    transverse: FloatArray
    """unit, from the centre of the hips to that of the shoulders"""
    coronal: FloatArray
    """sagittal x transverse, out of the chest; as long as the sine between the two, as in the original"""


_UNKNOWN_PLANES = BodyPlanes(*(np.full(3, np.nan) for _ in range(3)))


def body_planes(
    *,
    left_shoulder: FloatArray,
    right_shoulder: FloatArray,
    shoulder_center: FloatArray,
    hip_center: FloatArray,
    before: BodyPlanes = _UNKNOWN_PLANES,
) -> BodyPlanes:
    """Find the planes of a body.

    Args:
        left_shoulder: [m]; not finite if not seen. Shape (3,), as the others.
        right_shoulder: Likewise.
        shoulder_center: Likewise.
        hip_center: Likewise.
        before: What a normal stays at while its keypoints are not seen, or are in one place.
    """
    sagittal = _direction(right_shoulder, left_shoulder)
    transverse = _direction(hip_center, shoulder_center)
    side = before.sagittal if sagittal is None else sagittal
    up = before.transverse if transverse is None else transverse
    front = before.coronal if sagittal is None and transverse is None else np.cross(side, up)
    return BodyPlanes(side, up, front)


def _direction(start: FloatArray, end: FloatArray) -> FloatArray | None:
    step = np.asarray(end, dtype=np.float64) - np.asarray(start, dtype=np.float64)
    length = float(np.linalg.norm(step))
    return step / length if np.isfinite(length) and length > 0.0 else None


_N = len(SKELETON_STD)
_PARENT = [None if parent is None else SKELETON_STD.index[parent] for parent in PARENTS.values()]
_NEIGHBOURS = [[k for k in range(_N) if _PARENT[k] == i or _PARENT[i] == k] for i in range(_N)]


@dataclass(eq=False)
class OriginalSkeleton:
    """The 17 keypoints, in the order of `SKELETON_STD`. A stale keypoint keeps its last place.

    Attributes:
        points: [m], NaN if never seen. Shape (17, 3).
        pixels: [px], NaN if never seen or made from two others. Shape (17, 2).
        updated: Whether each is of this image (or held). Shape (17,).
        planes: Of the body.
    """

    points: FloatArray = field(default_factory=lambda: np.full((_N, 3), np.nan))
    pixels: FloatArray = field(default_factory=lambda: np.full((_N, 2), np.nan))
    updated: BoolArray = field(default_factory=lambda: np.zeros(_N, dtype=bool))
    planes: BodyPlanes = _UNKNOWN_PLANES

    def copy(self) -> OriginalSkeleton:
        """Give a skeleton that does not change with this one."""
        return OriginalSkeleton(self.points.copy(), self.pixels.copy(), self.updated.copy(), self.planes)

    def pivots(self) -> FloatArray:
        """Pixels of `_PIVOTS`, by which people are told apart; infinite if not updated. Shape (2, 2)."""
        rows = [SKELETON_STD.index[name] for name in _PIVOTS]
        seen = self.updated[rows, None] & np.isfinite(self.pixels[rows])
        pixels: FloatArray = np.where(seen, self.pixels[rows], np.inf)
        return pixels

    def max_path(self) -> float:
        """Length of the longest path through updated keypoints [m]."""
        return max((self._longest_from(i, None) for i in range(_N) if self.updated[i]), default=0.0)

    def _longest_from(self, i: int, came_from: int | None) -> float:
        longest = 0.0
        for k in _NEIGHBOURS[i]:
            if k != came_from and self.updated[k]:
                bone = float(np.linalg.norm(self.points[k] - self.points[i]))
                longest = max(longest, bone + self._longest_from(k, i))
        return longest
