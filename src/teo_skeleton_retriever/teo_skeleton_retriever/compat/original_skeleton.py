"""What the original knows of one person at one time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.compat.body_planes import UNKNOWN_PLANES, BodyPlanes
from teo_skeleton_retriever.compat.skeleton_std import PARENTS, PIVOTS, SKELETON_STD

_N = len(SKELETON_STD)
_PARENT = [None if parent is None else SKELETON_STD.index[parent] for parent in PARENTS.values()]
_NEIGHBOURS = [[k for k in range(_N) if _PARENT[k] == i or _PARENT[i] == k] for i in range(_N)]


@dataclass(eq=False)
class OriginalSkeleton:
    """The 17 keypoints, in the order of `SKELETON_STD`. A stale keypoint keeps its last place.

    Attributes:
        points: [m], NaN if never seen. Shape (17, 3).
        pixels: [px], NaN if never seen or made from two others. Shape (17, 2).
        updated: whether each is of this image (or held). Shape (17,).
        planes: of the body.
    """

    points: FloatArray = field(default_factory=lambda: np.full((_N, 3), np.nan))
    pixels: FloatArray = field(default_factory=lambda: np.full((_N, 2), np.nan))
    updated: BoolArray = field(default_factory=lambda: np.zeros(_N, dtype=bool))
    planes: BodyPlanes = UNKNOWN_PLANES

    def copy(self) -> OriginalSkeleton:
        """Give a skeleton that does not change with this one."""
        return OriginalSkeleton(self.points.copy(), self.pixels.copy(), self.updated.copy(), self.planes)

    def pivots(self) -> FloatArray:
        """Pixels that people are told apart by; infinite if not seen themselves. Shape (2, 2)."""
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
