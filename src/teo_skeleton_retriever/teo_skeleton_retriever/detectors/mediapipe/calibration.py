"""How far MediaPipe's elbows, wrists and hands are from the joints, by how sure it is of them.

It guesses what it does not see and says so, if one listens closely: an elbow of which it is sure to 0.999 was
off by 18 mm, to 0.99 by 30 mm, to 0.95 by 71 mm and below by 108 mm (root mean square, on rendered people).
The points of a hand that is there for sure were off by 6 mm, to 0.9 by 8 mm, to 0.7 by 15 mm, below by 19 mm
(medians of 3,200 rendered hands).
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.body_25 import BODY_25

_ELBOWS = [BODY_25.index[f"{side}Elbow"] for side in "RL"]
_WRISTS = [BODY_25.index[f"{side}Wrist"] for side in "RL"]
_DOUBTS = (0.001, 0.005, 0.01, 0.02, 0.04, 0.1)
"""What is missing from certainty, and the standard deviations across the ray there [m]:"""
_ELBOW = (0.02, 0.02, 0.02, 0.025, 0.035, 0.05)
_WRIST = (0.015, 0.015, 0.015, 0.016, 0.018, 0.035)
_PRESENCES = (0.65, 0.75, 0.82, 0.88, 0.93, 0.97)
_HAND = (0.018, 0.015, 0.011, 0.008, 0.006, 0.0)
"""[m] What the points of a hand are farther off by, at which presence."""


def hand_doubt(presence: FloatArray) -> FloatArray:
    """Give how much farther than those of a hand in plain view points of hands are across the ray [m].

    Args:
        presence: of the hand, by the detector, 0 to 1, one of each point. Shape (n,).
    """
    return np.asarray(np.interp(presence, _PRESENCES, _HAND))


def across_by_confidence(across: FloatArray, confidence: FloatArray) -> FloatArray:
    """Give the standard deviations of a body's keypoints across the ray [m]. Shape (25,).

    Args:
        across: those of keypoints of which the detector is sure [m]. Shape (25,).
        confidence: of the detector, 0 to 1. Shape (25,).
    """
    told = across.copy()
    doubt = np.log(np.clip(1.0 - confidence, 1e-6, 1.0))
    for rows, sigmas in ((_ELBOWS, _ELBOW), (_WRISTS, _WRIST)):
        told[rows] = np.interp(doubt[rows], np.log(_DOUBTS), sigmas)
    return told
