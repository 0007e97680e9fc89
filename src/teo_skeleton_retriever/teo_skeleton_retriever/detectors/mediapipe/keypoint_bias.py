"""How a detector's keypoints are off the joints' centres, the same for everybody, put right in the image.

A shift is a share of a vector between two keypoints, so that it shrinks with distance and when the person
turns, as the shift in space would. MediaPipe puts shoulders too high and too far in, elbows and wrists short
of the joint. Calibrated on rendered people (`bench/accuracy_tuning.py`); other bodies and motions are tested.
"""

from __future__ import annotations

from typing import NamedTuple

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.body_25 import BODY_25


class Shift(NamedTuple):
    """Moves a keypoint by a share of the vector from one keypoint to another."""

    keypoint: str
    start: str
    end: str
    share: float


MEDIAPIPE: tuple[Shift, ...] = (
    Shift("RShoulder", "LShoulder", "RShoulder", 0.04),
    Shift("LShoulder", "RShoulder", "LShoulder", 0.04),
    Shift("RShoulder", "Neck", "MidHip", 0.036),
    Shift("LShoulder", "Neck", "MidHip", 0.036),
    Shift("Neck", "Neck", "MidHip", 0.036),
    Shift("RElbow", "RShoulder", "RElbow", 0.045),
    Shift("LElbow", "LShoulder", "LElbow", 0.045),
    Shift("RWrist", "RElbow", "RWrist", 0.03),
    Shift("LWrist", "LElbow", "LWrist", 0.03),
)
"""Of 0.36 m between the shoulders, 0.48 m of trunk, 0.27 m of upper arm and 0.25 m of forearm."""


def unbiased(body: FloatArray, shifts: tuple[Shift, ...]) -> FloatArray:
    """Move keypoints to the joints' centres; those for which a keypoint of the vector is absent stay.

    Args:
        body: x, y [px], confidence, in BODY_25; absent keypoints are zero. Shape (25, 3).
        shifts: of the detector.
    """
    moved = body.copy()
    row = BODY_25.index
    for shift in shifts:
        ends = body[[row[shift.start], row[shift.end]]]
        if (ends[:, 2] > 0.0).all():
            moved[row[shift.keypoint], :2] += shift.share * (ends[1, :2] - ends[0, :2])
    return moved
