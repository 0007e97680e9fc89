# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Errors of joints against the truth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from accuracy.methods import Estimate
from accuracy.takes import TakeFrame
from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, FACE_70, HAND_21

_NAMES = (
    *BODY_25.keypoints,
    *(f"{side}Hand{name}" for side in ("Left", "Right") for name in HAND_21.keypoints),
    *(f"Face{name}" for name in FACE_70.keypoints),
)
_ARMS = ("RShoulder", "LShoulder", "RElbow", "LElbow", "RWrist", "LWrist")
PARTS: dict[str, list[int]] = {
    "body": [_NAMES.index(name) for name in _ARMS],
    "shoulders": [_NAMES.index(name) for name in _ARMS[:2]],
    "wrists": [_NAMES.index(name) for name in _ARMS[4:]],
    "hands": [row for row, name in enumerate(_NAMES) if "Hand" in name],
    "fingertips": [row for row, name in enumerate(_NAMES) if "Hand" in name and name.endswith("Tip")],
    "face": [row for row, name in enumerate(_NAMES) if name.startswith("Face")],
}
"""Rows of the keypoints that count as a part."""


class Errors(NamedTuple):
    """Errors of n keypoints in m images; NaN where the method says nothing."""

    distance: FloatArray
    """[m]. Shape (m, n)"""
    ratio: FloatArray
    """Error over sigma along x, y and z; NaN where the method gives none. Shape (m, n, 3)"""


def errors_of(part: str, frames: Sequence[TakeFrame], estimates: Sequence[Estimate]) -> Errors:
    """Give the errors of one of `PARTS`."""
    rows = PARTS[part]
    truths = (frame.truth for frame in frames)
    parts = ((truth.body, truth.left_hand, truth.right_hand, truth.face) for truth in truths)
    off = np.array([estimate.points for estimate in estimates]) - np.array([np.concatenate(p) for p in parts])
    ratio = off / np.array([estimate.sigma for estimate in estimates])
    return Errors(np.linalg.norm(off, axis=-1)[:, rows], ratio[:, rows])


def joined(errors: Sequence[Errors]) -> Errors:
    """Put images of several takes together."""
    return Errors(*(np.concatenate(arrays) for arrays in zip(*errors, strict=True)))
