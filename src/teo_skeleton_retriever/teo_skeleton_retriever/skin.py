"""From the skin, which a depth camera sees, to the centre of the joint behind it.

A joint is taken for the axis of a round limb: the ray to the centre meets the skin earlier by the limb's
radius, and by more where it runs along the limb. Radii are in proportion to the person's size.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.body_25 import BODY_25
from teo_skeleton_retriever.hand_21 import HAND_21

BODY_DEPTH: dict[str, float] = {
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
"""[m] From the skin to the joint, of an average adult, seen across the limb."""

HAND_DEPTH: dict[str, float] = {
    name: 0.025
    if name == "Wrist"
    else 0.015
    if name.endswith(("CMC", "MCP"))
    else 0.009
    if name.endswith(("PIP", "DIP", "IP"))
    else 0.004
    for name in HAND_21.keypoints
}
"""[m] Likewise."""

_LEAST_SINE = 0.5  # of the angle between ray and limb: a limb that points at the camera ends in its tip

BODY_DEPTHS: FloatArray = np.array([BODY_DEPTH[name] for name in BODY_25.keypoints])
HAND_DEPTHS: FloatArray = np.array([HAND_DEPTH[name] for name in HAND_21.keypoints])


def along_ray(radius: FloatArray, axis: FloatArray, ray: FloatArray) -> FloatArray:
    """Give how far behind the skin the axis of a limb lies, along the optical axis [m].

    Args:
        radius: of the limb [m]. Shape (n,).
        axis: direction of the limb, of any length; NaN or zero if not known. Shape (n, 3).
        ray: from the camera, of any length. Shape (n, 3).
    """
    squares = (axis * axis).sum(axis=1) * (ray * ray).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        squared_sine = 1.0 - (axis * ray).sum(axis=1) ** 2 / squares
        squared_sine = np.where(squares > 0.0, np.maximum(squared_sine, _LEAST_SINE**2), 1.0)
    behind: FloatArray = radius / np.sqrt(squared_sine)
    return behind
