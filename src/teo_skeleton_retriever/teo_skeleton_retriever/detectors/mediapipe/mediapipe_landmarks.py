# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""MediaPipe Holistic's landmarks as OpenPose keypoints: BODY_25, two hands of 21, face of 70.

Sources: MediaPipe's pose and face mesh numbering; ROS4HRI's table of the face
(`hri_face_detect/doc/mediapipe_face_mesh_2_ros4hri.md`), whose outer lip 55 to 59 runs the wrong way round
there and is put right here; the eyes, inner lip and jaw are those in common use, which lie on the annotated
contours.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D, midpoint

POSE_LANDMARKS = 33
HAND_LANDMARKS = 21
# Without and with the irises.
FACE_LANDMARKS = (468, 478)

# Small toes have no counterpart.
BODY_25_FROM_POSE: dict[str, int] = {
    "Nose": 0,
    "RShoulder": 12,
    "RElbow": 14,
    "RWrist": 16,
    "LShoulder": 11,
    "LElbow": 13,
    "LWrist": 15,
    "RHip": 24,
    "RKnee": 26,
    "RAnkle": 28,
    "LHip": 23,
    "LKnee": 25,
    "LAnkle": 27,
    "REye": 5,
    "LEye": 2,
    "REar": 8,
    "LEar": 7,
    "LBigToe": 31,
    "LHeel": 29,
    "RBigToe": 32,
    "RHeel": 30,
}
# Keypoints that MediaPipe does not give: mean of two, with the lower confidence.
_BODY_25_FROM_PAIRS: dict[str, tuple[str, str]] = {
    "Neck": ("RShoulder", "LShoulder"),
    "MidHip": ("RHip", "LHip"),
}

# Face mesh landmark of each of the 70, part by part; the pupils need the irises.
FACE_70_FROM_MESH: dict[str, tuple[int, ...]] = {
    "Jaw": (127, 234, 93, 132, 58, 136, 150, 176, 152, 400, 379, 365, 288, 361, 323, 454, 356),
    "RBrow": (70, 63, 105, 66, 107),
    "LBrow": (336, 296, 334, 293, 300),
    "NoseBridge": (6, 197, 4, 1),
    "Nostrils": (242, 141, 94, 370, 462),
    "REye": (33, 160, 158, 133, 153, 144),
    "LEye": (362, 385, 387, 263, 373, 380),
    "OuterLip": (61, 40, 37, 0, 267, 270, 291, 321, 314, 17, 84, 91),
    "InnerLip": (78, 81, 13, 311, 308, 402, 14, 178),
    "RPupil": (468,),
    "LPupil": (473,),
}


def person_from_holistic(
    *,
    width: int,
    height: int,
    pose: FloatArray | None = None,
    left_hand: FloatArray | None = None,
    right_hand: FloatArray | None = None,
    face: FloatArray | None = None,
    left_hand_confidence: float = 1.0,
    right_hand_confidence: float = 1.0,
    face_confidence: float = 1.0,
) -> Person2D:
    """Bring one person's landmarks into OpenPose's order and into pixels.

    Args:
        width: Of the image [px].
        height: Of the image [px].
        pose: x, y in [0, 1] of width and height, visibility in [0, 1]. Shape (33, 3); None if not seen.
        left_hand: x, y likewise; the person's own left. Shape (21, 2).
        right_hand: Likewise.
        face: Likewise. Shape (468, 2) or (478, 2).
        left_hand_confidence: MediaPipe gives a hand whole or not at all, with one figure for all landmarks.
        right_hand_confidence: Likewise.
        face_confidence: Likewise for the face.

    Raises:
        RetrieverError: A shape is another, or a number is not finite, or a visibility is outside [0, 1]
            (MediaPipe's own test data holds logits).
    """
    size = np.array([width, height], dtype=np.float64)
    return Person2D(
        body=_body(_checked(pose, "pose", (POSE_LANDMARKS,), 3), size),
        left_hand=_part(_checked(left_hand, "left_hand", (HAND_LANDMARKS,), 2), size, left_hand_confidence),
        right_hand=_part(
            _checked(right_hand, "right_hand", (HAND_LANDMARKS,), 2), size, right_hand_confidence
        ),
        face=_face(_checked(face, "face", FACE_LANDMARKS, 2), size, face_confidence),
    )


def _checked(
    landmarks: FloatArray | None, name: str, counts: tuple[int, ...], columns: int
) -> FloatArray | None:
    if landmarks is None:
        return None
    array = np.asarray(landmarks, dtype=np.float64)
    if array.ndim != 2 or len(array) not in counts or array.shape[1] != columns:
        raise RetrieverError(
            "wrong_shape",
            f"{name}: expected {' or '.join(map(str, counts))} rows of {columns}, got shape {array.shape}",
        )
    if not np.isfinite(array).all():
        raise RetrieverError("not_finite", f"{name}: expected finite numbers, got NaN or infinity")
    if columns == 3 and not ((array[:, 2] >= 0.0) & (array[:, 2] <= 1.0)).all():
        raise RetrieverError(
            "bad_visibility", f"{name}: expected visibilities in [0, 1]; logits want a sigmoid"
        )
    return array


def _body(pose: FloatArray | None, size: FloatArray) -> FloatArray:
    if pose is None:
        return np.zeros((0, 3))
    body = np.zeros((len(BODY_25), 3))
    for name, landmark in BODY_25_FROM_POSE.items():
        body[BODY_25.index[name]] = pose[landmark] * [*size, 1.0]
    for name, (first, second) in _BODY_25_FROM_PAIRS.items():
        body[BODY_25.index[name]] = midpoint(body[BODY_25.index[first]], body[BODY_25.index[second]])
    return body


def _part(landmarks: FloatArray | None, size: FloatArray, confidence: float) -> FloatArray:
    if landmarks is None:
        return np.zeros((0, 3))
    return np.column_stack([landmarks * size, np.full(len(landmarks), confidence)])


def _face(mesh: FloatArray | None, size: FloatArray, confidence: float) -> FloatArray:
    if mesh is None:
        return np.zeros((0, 3))
    chosen = np.array([i for part in FACE_70_FROM_MESH.values() for i in part])
    seen = chosen < len(mesh)
    face = np.zeros((len(chosen), 3))
    face[seen, :2] = mesh[chosen[seen]] * size
    face[seen, 2] = confidence
    return face
