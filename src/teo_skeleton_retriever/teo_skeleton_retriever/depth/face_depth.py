# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depths of a face's 70 keypoints: measured where that is plausible for a head, smooth elsewhere."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, median
from teo_skeleton_retriever.depth.depth_lookup import Surfaces

_HEAD = 0.13  # [m] from the nose's tip to the ear: nothing of a face is farther from its middle
_OUTLIER = 0.015  # [m] off a smooth surface: half a nose
_SURFACE_SIGMA = 0.008  # [m] of a face about a smooth surface
_BEFORE = 0.04  # [m] no more of a face is before its middle: a nose
_ITERATIONS = 4
_LEAST = 8  # measured keypoints for a surface of six numbers


class FaceDepths(NamedTuple):
    """The depths of a face."""

    depths: FloatArray
    """of the skin [m]; NaN if nothing is known. Shape (70,)"""
    sigma: FloatArray
    """standard deviations [m]; NaN likewise. Shape (70,)"""
    measured: BoolArray
    """keypoints whose own surface was measured. Shape (70,)"""


def face_depths(rays: FloatArray, surfaces: Surfaces, expected: float) -> FaceDepths:
    """Find the depths of a face.

    A quadratic surface is fitted robustly; hair, a hand before the face, the wall beside the jaw are off it.

    Args:
        rays: x/z, y/z; NaN where the detector did not see the keypoint. Shape (n, 2).
        surfaces: Measured around each keypoint.
        expected: Depth of the face by the images before [m]; NaN if there were none.
    """
    n = len(rays)
    unknown = FaceDepths(np.full(n, np.nan), np.full(n, np.nan), np.zeros(n, dtype=bool))
    nearest = surfaces.closest(np.full(n, expected))
    usable = np.isfinite(rays).all(axis=1) & np.isfinite(nearest.depth)
    if usable.sum() < _LEAST:
        return unknown
    middle = median(nearest.depth[usable])
    if np.isfinite(expected) and abs(middle - expected) > _HEAD:
        middle = expected
    usable &= np.abs(nearest.depth - middle) < _HEAD
    if usable.sum() < _LEAST:
        return unknown
    centre = rays[usable].mean(axis=0)
    seen: BoolArray = np.asarray(np.isfinite(rays).all(axis=1))
    x, y = np.where(seen[:, None], (rays - centre) * middle / 0.1, 0.0).T  # about -1 to 1 on a face
    terms = np.column_stack([np.ones(n), x, y, x * x, x * y, y * y])
    fitted = np.full(n, middle)
    # What hides a part of a face is nearer than it.
    known = np.where(usable, nearest.depth, middle)
    weight = usable * (known > middle - _BEFORE)
    soft = 1e-3 * np.diag([0.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    for _ in range(_ITERATIONS):
        weighed = (terms * weight[:, None]).T
        fitted = terms @ np.linalg.solve(weighed @ terms + soft, weighed @ known)
        misfit = known - fitted
        weight = usable / (1.0 + (misfit / _OUTLIER) ** 2) ** 2
    measured = usable & (np.abs(misfit) < 2.0 * _OUTLIER)
    inside = np.abs(fitted - middle) < _HEAD
    depths = np.where(measured, nearest.depth, np.where(inside, fitted, middle))
    sigma = np.where(measured, np.hypot(nearest.sigma, 0.003), np.hypot(_SURFACE_SIGMA, _OUTLIER))
    return FaceDepths(np.where(seen, depths, np.nan), np.where(seen, sigma, np.nan), measured)
