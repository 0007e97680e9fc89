# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The original's depth filter: widens near contours, so that a keypoint beside the body still lands on it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from teo_skeleton_retriever.arrays import DepthArray
from teo_skeleton_retriever.errors import RetrieverError


@dataclass(frozen=True, kw_only=True)
class ContourDilation:
    """Minimum filter over depth (morphological erosion): near surfaces grow, holes are filled.

    The defaults are those in the code of the original (its shipped configurations: 8 px twice at 0.6 to 5 m,
    off; 24 px twelve times at 1 to 6 m). It moves depth towards the camera by what the surface falls off in
    `kernel_size * iterations / 2` pixels.

    Attributes:
        kernel_size: Diameter of the elliptical window [px]. An even one reaches further to the left and up.
        iterations: How often the window is applied.
        min_distance: Nearer is taken as noise and does not grow [m].
        max_distance: Farther is taken as background and becomes unknown [m].

    Raises:
        RetrieverError: A value makes no filter.
    """

    kernel_size: int = 4
    iterations: int = 3
    min_distance: float = 1.0
    max_distance: float = 4.0

    def __post_init__(self) -> None:
        if self.kernel_size < 1 or self.iterations < 0:
            raise RetrieverError(
                "bad_kernel",
                f"expected a kernel >= 1 px, iterations >= 0, got {self.kernel_size}, {self.iterations}",
            )
        if not (math.isfinite(self.min_distance) and 0.0 <= self.min_distance < self.max_distance):
            raise RetrieverError(
                "bad_range",
                f"expected 0 <= min_distance < max_distance, got {self.min_distance}, {self.max_distance}",
            )

    def apply(self, depth: DepthArray) -> DepthArray:
        """Filter one image.

        Args:
            depth: [m], NaN or 0 where unknown. Shape (height, width).

        Returns:
            [m], NaN where unknown. Shape (height, width).
        """
        far = np.float32(np.finfo(np.float32).max)
        with np.errstate(invalid="ignore"):
            known = np.where(depth >= np.float32(self.min_distance), depth, far).astype(np.float32)
        if self.iterations and known.size:
            window = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (self.kernel_size, self.kernel_size))
            known = cv2.erode(known, window, iterations=self.iterations).astype(np.float32)
        known[~(known <= np.float32(self.max_distance))] = np.nan
        known[known <= 0.0] = np.nan
        return known
