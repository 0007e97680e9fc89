# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which keypoints a camera can see: what lies before each of them may only be its own skin and cloth."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_synthetic_signer.body.body_data import load_body_data
from teo_synthetic_signer.body.surface import RayCaster

_TRUNK = ("root", "pelvis", "spine", "breast", "clavicle", "shoulder", "upperarm01")
_LIMITS: dict[str, tuple[tuple[str, ...], float]] = {
    # Bones whose skin may lie before the keypoint, and by how much at most [m]: somewhat more than the
    # greatest distance from the joint to the skin in heavy people.
    "Neck": ((*_TRUNK, "neck"), 0.17),
    "Shoulder": ((*_TRUNK, "upperarm"), 0.13),
    "Elbow": (("upperarm", "lowerarm"), 0.09),
    "Wrist": (("lowerarm", "wrist", "metacarpal", "finger1-1"), 0.055),
    "MidHip": ((*_TRUNK, "upperleg"), 0.25),
    "Hip": ((*_TRUNK, "upperleg"), 0.20),
    "Knee": (("upperleg", "lowerleg"), 0.12),
    "Ankle": (("lowerleg", "foot"), 0.09),
    "BigToe": (("foot", "toe"), 0.05),
    "SmallToe": (("foot", "toe"), 0.05),
    "Heel": (("foot", "lowerleg"), 0.05),
    "Nose": (("head",), 0.012),
    "Eye": (("head",), 0.012),
    "Ear": (("head",), 0.03),
}
_PALM, _PALM_LIMIT, _FINGER_LIMIT = ("wrist", "metacarpal"), 0.035, 0.022
_FACE_LIMIT = 0.012
# A keypoint may lie so far before the surface: lips part, lids close [m].
_TOLERANCE = 0.01


class _Own(NamedTuple):
    bones: BoolArray  # whose skin may lie before it; shape (bones,)
    limit: float


def _bones(prefixes: tuple[str, ...], side: str) -> BoolArray:
    """Mark bones whose names start so, of one side or of neither."""
    bones = load_body_data().bones
    if prefixes == ("head",):  # all of the face
        start = bones.index("neck03")
        return np.arange(len(bones)) >= start
    other = {"R": ".L", "L": ".R", "": ".none"}[side]
    return np.array([name.startswith(prefixes) and not name.endswith(other) for name in bones])


@cache
def _body() -> tuple[_Own, ...]:
    result = []
    for name in BODY_25.keypoints:
        side = name[0] if name[0] in "RL" and name[1:] in _LIMITS else ""
        prefixes, limit = _LIMITS[name.removeprefix(side)]
        result.append(_Own(_bones(prefixes, side), limit))
    return tuple(result)


@cache
def _hand(side: str) -> tuple[_Own, ...]:
    prefixes, limit = _LIMITS["Wrist"]
    result = [_Own(_bones(prefixes, side), limit)]
    for finger in range(1, 6):
        own = f"finger{finger}-"
        result.append(_Own(_bones((own, *_PALM), side), _PALM_LIMIT))
        result += [_Own(_bones((own,), side), _FINGER_LIMIT)] * 3
    return tuple(result)


@cache
def _face() -> tuple[_Own, ...]:
    return (_Own(_bones(("head",), ""), _FACE_LIMIT),) * 70


def visible(
    person: RayCaster,
    around: Sequence[RayCaster],
    bones: NDArray[np.int16],
    camera: CameraModel,
    parts: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
) -> tuple[BoolArray, BoolArray, BoolArray, BoolArray]:
    """Tell which keypoints are seen.

    Args:
        person: In the camera's axes.
        around: Likewise: the room, other people.
        bones: That move each of the person's triangles.
        camera: Of the image.
        parts: BODY_25, left hand, right hand and face, in the camera's axes [m].
    """
    owners = (*_body(), *_hand("L"), *_hand("R"), *_face())
    points = np.concatenate(parts)
    front = points[:, 2] > 1e-6
    away = points / np.where(front, points[:, 2], 1.0)[:, None]
    directions = np.where(front[:, None], away, [0.0, 0.0, 1.0]).astype(np.float32)
    hits = person.cast(directions)
    before = np.min([other.cast(directions).distance for other in around], axis=0)
    inside = np.zeros(len(points), dtype=bool)
    inside[front] = camera.contains(camera.project(points[front]))
    seen = np.zeros(len(points), dtype=bool)
    for i, (owner, triangle) in enumerate(zip(owners, hits.triangle, strict=True)):
        if triangle < 0 or not inside[i] or before[i] < hits.distance[i]:
            continue
        behind = points[i, 2] - hits.distance[i]
        seen[i] = owner.bones[bones[triangle]] and -_TOLERANCE <= behind <= owner.limit
    ends = np.cumsum([len(part) for part in parts])
    body, left, right, face = np.split(seen, ends[:-1])
    return body, left, right, face
