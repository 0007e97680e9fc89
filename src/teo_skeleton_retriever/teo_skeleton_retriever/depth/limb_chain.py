# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depths along a limb as an optimisation problem: known lengths, fixed rays, bounded depths.

Source: `LimbOptimizer` of the original skeletonRetriever. With y_i(z) = z ray_i the depths minimise

    sum_i (|y_i - y_(i+1)|^2 - L_i^2)^2,    lower_i <= z_i <= upper_i.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError

NEAREST = 0.01  # [m] no depth is bounded below this
END_FREEDOM = 0.01  # [m] how far the first and last keypoint may move away from the camera
JOINT_FREEDOM = (
    0.30  # [m] how far the ones between may: the sensor sees the skin, or something before the joint
)


@dataclass(frozen=True, eq=False, kw_only=True)
class LimbChain:
    """One limb of one person in one image.

    Attributes:
        rays: x/z, y/z of each keypoint. Shape (n, 2), n >= 2.
        lengths: From each keypoint to the next [m]. Shape (n - 1,).
        start: Depths to start from [m]. Shape (n,).
        lower: Least depths [m]. Shape (n,).
        upper: Greatest depths [m]. Shape (n,).

    Raises:
        RetrieverError: Shapes that do not fit, a number that is not finite, a length not above zero or bounds
            that leave no room.
    """

    rays: FloatArray
    lengths: FloatArray
    start: FloatArray
    lower: FloatArray
    upper: FloatArray

    def __post_init__(self) -> None:
        n = len(self.rays)
        shapes = {"rays": (n, 2), "lengths": (n - 1,), "start": (n,), "lower": (n,), "upper": (n,)}
        for name, shape in shapes.items():
            array = frozen(getattr(self, name))
            if n < 2 or array.shape != shape:
                raise RetrieverError(
                    "wrong_shape", f"{name}: expected shape {shape} with n of 2 or more, got {array.shape}"
                )
            if not np.isfinite(array).all():
                raise RetrieverError("not_finite", f"{name}: expected finite numbers, got {array}")
            object.__setattr__(self, name, array)
        if not (self.lengths > 0.0).all():
            raise RetrieverError("bad_length", f"expected lengths above 0 m, got {self.lengths}")
        if not ((self.lower > 0.0) & (self.lower < self.upper)).all():
            raise RetrieverError(
                "bad_bounds", f"expected 0 < lower < upper, got {self.lower} and {self.upper}"
            )

    @classmethod
    def original(cls, points: FloatArray, lengths: FloatArray, *, anchor_depth: float) -> LimbChain:
        """Build the problem that the original solves.

        Args:
            points: Filtered keypoints from the body outwards [m]. Shape (n, 3).
            lengths: [m]. Shape (n - 1,).
            anchor_depth: Depth of the centre that the limb hangs from (shoulders or hips) [m]: the limb's
                first keypoint is put at this depth, whatever its own.
        """
        points = np.asarray(points, dtype=np.float64)
        measured = points[:, 2].copy()
        measured[0] = anchor_depth
        lower = np.maximum(measured, NEAREST)
        freedom = np.full(len(points), JOINT_FREEDOM)
        freedom[[0, -1]] = END_FREEDOM
        return cls(
            rays=points[:, :2] / points[:, 2:],
            lengths=np.asarray(lengths, dtype=np.float64),
            start=measured,
            lower=lower,
            upper=lower + freedom,
        )

    def points(self, depths: FloatArray) -> FloatArray:
        """Give the keypoints at these depths [m]. Shape (n, 3)."""
        return np.column_stack([self.rays * depths[:, None], depths])

    def residuals(self, depths: FloatArray) -> FloatArray:
        """Squared lengths less the known ones [m^2]. Shape (n - 1,)."""
        steps = np.diff(self.points(depths), axis=0)
        missed: FloatArray = (steps**2).sum(axis=1) - self.lengths**2
        return missed

    def cost(self, depths: FloatArray) -> float:
        """Objective: sum of the squared residuals [m^4]."""
        return float((self.residuals(depths) ** 2).sum())


class LimbSolution(NamedTuple):
    """Solution for the depths of a limb."""

    depths: FloatArray
    """[m]. Shape (n,)"""
    converged: bool
    """if not, the depths are to be left as they were"""
