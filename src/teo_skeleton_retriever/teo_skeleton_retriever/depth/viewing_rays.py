# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keypoints of a detector as viewing rays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel


class ViewingRays(NamedTuple):
    """Keypoints in one image; not seen ones are NaN with confidence 0."""

    pixels: FloatArray
    """[px]. Shape (n, 2)"""
    rays: FloatArray
    """x/z, y/z. Shape (n, 2)"""
    confidence: FloatArray
    """0 to 1. Shape (n,)"""
    seen: BoolArray
    """Shape (n,)"""

    def only(self, believed: BoolArray) -> ViewingRays:
        """Treat keypoints that are not believed as not seen."""
        return ViewingRays(
            np.where(believed[:, None], self.pixels, np.nan),
            np.where(believed[:, None], self.rays, np.nan),
            np.where(believed, self.confidence, 0.0),
            self.seen & believed,
        )

    def part(self, rows: slice) -> ViewingRays:
        """Keep some of the keypoints."""
        return ViewingRays(self.pixels[rows], self.rays[rows], self.confidence[rows], self.seen[rows])


def viewing_rays(keypoints: FloatArray, camera: CameraModel, min_confidence: float) -> ViewingRays:
    """Keep the keypoints that are in the image and that the detector is sure of.

    Args:
        keypoints: x, y [px], confidence. Shape (n, 3).
        camera: Of the image.
        min_confidence: Of the detector; 0 means absent in every layout, whatever is asked.
    """
    seen = (keypoints[:, 2] >= min_confidence) & (keypoints[:, 2] > 0.0) & camera.contains(keypoints[:, :2])
    pixels = np.where(seen[:, None], keypoints[:, :2], np.nan)
    rays = np.full((len(keypoints), 2), np.nan)
    rays[seen] = camera.rays(pixels[seen])[:, :2]
    seen &= np.isfinite(rays).all(axis=1)  # a lens may image nothing there
    confidence = np.where(seen, np.clip(keypoints[:, 2], 0.0, 1.0), 0.0)
    return ViewingRays(pixels, rays, confidence, seen)
