# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""All keypoints of a person in one array, and prior knowledge of each: radius, speed, noise, bone lengths."""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21

BODY = slice(0, len(BODY_25))
LEFT_HAND = slice(BODY.stop, BODY.stop + len(HAND_21))
RIGHT_HAND = slice(LEFT_HAND.stop, LEFT_HAND.stop + len(HAND_21))
FACE = slice(RIGHT_HAND.stop, RIGHT_HAND.stop + len(FACE_70))
KEYPOINTS = FACE.stop
# Rows of each part of a `Skeleton`.
PART_ROWS = {"body": BODY, "left_hand": LEFT_HAND, "right_hand": RIGHT_HAND, "face": FACE}

ROW = BODY_25.index
# Rows of shoulder, elbow and wrist on the left and on the right.
ARMS: dict[str, list[int]] = {
    side: [ROW[f"{side}{joint}"] for joint in ("Shoulder", "Elbow", "Wrist")] for side in ("L", "R")
}
GIRDLE = [ROW[name] for name in ("Neck", "RShoulder", "LShoulder")]
HANDS = {"L": LEFT_HAND, "R": RIGHT_HAND}


def _each(body: float, hands: float, face: float, **joints: float) -> FloatArray:
    values = np.concatenate([np.full(len(BODY_25), body), np.full(42, hands), np.full(70, face)])
    for name, value in joints.items():
        for row, keypoint in enumerate(BODY_25.keypoints):
            if keypoint.endswith(name):
                values[row] = value
    return values


# [m] Around a keypoint that depth is looked at: half a wrist, a finger, half an eye.
RADIUS = _each(0.03, 0.008, 0.01)
# [m] Depths that are this far apart belong to different surfaces: less than from forearm to chest, from a
# finger to the other hand, from a hand to the face.
GAP = _each(0.06, 0.03, 0.05)
# [m/s^2] Usual standard deviation: a stroke of a sign is 0.3 m in 0.2 s, a nod 5 cm in 0.2 s.
ACCELERATION = _each(5.0, 25.0, 6.0, Elbow=12.0, Wrist=25.0)
# [m/s] Greatest speed of anybody: fast strokes of signs were seen at 2 to 3 m/s, a nod at 0.5 m/s.
SPEED = _each(1.0, 5.0, 1.0, Elbow=3.0, Wrist=5.0)
# [m] Standard deviation of the detector's keypoints across the ray, from image to image.
ACROSS = _each(0.005, 0.004, 0.003)
# [px] Least standard deviation across the ray, of near keypoints too.
PIXEL = _each(0.5, 0.5, 0.4)
# [m/s] How fast a keypoint that is not seen may get away from where it is thought to be: people sway, wrists
# are on their way to the next sign.
DRIFT = _each(0.3, 1.2, 0.3, Elbow=0.8, Wrist=1.2)
# [m] How far off where it is believed a keypoint may be seen all the time, for constant offsets.
JUMP = _each(0.015, 0.012, 0.01)
# [m] Standard deviations across the ray and along it of what no averaging removes: how detector and skin
# differ from person to person and from pose to pose. Set so that of the errors on known takes
# (`bench/accuracy/`) 95 to 98 % are within two sigmas, for those of each kind of joint and of fingertips, and
# 93 % for signers among other people.
BIAS: FloatArray = np.column_stack(
    [
        _each(0.015, 0.007, 0.006, Shoulder=0.011, Elbow=0.020, Wrist=0.016),
        _each(0.015, 0.012, 0.008, Shoulder=0.008, Elbow=0.016, Wrist=0.015),
    ]
)
# [m] Length of the bone that ends at each keypoint but the wrist, of an average adult, tips at the middle of
# the pads. Source: Buryanov and Kotiuk, "Proportions of Hand Segments" (2010), the tips less 4 mm.
HAND_BONES: FloatArray = np.array(
    [
        *(0.040, 0.042, 0.032, 0.026),  # thumb
        *(0.091, 0.041, 0.025, 0.020),
        *(0.088, 0.045, 0.028, 0.021),
        *(0.082, 0.042, 0.027, 0.021),
        *(0.078, 0.033, 0.020, 0.018),
    ]
)
