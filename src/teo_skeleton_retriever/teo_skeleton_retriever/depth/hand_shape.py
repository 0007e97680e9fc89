# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The shape of a hand as the detector estimates it, fitted to measured depths.

MediaPipe's world landmarks tell how fingers bend against the palm, but neither how the hand is turned nor how
large it is: on rendered hands the step in depth along a bone of the palm was off by 27 mm (root mean square),
that along a finger's bone by 15 mm, but by 12 mm once the shape lay on the true palm. So only directions of
bones are taken from it; their lengths are the person's, and the whole is turned to where the depths are.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.layouts.layout import HAND_21

N = len(HAND_21)
CHILD = np.arange(1, N)
# Keypoints at the ends of each of the 20 bones, finger by finger from the wrist.
PARENT = np.array([0 if i % 4 == 1 else i - 1 for i in range(1, N)])
_PALM = np.isin(np.arange(N), [HAND_21.index[name] for name in ("Wrist", "ThumbCMC")]) | np.array(
    [name.endswith("MCP") and not name.startswith("Thumb") for name in HAND_21.keypoints]
)
# Bones that hold the palm together. Shape (20,)
PALM_BONES = _PALM[CHILD]
# How a keypoint counts for how a hand is turned: a palm keeps its shape. Shape (21,)
RIGID = np.where(_PALM, 1.0, 0.3)
_OUTLIER = 0.025  # [m] farther off the shape a depth is another's: two fingers, and the shape's own error
_ITERATIONS = 2  # more were no better on rendered people
# Which bones lead from the wrist to each keypoint.
_WRIST_TO = np.zeros((N, N - 1))
for _i in range(1, N):
    _WRIST_TO[_i] = _WRIST_TO[PARENT[_i - 1]]
    _WRIST_TO[_i, _i - 1] = 1.0


def imagined_bones(world: FloatArray, lengths: FloatArray) -> FloatArray:
    """Bones of the estimated hand, scaled to the person's bone lengths [m]. Shape (20, 3).

    Args:
        world: The imagined keypoints, of any size. Shape (21, 3).
        lengths: Of the person's bones [m]. Shape (20,).
    """
    bones = world[CHILD] - world[PARENT]
    size = np.sqrt((bones * bones).sum(axis=1))
    shaped: FloatArray = bones * (lengths / np.maximum(size, 1e-9))[:, None]
    return shaped


def turned(bones: FloatArray, onto: FloatArray, weights: FloatArray) -> FloatArray:
    """Rotate hands as rigid bodies so that their bones fit others best (Kabsch 1976).

    Args:
        bones: Of k hands. Shape (k, m, 3).
        onto: Where they should lie. Shape (k, m, 3).
        weights: How each counts. Shape (k, m).
    """
    u, _, v = np.linalg.svd((bones * weights[..., None]).transpose(0, 2, 1) @ onto)
    u[:, :, 2] *= np.sign(np.linalg.det(u @ v))[:, None]  # a turn, never a mirror
    result: FloatArray = bones @ (u @ v)
    return result


def laid(bones: FloatArray, bends: FloatArray, depths: FloatArray, weights: FloatArray) -> FloatArray:
    """Fit hands as rigid shapes to measured depths, some of which are outliers.

    Args:
        bones: Of k hands. Shape (k, 20, 3).
        bends: Viewing rays of the keypoints, x/z, y/z, 1; finite. Shape (k, 21, 3).
        depths: Of the joints [m]; finite. Shape (k, 21).
        weights: How each keypoint counts. Shape (k, 21).

    Returns:
        Depths of the keypoints of the laid shape [m]. Shape (k, 21).
    """
    shape = _WRIST_TO @ bones
    points = bends * depths[..., None]
    robust = usual = weights * RIGID
    for _ in range(_ITERATIONS):
        share = (robust / robust.sum(axis=1, keepdims=True))[..., None]
        centre = (share * points).sum(axis=1, keepdims=True)
        centred = shape - (share * shape).sum(axis=1, keepdims=True)
        on = (turned(centred, points - centre, share[..., 0]) + centre)[..., 2]
        robust = usual / (1.0 + ((depths - on) / _OUTLIER) ** 2) ** 2
    return np.asarray(on)
