"""The keypoint between two keypoints."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray


def midpoint(first: FloatArray, second: FloatArray) -> FloatArray:
    """Mean position with the lower confidence; absent (zero) if either is absent.

    Args:
        first: x, y [px], confidence. Shape (3,).
        second: likewise.
    """
    confidence = min(first[2], second[2])
    if not confidence > 0.0:
        return np.zeros(3)
    x, y = (first[:2] + second[:2]) / 2.0
    return np.array([x, y, confidence])
