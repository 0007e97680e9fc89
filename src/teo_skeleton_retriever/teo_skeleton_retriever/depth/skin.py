# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From the skin, which a depth camera sees, to the centre of the joint behind it.

A joint is taken for where round limbs end: the ray to the centre meets the skin earlier by the limb's radius,
and by more where a limb comes towards the camera. Radii are in proportion to the person's size.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, HAND_21

# [m] From the skin to the joint, of an average adult, seen across the limb.
_BODY_DEPTH: dict[str, float] = {
    "Nose": -0.012,
    "Neck": 0.06,
    **dict.fromkeys(("RShoulder", "LShoulder"), 0.057),
    **dict.fromkeys(("RElbow", "LElbow"), 0.043),
    **dict.fromkeys(("RWrist", "LWrist"), 0.022),
    "MidHip": 0.15,
    **dict.fromkeys(("RHip", "LHip"), 0.125),
    **dict.fromkeys(("RKnee", "LKnee"), 0.08),
    **dict.fromkeys(("RAnkle", "LAnkle"), 0.05),
    **dict.fromkeys(("REye", "LEye"), 0.0),
    **dict.fromkeys(("REar", "LEar"), 0.019),
    **dict.fromkeys(("LBigToe", "LSmallToe", "LHeel", "RBigToe", "RSmallToe", "RHeel"), 0.02),
}

# [m] Likewise.
_HAND_DEPTH: dict[str, float] = {
    name: 0.025
    if name == "Wrist"
    else 0.015
    if name.endswith(("CMC", "MCP"))
    else 0.009
    if name.endswith(("PIP", "DIP", "IP"))
    else 0.004
    for name in HAND_21.keypoints
}

_LEAST_SINE = 0.65  # of the angle between ray and limb: a limb that points at the camera ends in its tip

# [m] Half the thickness of a forearm between elbow and wrist, of an average adult. The ray to an elbow whose
# forearm comes towards the camera goes through the forearm: its skin is what is seen there.
FOREARM_RADIUS = 0.035
# Of the angle between ray and forearm: of a steeper one the ray leaves through the hand, 0.24 m before it.
FOREARM_LEAST_SINE = 0.15

# How far a limb reaches beyond a joint, of the depth under the skin across the limb: a bent elbow's tip is 2
# cm from its axis, a kneecap 5 cm from the knee's. A shoulder is a ball.
_CAP = {"Elbow": 0.5, "Knee": 0.6}

BODY_DEPTHS: FloatArray = np.array([_BODY_DEPTH[name] for name in BODY_25.keypoints])
BODY_CAPS: FloatArray = np.array([_CAP.get(name[1:], 1.0) for name in BODY_25.keypoints])
HAND_DEPTHS: FloatArray = np.array([_HAND_DEPTH[name] for name in HAND_21.keypoints])


def along_ray(
    radius: FloatArray,
    limb: FloatArray,
    ray: FloatArray,
    cap: FloatArray,
    *,
    least_sine: float = _LEAST_SINE,
) -> FloatArray:
    """Give how far behind the skin joints lie, along the optical axis [m].

    A limb that comes towards the camera is a tube: the ray is longer in it the more it slants. Of one that
    leads away the ray meets the end, which is round: half an ellipsoid.

    Args:
        radius: Of the limb at each joint [m]. Shape (n,).
        limb: Way from each joint along its limb, of any length; NaN or zero if not known. Shape (n, 3).
        ray: From the camera to each joint, of any length. Shape (n, 3).
        cap: How far the limb's end reaches beyond the joint, of the radius. Shape (n,).
        least_sine: Of the angle between ray and limb: below it the ray leaves through the limb's far end.
    """
    squares = (limb * limb).sum(axis=1) * (ray * ray).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        away = np.where(squares > 0.0, (limb * ray).sum(axis=1) / np.sqrt(squares), 0.0)
    shares = np.where(away < 0.0, np.maximum(1.0 - away**2, least_sine**2), 1.0 + away**2 * (cap**-2.0 - 1.0))
    behind: FloatArray = radius / np.sqrt(shares)
    return behind
