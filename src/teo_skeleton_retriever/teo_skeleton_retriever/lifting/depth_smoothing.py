# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Depths that follow from lengths, smoothed by how sure each is."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solveh_banded

from teo_skeleton_retriever.arrays import FloatArray


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
