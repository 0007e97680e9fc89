"""OpenPose's COCO model: 18 body keypoints, no mid-hip and no feet. Source: `poseParameters.cpp`."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.body_25 import BODY_25
from teo_skeleton_retriever.layouts.layout import Layout, bones_of
from teo_skeleton_retriever.layouts.midpoint import midpoint

_KEYPOINTS = (
    *("Nose", "Neck"),  # 0, 1
    *("RShoulder", "RElbow", "RWrist"),  # 2 to 4
    *("LShoulder", "LElbow", "LWrist"),  # 5 to 7
    *("RHip", "RKnee", "RAnkle"),  # 8 to 10
    *("LHip", "LKnee", "LAnkle"),  # 11 to 13
    *("REye", "LEye", "REar", "LEar"),  # 14 to 17
)
_PAIRS = "1-2 1-5 2-3 3-4 5-6 6-7 1-8 8-9 9-10 1-11 11-12 12-13 1-0 0-14 14-16 0-15 15-17"

COCO_18 = Layout("COCO", _KEYPOINTS, bones_of(_KEYPOINTS, _PAIRS))


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
