# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Errors of joints against the truth, split by what contributed to them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from accuracy.methods import Estimate
from accuracy.takes import TakeFrame
from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25, HAND_21

ARMS = ("RShoulder", "LShoulder", "RElbow", "LElbow", "RWrist", "LWrist")
ARM_ROWS = np.array([BODY_25.index[name] for name in ARMS])
HEAD = ("Nose", "REye", "LEye", "REar", "LEar")
HEAD_ROWS = np.array([BODY_25.index[name] for name in HEAD])
HAND_NAMES = [f"{side}Hand{name}" for side in ("L", "R") for name in HAND_21.keypoints]


class Errors(NamedTuple):
    """Errors of n keypoints in m images; NaN where the method says nothing."""

    names: list[str]
    distance: FloatArray
    """[m]. Shape (m, n)"""
    sideways: FloatArray
    """across the viewing ray [m]. Shape (m, n)"""
    depth: FloatArray
    """along it, positive if too far [m]. Shape (m, n)"""
    visible: BoolArray
    """by the truth. Shape (m, n)"""
    ratio: FloatArray
    """error over sigma along x, y and z. Shape (m, n, 3)"""
    status: NDArray[np.uint8]
    """of `KeypointStatus`. Shape (m, n)"""

    def joined(self, others: Sequence[Errors]) -> Errors:
        """Put images of several takes together."""
        parts = (self, *others)
        return Errors(
            self.names,
            distance=np.concatenate([part.distance for part in parts]),
            sideways=np.concatenate([part.sideways for part in parts]),
            depth=np.concatenate([part.depth for part in parts]),
            visible=np.concatenate([part.visible for part in parts]),
            ratio=np.concatenate([part.ratio for part in parts]),
            status=np.concatenate([part.status for part in parts]),
        )

    def of(self, *parts: str) -> Errors:
        """Keep the keypoints whose name ends in one of these."""
        rows = [i for i, name in enumerate(self.names) if name.endswith(parts)]
        return Errors(
            [self.names[i] for i in rows],
            self.distance[:, rows],
            self.sideways[:, rows],
            self.depth[:, rows],
            self.visible[:, rows],
            self.ratio[:, rows],
            self.status[:, rows],
        )

    def where(self, chosen: BoolArray) -> Errors:
        """Keep those that are chosen. Shape (m, n)."""
        arrays = [np.where(chosen, array, np.nan) for array in (self.distance, self.sideways, self.depth)]
        ratio = np.where(chosen[..., None], self.ratio, np.nan)
        return self._replace(distance=arrays[0], sideways=arrays[1], depth=arrays[2], ratio=ratio)


def body_errors(frames: Sequence[TakeFrame], estimates: Sequence[Estimate]) -> Errors:
    """Give the errors of shoulders, elbows and wrists."""
    truth = np.array([frame.truth.body[ARM_ROWS] for frame in frames])
    visible = np.array([frame.truth.body_visible[ARM_ROWS] for frame in frames])
    sigma = np.array([estimate.sigma[ARM_ROWS] for estimate in estimates])
    status = np.array([estimate.status[ARM_ROWS] for estimate in estimates])
    return _errors(list(ARMS), truth, np.array([e.body[ARM_ROWS] for e in estimates]), visible, sigma, status)


def head_errors(frames: Sequence[TakeFrame], estimates: Sequence[Estimate]) -> Errors:
    """Give the errors of nose, eyes and ears."""
    truth = np.array([frame.truth.body[HEAD_ROWS] for frame in frames])
    visible = np.array([frame.truth.body_visible[HEAD_ROWS] for frame in frames])
    sigma = np.array([estimate.sigma[HEAD_ROWS] for estimate in estimates])
    status = np.array([estimate.status[HEAD_ROWS] for estimate in estimates])
    found = np.array([estimate.body[HEAD_ROWS] for estimate in estimates])
    return _errors(list(HEAD), truth, found, visible, sigma, status)


def hand_errors(frames: Sequence[TakeFrame], estimates: Sequence[Estimate]) -> Errors:
    """Give the errors of the 42 keypoints of both hands."""
    truth = np.array([np.concatenate([f.truth.left_hand, f.truth.right_hand]) for f in frames])
    visible = np.array(
        [np.concatenate([f.truth.left_hand_visible, f.truth.right_hand_visible]) for f in frames]
    )
    sigma = np.array([estimate.sigma[25:] for estimate in estimates])
    status = np.array([estimate.status[25:] for estimate in estimates])
    return _errors(HAND_NAMES, truth, np.array([e.hands for e in estimates]), visible, sigma, status)


def face_errors(frames: Sequence[TakeFrame], estimates: Sequence[Estimate]) -> Errors:
    """Give the errors of the 70 keypoints of the face."""
    truth = np.array([frame.truth.face for frame in frames])
    visible = np.array([frame.truth.face_visible for frame in frames])
    names = [f"Face{i}" for i in range(truth.shape[1])]
    found = np.array([estimate.face for estimate in estimates])
    nothing = np.zeros(visible.shape, dtype=np.uint8)
    return _errors(names, truth, found, visible, np.full(truth.shape, np.nan), nothing)


def _errors(
    names: list[str],
    truth: FloatArray,
    found: FloatArray,
    visible: BoolArray,
    sigma: FloatArray,
    status: NDArray[np.uint8],
) -> Errors:
    ray = truth / np.linalg.norm(truth, axis=-1, keepdims=True)
    off = found - truth
    along = (off * ray).sum(axis=-1)
    across = np.linalg.norm(off - along[..., None] * ray, axis=-1)
    return Errors(names, np.linalg.norm(off, axis=-1), across, along, visible, off / sigma, status)
