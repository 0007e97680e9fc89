# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Layouts of `.pose` files: where in them the points of a person's body and hands stand.

Points are found by the names in a file's header, so that files with a part of the points are read as well.
Known are the layouts that pose-format itself makes: MediaPipe Holistic's (whole, or without legs, fingers
of the body or faces) and OpenPose's BODY_25 with hands. MediaPipe's POSE_WORLD_LANDMARKS are passed over:
pose-format multiplies their metres with the size of the image, each axis with another figure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

# MediaPipe's name of points of BODY_25; the neck and the middle of the hips are means of two, legs are left
# out.
_MEDIAPIPE_BODY = {
    0: "NOSE",
    2: "RIGHT_SHOULDER",
    3: "RIGHT_ELBOW",
    4: "RIGHT_WRIST",
    5: "LEFT_SHOULDER",
    6: "LEFT_ELBOW",
    7: "LEFT_WRIST",
    9: "RIGHT_HIP",
    12: "LEFT_HIP",
    15: "RIGHT_EYE",
    16: "LEFT_EYE",
    17: "RIGHT_EAR",
    18: "LEFT_EAR",
}

_MEDIAPIPE_HAND = (
    "WRIST",
    *(f"THUMB_{joint}" for joint in ("CMC", "MCP", "IP", "TIP")),
    *(
        f"{finger}_FINGER_{joint}"
        for finger in ("INDEX", "MIDDLE", "RING")
        for joint in ("MCP", "PIP", "DIP", "TIP")
    ),
    *(f"PINKY_{joint}" for joint in ("MCP", "PIP", "DIP", "TIP")),
)

_OPENPOSE_BODY = {
    0: "Nose",
    2: "RShoulder",
    3: "RElbow",
    4: "RWrist",
    5: "LShoulder",
    6: "LElbow",
    7: "LWrist",
    9: "RHip",
    12: "LHip",
    15: "REye",
    16: "LEye",
    17: "REar",
    18: "LEar",
}

# As pose-format names them, from the wrist out.
_OPENPOSE_HAND = (
    "BASE",
    *(f"T_{joint}" for joint in ("STT", "BCMC", "MCP", "IP")),
    *(f"{finger}_{joint}" for finger in "IMRP" for joint in ("CMC", "MCP", "PIP", "DIP")),
)


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Names of a kind of file.

    Attributes:
        name: For people.
        body: Component of the body.
        left_hand: Component of the person's own left hand.
        right_hand: Likewise.
        body_points: Name of points of BODY_25, by its number.
        hand_points: Names of a hand's 21, in order.
    """

    name: str
    body: str
    left_hand: str
    right_hand: str
    body_points: Mapping[int, str]
    hand_points: Sequence[str]


_MEDIAPIPE = Layout(
    name="MediaPipe Holistic",
    body="POSE_LANDMARKS",
    left_hand="LEFT_HAND_LANDMARKS",
    right_hand="RIGHT_HAND_LANDMARKS",
    body_points=_MEDIAPIPE_BODY,
    hand_points=_MEDIAPIPE_HAND,
)
OPENPOSE = Layout(
    name="OpenPose",
    body="pose_keypoints_2d",
    left_hand="hand_left_keypoints_2d",
    right_hand="hand_right_keypoints_2d",
    body_points=_OPENPOSE_BODY,
    hand_points=_OPENPOSE_HAND,
)
# The layouts that are read.
LAYOUTS = (_MEDIAPIPE, OPENPOSE)
