# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The keypoints of one person in an image."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import FACE_70, HAND_21

# Keypoints of the body layouts that OpenPose writes.
BODY_SIZES = {25: "BODY_25", 18: "COCO", 15: "MPI"}
# What OpenPose writes where it does not track people.
UNKNOWN_ID = -1


def _absent(columns: int) -> FloatArray:
    return frozen(np.zeros((0, columns)))


@dataclass(frozen=True, eq=False)
class Person2D:
    """What a detector saw of one person: a part not looked for has no rows, an unseen keypoint is zero.

    Attributes:
        body: x, y [px], confidence. Shape (25, 3), (18, 3), (15, 3) or (0, 3).
        left_hand: Likewise, the person's own left. Shape (21, 3) or (0, 3).
        right_hand: Likewise.
        face: Likewise. Shape (70, 3) or (0, 3).
        body_3d: x, y, z, 1 where reconstructed and 0 where not; only from several calibrated cameras.
            Shape (n, 4) with the n of `body`, or (0, 4).
        left_hand_3d: Likewise.
        right_hand_3d: Likewise.
        face_3d: Likewise.
        left_hand_world: The hand's shape as the detector imagines it: x, y, z [m] along the camera's axes,
            from an origin in the hand; its size is that of a usual hand. Shape (21, 3), or None.
        right_hand_world: Likewise.
        person_id: Of the detector's own tracking; -1 if it does not track.
    """

    body: FloatArray = field(default_factory=lambda: _absent(3))
    left_hand: FloatArray = field(default_factory=lambda: _absent(3))
    right_hand: FloatArray = field(default_factory=lambda: _absent(3))
    face: FloatArray = field(default_factory=lambda: _absent(3))
    body_3d: FloatArray = field(default_factory=lambda: _absent(4))
    left_hand_3d: FloatArray = field(default_factory=lambda: _absent(4))
    right_hand_3d: FloatArray = field(default_factory=lambda: _absent(4))
    face_3d: FloatArray = field(default_factory=lambda: _absent(4))
    person_id: int = UNKNOWN_ID
    left_hand_world: FloatArray | None = None
    right_hand_world: FloatArray | None = None

    def __post_init__(self) -> None:
        sizes = {
            "body": tuple(BODY_SIZES),
            "left_hand": (len(HAND_21),),
            "right_hand": (len(HAND_21),),
            "face": (len(FACE_70),),
        }
        for part, allowed in sizes.items():
            for name, columns in ((part, 3), (f"{part}_3d", 4)):
                array = np.asarray(getattr(self, name), dtype=np.float64)
                if array.ndim != 2 or array.shape[1] != columns or len(array) not in (0, *allowed):
                    raise RetrieverError(
                        "wrong_shape",
                        f"{name}: expected no rows or {' or '.join(map(str, allowed))} rows of {columns} "
                        f"numbers, got shape {array.shape}",
                    )
                if not np.isfinite(array).all():
                    raise RetrieverError(
                        "not_finite", f"{name}: expected finite numbers, got NaN or infinity"
                    )
                object.__setattr__(self, name, frozen(array))
        for name in ("left_hand_world", "right_hand_world"):
            if getattr(self, name) is None:
                continue
            world = np.asarray(getattr(self, name), dtype=np.float64)
            if world.shape != (len(HAND_21), 3):
                raise RetrieverError("wrong_shape", f"{name}: expected (21, 3), got {world.shape}")
            if not np.isfinite(world).all():
                raise RetrieverError("not_finite", f"{name}: expected finite numbers, got NaN or infinity")
            object.__setattr__(self, name, frozen(world))
