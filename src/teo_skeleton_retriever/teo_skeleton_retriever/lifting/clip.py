# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's points in the picture over time: what is lifted into space, and depths smoothed over time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solveh_banded

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.layouts.person_layout import BODY, HANDS, ROW

SIDES = ("right", "left")
# Rows of BODY_25, by side.
SHOULDER, ELBOW, WRIST, HIP = (
    {"right": ROW[f"R{joint}"], "left": ROW[f"L{joint}"]} for joint in ("Shoulder", "Elbow", "Wrist", "Hip")
)


@dataclass(frozen=True, kw_only=True, eq=False)
class Points:
    """Points of one part of a person over time.

    Attributes:
        places: Forward (to the viewer), to the signer's left, up; in the units of the clip. Depth, the first,
            is only good relative to other points of the part, in a unit of its own, and NaN where the
            layout has none; all three are NaN where the point was not seen. Shape (T, K, 3).
        confidence: 0 to 1; 0 where not seen. Shape (T, K).
    """

    places: FloatArray
    confidence: FloatArray

    @property
    def seen(self) -> BoolArray:
        """Whether a point was seen. Shape (T, K)."""
        return self.confidence > 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class PoseClip:
    """A person in a picture over time.

    Attributes:
        rate: Frames a second [Hz].
        body: BODY_25; what is not used in signing is not seen.
        left_hand: The person's own left, 21 points.
        right_hand: Likewise.
        source: Name of the file.
    """

    rate: float
    body: Points
    left_hand: Points
    right_hand: Points
    source: str

    def with_parts(self, part: Callable[[Points, slice], Points]) -> PoseClip:
        """The clip with other points, each part by its own and its rows in `layouts.person_layout`."""
        return replace(
            self,
            body=part(self.body, BODY),
            left_hand=part(self.left_hand, HANDS["L"]),
            right_hand=part(self.right_hand, HANDS["R"]),
        )

    def hand(self, side: str) -> Points:
        """The hand of a side, "right" or "left"."""
        return self.right_hand if side == "right" else self.left_hand


def smooth_depth(depths: FloatArray, sigmas: FloatArray, *, period: float, acceleration: float) -> FloatArray:
    """The most likely depths, where accelerations are as large as given and measurements as sure.

    Least squares of both, after Whittaker (1923). A limb that lies across the view has a depth that a pixel
    changes by centimetres; the frames before and after know it better.

    Args:
        depths: Measured [m]; NaN where not. Shape (T, k).
        sigmas: Standard deviations [m]. Shape (T, k).
        period: Between two frames [s].
        acceleration: Standard deviation of the acceleration [m/s^2].

    Returns:
        Depths in all frames [m]; NaN in columns without a measurement. Shape (T, k).
    """
    count = len(depths)
    if count < 3:
        return depths
    # Second differences D, as the bands of D'D.
    difference = np.zeros((3, count))
    stiffness = 1.0 / (acceleration * period**2) ** 2
    for row in range(count - 2):
        difference[2, row : row + 3] += stiffness * np.array([1.0, 4.0, 1.0])
        difference[1, row + 1 : row + 3] += stiffness * np.array([-2.0, -2.0])
        difference[0, row + 2] += stiffness
    smooth = np.full_like(depths, np.nan)
    for column in range(depths.shape[1]):
        known = np.isfinite(depths[:, column])
        if known.sum() < 2:
            smooth[:, column] = depths[known, column].mean() if known.any() else np.nan
            continue
        weights = np.where(known, 1.0 / np.where(known, sigmas[:, column], 1.0) ** 2, 0.0)
        bands = difference.copy()
        bands[2] += weights
        smooth[:, column] = solveh_banded(bands, weights * np.where(known, depths[:, column], 0.0))
    return smooth
