# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keypoints in space from the state of a `KeypointFilter`."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.depth.viewing_rays import ViewingRays
from teo_skeleton_retriever.layouts.skeleton_3d import Keypoints3D, KeypointStatus
from teo_skeleton_retriever.tracking.keypoint_filter import FilterOutput


def points_of(output: FilterOutput) -> FloatArray:
    """Estimated positions [m]; NaN where lost. Shape (n, 3)."""
    points: FloatArray = np.column_stack([output.rays, np.ones(len(output.depth))]) * output.depth[:, None]
    return points


def keypoints_of(
    output: FilterOutput,
    seen: ViewingRays,
    *,
    optimised: BoolArray,
    hidden: BoolArray,
    bias: FloatArray,
    max_sigma: FloatArray,
    memory: FloatArray,
) -> Keypoints3D:
    """Make keypoints with status, confidence and sigma of a filter's estimate.

    Args:
        output: Of the filter.
        seen: By the detector in this image.
        optimised: Keypoints whose depth of this image follows from others. Shape (n,).
        hidden: Keypoints before which something else lies in this image: held, though the detector guesses
            them. Shape (n,).
        bias: Standard deviation across the ray and along it of what no averaging removes: how the detector
            and the skin differ from person to person [m]. Shape (n, 2).
        max_sigma: Keypoints less certain than this are lost [m]. Shape (n,).
        memory: Confidence that each was last seen with. Shape (n,).
    """
    points = points_of(output)
    across = np.hypot(output.sigma[:, :2] * output.depth[:, None], bias[:, :1])
    along = np.hypot(output.sigma[:, 2], bias[:, 1])
    sigma = np.column_stack([np.hypot(across, output.rays * along[:, None]), along])
    with np.errstate(invalid="ignore"):
        lost = ~(sigma.max(axis=1) <= max_sigma)
    status = np.where(
        seen.seen & output.fresh & ~hidden,
        np.where(optimised, KeypointStatus.OPTIMISED, KeypointStatus.MEASURED),
        KeypointStatus.HELD,
    )
    return Keypoints3D(
        points=np.where(lost[:, None], np.nan, points),
        confidence=np.where(lost, 0.0, np.where(seen.seen, seen.confidence, memory)),
        status=np.where(lost, KeypointStatus.LOST, status).astype(np.uint8),
        sigma=np.where(lost[:, None], np.nan, sigma),
        pixels=seen.pixels,
    )
