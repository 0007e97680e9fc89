# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the original knows of one person at one time: 17 keypoints and the planes of the body."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.compat.skeleton_std import PARENTS, PIVOTS, SKELETON_STD


class BodyPlanes(NamedTuple):
    """Normals of the planes; NaN while their keypoints were never seen. Shape (3,) each."""

    sagittal: FloatArray
    """unit, from the right shoulder to the left"""
    transverse: FloatArray
    """unit, from the centre of the hips to that of the shoulders"""
    coronal: FloatArray
    """sagittal x transverse, out of the chest; as long as the sine between the two, as in the original"""


UNKNOWN_PLANES = BodyPlanes(*(np.full(3, np.nan) for _ in range(3)))


def body_planes(
    *,
    left_shoulder: FloatArray,
    right_shoulder: FloatArray,
    shoulder_center: FloatArray,
    hip_center: FloatArray,
    before: BodyPlanes = UNKNOWN_PLANES,
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
    planes: BodyPlanes = UNKNOWN_PLANES

    def copy(self) -> OriginalSkeleton:
        """Give a skeleton that does not change with this one."""
        return OriginalSkeleton(self.points.copy(), self.pixels.copy(), self.updated.copy(), self.planes)

    def pivots(self) -> FloatArray:
        """Pixels of `PIVOTS`, by which people are told apart; infinite if not updated. Shape (2, 2)."""
        rows = [SKELETON_STD.index[name] for name in PIVOTS]
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
