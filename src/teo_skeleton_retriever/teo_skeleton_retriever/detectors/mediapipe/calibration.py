# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How MediaPipe's keypoints differ from the centres of the joints: constant offsets, and standard deviations.

Calibrated on rendered people; other bodies and motions are tested.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, HAND_21
from teo_skeleton_retriever.layouts.person_layout import HAND_BONES

# MediaPipe puts shoulders too high, too far in and nearer to the trunk than a raised arm takes them, elbows
# short of the joint. A shift is a share of a vector between two keypoints, so that it shrinks with distance
# and when the person turns, as the shift in space does. Robust least squares (Huber, 30 mm) over 82 people,
# most of them in motions by chance; in 71 other takes shoulders are 5 %
# nearer for it than with shares of shoulders and trunk alone, elbows 4 % nearer than with one of the upper
# arm alone. Wrists are short by nothing that could be told.
# A row: the keypoint that is moved, the vector's start and end, the share.
_BODY_SHIFTS = (
    *(
        (f"{side}{joint}", start.format(side, other), end.format(side, other), share)
        for side, other in (("R", "L"), ("L", "R"))
        for joint, start, end, share in (
            ("Shoulder", "{1}Shoulder", "{0}Shoulder", 0.042),
            ("Shoulder", "Neck", "MidHip", 0.044),
            ("Shoulder", "Neck", "Nose", 0.073),
            ("Shoulder", "{0}Shoulder", "{0}Elbow", 0.035),
            ("Elbow", "{0}Shoulder", "{0}Elbow", 0.062),
            ("Elbow", "{0}Elbow", "{0}Wrist", 0.028),
            ("Elbow", "{1}Shoulder", "{0}Shoulder", -0.018),
            ("Elbow", "Neck", "MidHip", -0.016),
        )
    ),
    # As the mean of both shoulders.
    ("Neck", "Neck", "MidHip", 0.044),
    ("Neck", "Neck", "Nose", 0.073),
    ("Neck", "RShoulder", "RElbow", 0.0175),
    ("Neck", "LShoulder", "LElbow", 0.0175),
)


# [m] MediaPipe puts ears where the cheek ends, before the ear's middle; on rendered people by 59 to 64 mm.
EAR_BEHIND = 0.06


_SHIFTED, _STARTS, _ENDS = np.array([[BODY_25.index[name] for name in row[:3]] for row in _BODY_SHIFTS]).T
_SHARES: FloatArray = np.array([row[3] for row in _BODY_SHIFTS])


def corrected_body(body: FloatArray) -> FloatArray:
    """Move keypoints to the joints' centres; those for which a keypoint of the vector is absent stay.

    Args:
        body: x, y [px], confidence, in BODY_25; absent keypoints are zero. Shape (25, 3).
    """
    moved = body.copy()
    seen = (body[_STARTS, 2] > 0.0) & (body[_ENDS, 2] > 0.0)
    steps = (_SHARES * seen)[:, None] * (body[_ENDS, :2] - body[_STARTS, :2])
    np.add.at(moved[:, :2], _SHIFTED, steps)
    return moved


# MediaPipe's wrist is at the crease, its knuckles are at the web between the fingers, the base of its thumb
# is in the ball. Shares of the palm's length, wrist to middle knuckle: towards the fingers, towards the
# thumb, out of the back of the hand.
_HAND_SHIFTS: dict[str, tuple[float, float, float]] = {
    "Wrist": (0.165, 0.0, 0.05),
    "ThumbCMC": (0.08, 0.08, -0.05),
    "ThumbMCP": (0.06, 0.04, -0.025),
    "ThumbIP": (0.01, -0.03, 0.02),
    "IndexMCP": (0.09, 0.02, 0.0),
    "MiddleMCP": (0.08, 0.025, 0.0),
    "RingMCP": (0.075, 0.045, 0.02),
    "PinkyMCP": (0.02, 0.04, 0.03),
}

# [m] Lengths between MediaPipe's keypoints, of an average adult; the shares were measured on 968 rendered
# hands. Shape (20,).
MEDIAPIPE_HAND_BONES: FloatArray = HAND_BONES * np.array(
    [
        *(1.08, 0.93, 0.80, 1.03),  # thumb
        *(0.95, 0.92, 0.95, 0.89),
        *(0.955, 0.88, 0.905, 0.95),
        *(0.93, 0.93, 0.94, 0.92),
        *(0.88, 0.94, 1.06, 1.075),
    ]
)

_OFFSETS: FloatArray = np.array([_HAND_SHIFTS.get(name, (0.0, 0.0, 0.0)) for name in HAND_21.keypoints])
_WRIST, _INDEX, _MIDDLE, _PINKY = (
    HAND_21.index[name] for name in ("Wrist", "IndexMCP", "MiddleMCP", "PinkyMCP")
)
_LEAST_SPREAD = 0.01  # [m] between the knuckles across the palm; less makes no frame


