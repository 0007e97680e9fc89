# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The 17 keypoints of the original skeletonRetriever ("SkeletonStd"), their tree and where they come from.

Source: robotology/assistive-rehab, library `skeleton` and module `skeletonRetriever` (BSD-3-Clause).
"""

from __future__ import annotations

from teo_skeleton_retriever.layouts.layout import Layout

# The parent of each keypoint, in the order of the data.
PARENTS: dict[str, str | None] = {
    "shoulderCenter": None,
    "head": "shoulderCenter",
    "shoulderLeft": "shoulderCenter",
    "elbowLeft": "shoulderLeft",
    "handLeft": "elbowLeft",
    "shoulderRight": "shoulderCenter",
    "elbowRight": "shoulderRight",
    "handRight": "elbowRight",
    "hipCenter": "shoulderCenter",
    "hipLeft": "hipCenter",
    "kneeLeft": "hipLeft",
    "ankleLeft": "kneeLeft",
    "footLeft": "ankleLeft",
    "hipRight": "hipCenter",
    "kneeRight": "hipRight",
    "ankleRight": "kneeRight",
    "footRight": "ankleRight",
}

SKELETON_STD = Layout(
    "SkeletonStd",
    tuple(PARENTS),
    tuple((parent, child) for child, parent in PARENTS.items() if parent is not None),
)

FROM_BODY_25: dict[str, str] = {
    "Nose": "head",
    "Neck": "shoulderCenter",
    "RShoulder": "shoulderRight",
    "RElbow": "elbowRight",
    "RWrist": "handRight",
    "LShoulder": "shoulderLeft",
    "LElbow": "elbowLeft",
    "LWrist": "handLeft",
    "MidHip": "hipCenter",
    "RHip": "hipRight",
    "RKnee": "kneeRight",
    "RAnkle": "ankleRight",
    "LHip": "hipLeft",
    "LKnee": "kneeLeft",
    "LAnkle": "ankleLeft",
    "LBigToe": "footLeft",
    "RBigToe": "footRight",
}

# What stands in where the keypoint of `FROM_BODY_25` was not seen.
FALLBACKS: dict[str, str] = {"footLeft": "LSmallToe", "footRight": "RSmallToe"}

# Where a centre was not seen itself, it is put between these two, without a pixel.
MIDPOINTS: dict[str, tuple[str, str]] = {
    "shoulderCenter": ("shoulderLeft", "shoulderRight"),
    "hipCenter": ("hipLeft", "hipRight"),
}

# People are told apart by the pixels of these; a skeleton with neither is refused.
PIVOTS = ("shoulderCenter", "hipCenter")

# Limbs whose length is calibrated, each named by its far end.
LIMBS: tuple[str, ...] = (
    *("elbowLeft", "handLeft", "elbowRight", "handRight"),
    *("kneeLeft", "ankleLeft", "footLeft", "kneeRight", "ankleRight", "footRight"),
)

# Chains whose depths are optimised together.
CHAINS: tuple[tuple[str, ...], ...] = (
    ("shoulderLeft", "elbowLeft", "handLeft"),
    ("shoulderRight", "elbowRight", "handRight"),
    ("hipLeft", "kneeLeft", "ankleLeft", "footLeft"),
    ("hipRight", "kneeRight", "ankleRight", "footRight"),
)
