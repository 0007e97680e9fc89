# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bodies of every layout that a detector gives, as BODY_25."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18


def midpoint(first: FloatArray, second: FloatArray) -> FloatArray:
    """Mean position with the lower confidence; absent (zero) if either is absent.

    Args:
        first: x, y [px], confidence. Shape (3,).
        second: Likewise.
    """
    confidence = min(first[2], second[2])
    if not confidence > 0.0:
        return np.zeros(3)
    x, y = (first[:2] + second[:2]) / 2.0
    return np.array([x, y, confidence])


# The 15 keypoints of OpenPose's MPI model. Source: `poseParameters.cpp` of OpenPose 1.7.
_MPI: tuple[str | None, ...] = (
    *(None, "Neck"),  # the top of the head is no keypoint of BODY_25
    *("RShoulder", "RElbow", "RWrist", "LShoulder", "LElbow", "LWrist"),
    *("RHip", "RKnee", "RAnkle", "LHip", "LKnee", "LAnkle"),
    None,  # nor is the chest
)


def body_25_from_coco_18(body: FloatArray) -> FloatArray:
    """Bring COCO keypoints into BODY_25: same names, mid-hip between the hips, feet absent.

    Args:
        body: x, y [px], confidence. Shape (18, 3).

    Returns:
        x, y [px], confidence; absent keypoints are zero. Shape (25, 3).
    """
    out = np.zeros((len(BODY_25), 3))
    for name, row in zip(COCO_18.keypoints, body, strict=True):
        out[BODY_25.index[name]] = row
    out[BODY_25.index["MidHip"]] = midpoint(body[COCO_18.index["RHip"]], body[COCO_18.index["LHip"]])
    return out


def as_body_25(body: FloatArray) -> FloatArray:
    """Bring a body into BODY_25.

    Args:
        body: x, y [px], confidence, in BODY_25, COCO or MPI; or no rows. Shape (n, 3).

    Returns:
        x, y [px], confidence; absent keypoints are zero. Shape (25, 3).

    Raises:
        RetrieverError: Another number of keypoints.
    """
    if len(body) == len(BODY_25):
        return body
    if len(body) == len(COCO_18):
        return body_25_from_coco_18(body)
    out = np.zeros((len(BODY_25), 3))
    if len(body) == 0:
        return out
    if len(body) != len(_MPI):
        raise RetrieverError("wrong_layout", f"expected BODY_25, COCO or MPI, got {len(body)} keypoints")
    for name, row in zip(_MPI, body, strict=True):
        if name is not None:
            out[BODY_25.index[name]] = row
    out[BODY_25.index["MidHip"]] = midpoint(out[BODY_25.index["RHip"]], out[BODY_25.index["LHip"]])
    return out