def corrected_hand(hand: FloatArray, *, left: bool) -> FloatArray:
    """Move MediaPipe's keypoints to the joints' centres.

    Args:
        hand: In space [m]. Shape (21, 3).
        left: Whether it is a left hand.

    Returns:
        [m]; unmoved if the palm makes no frame. Shape (21, 3).
    """
    along = hand[_MIDDLE] - hand[_WRIST]
    length = float(np.sqrt(along @ along))
    if length < _LEAST_SPREAD:
        return hand
    x = along / length
    across = hand[_INDEX] - hand[_PINKY]
    across = across - x * (x @ across)
    spread = float(np.sqrt(across @ across))
    if spread < _LEAST_SPREAD:
        return hand
    y = across / spread
    back = np.array([x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]])
    frame = np.stack([x, y, -back if left else back])
    moved: FloatArray = hand - length * (_OFFSETS @ frame)
    return moved


_WRISTS = [BODY_25.index[f"{side}Wrist"] for side in "RL"]
# Standard deviations [m] by 1 - confidence: of wrists across the ray, of elbows along the upper arm. Where
# a forearm points at the camera an elbow is guessed from the sleeve, and the less sure the detector is of it,
# the shorter it makes the upper arm: it was off by 20 mm at a confidence of 0.999, by 45 mm at 0.99, by 83 mm
# at 0.96 and by 105 mm below; of other forearms by 13, 16 and 42 mm. Beside the upper arm it was off by 20 mm
# whatever the confidence (root mean squares, 1,855 rendered elbows).
_DOUBTS = (0.001, 0.005, 0.01, 0.02, 0.04, 0.1)
_WRIST_SIGMA = (0.015, 0.015, 0.015, 0.016, 0.018, 0.035)
_ELBOW_SIGMA = (0.02, 0.02, 0.02, 0.025, 0.035, 0.05)
_POINTED_ELBOW_SIGMA = (0.02, 0.03, 0.045, 0.06, 0.08, 0.1)
# [m] And by how much it is seen too near to the shoulder: 7, 34, 50 and 58 mm from a doubt of 0.01 on,
# medians of 1,160 elbows of those people (others: 5, 15, 25 and 50); of other forearms by none.
_POINTED_ELBOW_SHORT = (0.0, 0.0, 0.01, 0.025, 0.04, 0.055)
# Part of a forearm's length that is seen across the view: of one that points at the camera, and of one that
# does not; between, errors grow from the one to the other.
_POINTED = (0.65, 0.85)
# What is added to the standard deviation [m] of hand keypoints, by the hand's presence. They were off by 6 mm
# at a presence of 1, by 8 mm at 0.9, by 15 mm at 0.7 and below by 19 mm (medians of 3,200 rendered hands).
_PRESENCES = (0.65, 0.75, 0.82, 0.88, 0.93, 0.97)
_HAND_SIGMA = (0.018, 0.015, 0.011, 0.008, 0.006, 0.0)


def extra_hand_sigma(presence: FloatArray) -> FloatArray:
    """Extra lateral standard deviation of hand keypoints [m], by the detector's confidence. Shapes (n,)."""
    return np.asarray(np.interp(presence, _PRESENCES, _HAND_SIGMA))


def body_sigma(across: FloatArray, confidence: FloatArray) -> FloatArray:
    """Lateral standard deviation of a body's keypoints, by that at a confidence of 1 [m]. Shapes (25,)."""
    told = across.copy()
    told[_WRISTS] = np.interp(_doubt(confidence[_WRISTS]), np.log(_DOUBTS), _WRIST_SIGMA)
    return told


class ElbowError(NamedTuple):
    """How far an elbow is off along the upper arm, in the image."""

    short: float
    """of the joint, towards the shoulder [m]"""
    sigma: float
    """standard deviation [m]"""


def elbow_error(confidence: float, forearm: float) -> ElbowError:
    """Tell how far an elbow is off.

    Args:
        confidence: Of the detector, 0 to 1.
        forearm: Part of the forearm's length that is seen across the view.
    """
    doubt, table = _doubt(confidence), np.log(_DOUBTS)
    pointed = float(np.interp(forearm, _POINTED, (1.0, 0.0)))
    short, plain, far = (
        float(np.interp(doubt, table, row))
        for row in (_POINTED_ELBOW_SHORT, _ELBOW_SIGMA, _POINTED_ELBOW_SIGMA)
    )
    return ElbowError(pointed * short, plain + pointed * (far - plain))


def _doubt(confidence: FloatArray | float) -> FloatArray:
    return np.log(np.clip(1.0 - np.asarray(confidence), 1e-6, 1.0))
