"""From where a detector puts the keypoints of a hand to the centres of its joints.

MediaPipe's wrist is at the crease, its knuckles are at the web between the fingers, the base of its thumb is
in the ball: each is off the joint's centre by the same way in the hand's own frame, for everybody. The ways
were measured on rendered people (`bench/accuracy_tuning.py`); other bodies and motions are tested.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.depth.hand_depth import BONES
from teo_skeleton_retriever.layouts.hand_21 import HAND_21

_MEDIAPIPE: dict[str, tuple[float, float, float]] = {
    "Wrist": (0.165, 0.0, 0.05),
    "ThumbCMC": (0.08, 0.08, -0.05),
    "ThumbMCP": (0.06, 0.04, -0.025),
    "ThumbIP": (0.01, -0.03, 0.02),
    "IndexMCP": (0.09, 0.02, 0.0),
    "MiddleMCP": (0.08, 0.025, 0.0),
    "RingMCP": (0.075, 0.045, 0.02),
    "PinkyMCP": (0.02, 0.04, 0.03),
}
"""Shares of the palm's length, wrist to middle knuckle: towards the fingers, towards the thumb, out of the
back."""

MEDIAPIPE_BONES: FloatArray = BONES * np.array(
    [
        *(1.08, 0.93, 0.80, 1.03),  # thumb
        *(0.95, 0.92, 0.95, 0.89),
        *(0.955, 0.88, 0.905, 0.95),
        *(0.93, 0.93, 0.94, 0.92),
        *(0.88, 0.94, 1.06, 1.075),
    ]
)
"""[m] Between MediaPipe's keypoints, of an average adult. The shares were measured on 968 rendered hands."""

_OFFSETS: FloatArray = np.array([_MEDIAPIPE.get(name, (0.0, 0.0, 0.0)) for name in HAND_21.keypoints])
_WRIST, _INDEX, _MIDDLE, _PINKY = (
    HAND_21.index[name] for name in ("Wrist", "IndexMCP", "MiddleMCP", "PinkyMCP")
)
_LEAST_SPREAD = 0.01  # [m] between the knuckles across the palm; less makes no frame


def mediapipe_joints(hand: FloatArray, *, left: bool) -> FloatArray:
    """Move MediaPipe's keypoints to the joints' centres.

    Args:
        hand: in space [m]. Shape (21, 3).
        left: whether it is a left hand.

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
