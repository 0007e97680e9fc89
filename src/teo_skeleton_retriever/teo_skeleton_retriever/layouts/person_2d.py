# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The keypoints of one person in an image, and bodies of every layout that a detector gives as BODY_25."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, COCO_18, FACE_70, HAND_21

# Keypoints of the body layouts that OpenPose writes: BODY_25, COCO and MPI.
_BODY_SIZES = (25, 18, 15)


def _absent() -> FloatArray:
    return frozen(np.zeros((0, 3)))


@dataclass(frozen=True, eq=False)
class Person2D:
    """What a detector saw of one person: a part not looked for has no rows, an unseen keypoint is zero.

    Attributes:
        body: x, y [px], confidence. Shape (25, 3), (18, 3), (15, 3) or (0, 3).
        left_hand: Likewise, the person's own left. Shape (21, 3) or (0, 3).
        right_hand: Likewise.
        face: Likewise. Shape (70, 3) or (0, 3).
        body_depth: How far the detector takes each of the body's points to be behind the hips [px], in about
            the scale of the image. Shape (25,), or None.
        left_hand_world: The hand's shape as the detector imagines it: x, y, z [m] along the camera's axes,
            from an origin in the hand; its size is that of a usual hand. Shape (21, 3), or None.
        right_hand_world: Likewise.
    """

    body: FloatArray = field(default_factory=_absent)
    left_hand: FloatArray = field(default_factory=_absent)
    right_hand: FloatArray = field(default_factory=_absent)
    face: FloatArray = field(default_factory=_absent)
    body_depth: FloatArray | None = None
    left_hand_world: FloatArray | None = None
    right_hand_world: FloatArray | None = None

    def __post_init__(self) -> None:
        sizes = {
            "body": _BODY_SIZES,
            "left_hand": (len(HAND_21),),
            "right_hand": (len(HAND_21),),
            "face": (len(FACE_70),),
        }
        for name, allowed in sizes.items():
            shape = np.shape(getattr(self, name))
            if shape not in [(rows, 3) for rows in (0, *allowed)]:
                raise RetrieverError(
                    "wrong_shape",
                    f"{name}: expected no rows or {' or '.join(map(str, allowed))} rows of 3 numbers, "
                    f"got shape {shape}",
                )
        imagined = {
            "body_depth": (len(BODY_25),),
            "left_hand_world": (len(HAND_21), 3),
            "right_hand_world": (len(HAND_21), 3),
        }
        for name, shape in imagined.items():
            world = getattr(self, name)
            if world is not None and np.shape(world) != shape:
                raise RetrieverError("wrong_shape", f"{name}: expected {shape}, got {np.shape(world)}")
        for name in (*sizes, *imagined):
            if getattr(self, name) is None:
                continue
            array = frozen(getattr(self, name))
            if not np.isfinite(array).all():
                raise RetrieverError("not_finite", f"{name}: expected finite numbers, got NaN or infinity")
            object.__setattr__(self, name, array)


def midpoint(first: FloatArray, second: FloatArray) -> FloatArray:
    """Mean position of two keypoints x, y [px], confidence, with the lower one; zero if either is absent."""
    confidence = min(first[2], second[2])
    if not confidence > 0.0:
        return np.zeros(3)
    x, y = (first[:2] + second[:2]) / 2.0
    return np.array([x, y, confidence])


# The 15 keypoints of OpenPose's MPI model. Source: `poseParameters.cpp` of OpenPose 1.7.
_MPI: tuple[str | None, ...] = (
    *(None, "Neck"),  # the top of the head is no keypoint of BODY_25
    *("RShoulder", "RElbow", "RWrist", "LShoulder", "LElbow", "LWrist"),
    *("RHip", "RKnee", "RAnkle", "LHip", "LKnee", "LAnkle"),
    None,  # nor is the chest
)
# Names of the keypoints of other bodies than BODY_25, by their number.
_OTHER_BODIES: dict[int, tuple[str | None, ...]] = {len(COCO_18): COCO_18.keypoints, len(_MPI): _MPI}


def as_body_25(body: FloatArray) -> FloatArray:
    """Bring a body into BODY_25: same names, mid-hip between the hips.

    Args:
        body: x, y [px], confidence, in BODY_25, COCO or MPI; or no rows. Shape (n, 3).

    Returns:
        x, y [px], confidence; absent keypoints are zero. Shape (25, 3).

    Raises:
        RetrieverError: Another number of keypoints.
    """
    if len(body) == len(BODY_25):
        return body
    out = np.zeros((len(BODY_25), 3))
    if len(body) == 0:
        return out
    if len(body) not in _OTHER_BODIES:
        raise RetrieverError("wrong_layout", f"expected BODY_25, COCO or MPI, got {len(body)} keypoints")
    for name, row in zip(_OTHER_BODIES[len(body)], body, strict=True):
        if name is not None:
            out[BODY_25.index[name]] = row
    out[BODY_25.index["MidHip"]] = midpoint(out[BODY_25.index["RHip"]], out[BODY_25.index["LHip"]])
    return out
