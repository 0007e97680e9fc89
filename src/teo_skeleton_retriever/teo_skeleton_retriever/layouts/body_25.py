"""OpenPose's BODY_25: body with feet. Source: `poseParameters.cpp` of OpenPose 1.7, its documentation."""

from __future__ import annotations

from teo_skeleton_retriever.layouts.layout import Layout, bones_of

_KEYPOINTS = (
    *("Nose", "Neck"),  # 0, 1
    *("RShoulder", "RElbow", "RWrist"),  # 2 to 4
    *("LShoulder", "LElbow", "LWrist"),  # 5 to 7
    "MidHip",  # 8
    *("RHip", "RKnee", "RAnkle"),  # 9 to 11
    *("LHip", "LKnee", "LAnkle"),  # 12 to 14
    *("REye", "LEye", "REar", "LEar"),  # 15 to 18
    *("LBigToe", "LSmallToe", "LHeel"),  # 19 to 21
    *("RBigToe", "RSmallToe", "RHeel"),  # 22 to 24
)
_PAIRS = """
    1-8 1-2 1-5 2-3 3-4 5-6 6-7 8-9 9-10 10-11 8-12 12-13 13-14
    1-0 0-15 15-17 0-16 16-18 14-19 19-20 14-21 11-22 22-23 11-24
"""

BODY_25 = Layout("BODY_25", _KEYPOINTS, bones_of(_KEYPOINTS, _PAIRS))
