# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depths of a hand's 21 keypoints, from what is measured of them and the hand's own shape.

MediaPipe's world landmarks tell how fingers bend against the palm, but neither how the hand is turned nor how
large it is: on rendered hands the step in depth along a bone of the palm was off by 27 mm (root mean square),
that along a finger's bone by 15 mm, but by 12 mm once the shape lay on the true palm. So only directions of
bones are taken from it; their lengths are the person's, and the whole is turned to where the depths are.

Every keypoint lies on its viewing ray; its depth minimises the sum of
- its misfit to the measured surface (robust: fingers hide each other, pixels beside a finger see the chest),
- the misfit of each bone to its length, which grows with the person,
- the misfit of each bone's step in depth to the imagined shape, of the size of the hand and turned,
- the misfit of the wrist to where it is by the arm, which counts where nothing is measured.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.depth.skin import HAND_DEPTHS
from teo_skeleton_retriever.layouts.layout import HAND_21
from teo_skeleton_retriever.layouts.person_layout import HAND_BONES

_KEYPOINTS = len(HAND_21)
CHILD = np.arange(1, _KEYPOINTS)
# Keypoints at the ends of each of the 20 bones, finger by finger from the wrist.
PARENT = np.array([0 if i % 4 == 1 else i - 1 for i in range(1, _KEYPOINTS)])
_PALM = np.isin(np.arange(_KEYPOINTS), [HAND_21.index[name] for name in ("Wrist", "ThumbCMC")]) | np.array(
    [name.endswith("MCP") and not name.startswith("Thumb") for name in HAND_21.keypoints]
)
# Bones that hold the palm together. Shape (20,)
PALM_BONES = _PALM[CHILD]
# How a keypoint counts for how a hand is turned: a palm keeps its shape. Shape (21,)
RIGID = np.where(_PALM, 1.0, 0.3)
_OFF_SHAPE = 0.025  # [m] farther off the shape a depth is another's: two fingers, and the shape's own error
_ITERATIONS = 2  # more were no better on rendered people
# Which bones lead from the wrist to each keypoint.
_WRIST_TO = np.zeros((_KEYPOINTS, _KEYPOINTS - 1))
for _i in range(1, _KEYPOINTS):
    _WRIST_TO[_i] = _WRIST_TO[PARENT[_i - 1]]
    _WRIST_TO[_i, _i - 1] = 1.0


def imagined_bones(world: FloatArray, lengths: FloatArray) -> FloatArray:
    """Bones of imagined keypoints of any size, shape (21, 3), as long as the person's [m]. Shape (20, 3)."""
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
        robust = usual / (1.0 + ((depths - on) / _OFF_SHAPE) ** 2) ** 2
    return np.asarray(on)


_BONE_SIGMA = 0.008  # [m] people's proportions differ, and a pixel is 2 to 3 mm
# [m] Of a bone's step in depth by the imagined shape, once that is turned. Shape (20,)
_STEP_SIGMA = np.where(PALM_BONES, 0.010, 0.012)
# How much of the imagined step in depth there is, from a finger's first bone to its last: where its end
# points is hardly more than a guess, which is best made small.
_RELIEF = np.tile([1.0, 1.0, 0.7, 0.4], 5)
_FLAT_SIGMA = 0.03  # [m] without an imagined shape: a hand is about across the view
_DATA_SIGMA = 0.006  # [m] how far the skin of a finger differs from a tube
_OUTLIER = 0.02  # [m] beyond it a measured surface is another's: two fingers' thickness
# [m] The same, from step to step of the solution: from half a palm, so that a shape imagined wrongly is put
# right by what is measured before that is judged (graduated non-convexity, Blake and Zisserman 1987).
_NARROWING = (0.05, 0.03)
_HAND = 0.2  # [m] a hand's length: what is measured farther from where it is imagined is not the hand
_UNMEASURED = 0.1  # how a keypoint that is not measured counts against one that is, for how a hand is turned
_ANCHOR_SIGMA = 0.03  # [m] of the wrist's depth by the arm, as far as the hand is concerned
_EXPECTED_SIGMA = 0.1  # [m] how far a hand moves in depth from image to image, and more
_IMAGINED = 2.0  # errors over sigma of what follows from the shape alone, on rendered people
_CERTAIN = 10  # measured keypoints that agree on the hand's shape: half of them
_FINGER = 0.012  # [m] less than the thickness of a finger with its skin
_LAYER_WEIGHTS = np.array([1.0, 0.5, 0.25])


class HandView(NamedTuple):
    """What one image shows of a hand."""

    rays: FloatArray
    """x/z, y/z; NaN where the detector did not see the keypoint. Shape (21, 2)"""
    surfaces: Surfaces
    """measured around each keypoint"""
    world: FloatArray | None
    """what the detector imagines of the shape [m]. Shape (21, 3), or None"""
    expected: float
    """depth of the hand by the images before [m]; NaN if there were none"""
    wrist: float
    """depth of the wrist's joint by the arm [m]; NaN if not known"""


class HandFit(NamedTuple):
    """A hand in space."""

    points: FloatArray
    """its keypoints [m]. Shape (21, 3)"""
    sigma: FloatArray
    """standard deviations of their depths [m]. Shape (21,)"""
    measured: BoolArray
    """keypoints whose own surface was measured; the others follow from the shape. Shape (21,)"""

    @property
    def certain(self) -> bool:
        """Whether enough keypoints were measured to exclude that something hides the whole hand."""
        return int(self.measured.sum()) >= _CERTAIN


def fit_hands(hands: list[HandView], scale: float, bones: FloatArray = HAND_BONES) -> list[HandFit | None]:
    """Find the depths of several hands in one batch.

    Args:
        hands: In one image.
        scale: Of the person against an average adult.
        bones: Lengths between the detector's keypoints, of an average adult [m]. Shape (20,).

    Returns:
        One for each hand; None if too little of it is seen to tell anything.
    """
    radius = HAND_DEPTHS * scale
    bones = scale * bones
    starts = [_start(hand, radius, bones) for hand in hands]
    usable = [(hand, start) for hand, start in zip(hands, starts, strict=True) if start is not None]
    if not usable:
        return [None] * len(hands)
    fits = iter(_solve([hand for hand, _ in usable], [start for _, start in usable], radius, bones))
    return [None if start is None else next(fits) for start in starts]


class _Start(NamedTuple):
    depths: FloatArray
    """where the joints may be [m]. Shape (21,)"""
    trust: FloatArray
    """how each of them counts. Shape (21,)"""
    bones: FloatArray
    """as imagined [m]; zero if they are not. Shape (20, 3)"""
    step_sigma: FloatArray
    """of the bones' steps in depth [m]. Shape (20,)"""
    anchor: float
    """depth of the wrist [m]"""


def _start(hand: HandView, radius: FloatArray, lengths: FloatArray) -> _Start | None:
    seen = np.isfinite(hand.rays[:, 0])
    if seen.sum() < _KEYPOINTS // 2:
        return None
    bones, step_sigma = np.zeros((_KEYPOINTS - 1, 3)), np.full(_KEYPOINTS - 1, _FLAT_SIGMA)
    if hand.world is not None:
        bones, step_sigma = imagined_bones(hand.world, lengths), _STEP_SIGMA
    # The detector sees a crop around the hand as if the camera looked straight at it: its z runs along this.
    towards = np.append(hand.rays[seen].mean(axis=0), 1.0)
    steps = bones @ _turned_axis(towards / np.linalg.norm(towards))
    offsets = np.append(0.0, np.cumsum(steps.reshape(5, 4), axis=1).ravel())
    wrist = _wrist_depth(hand, radius, offsets)
    if not np.isfinite(wrist):
        return None
    imagined = wrist + offsets
    measured = hand.surfaces.closest(imagined - radius).depth + radius
    near = np.abs(measured - imagined) < _HAND
    return _Start(
        np.where(near, measured, imagined),
        seen * np.where(near, 1.0, _UNMEASURED),
        bones,
        step_sigma,
        hand.wrist if np.isfinite(hand.wrist) else wrist,
    )


def _solve(
    hands: list[HandView], starts: list[_Start], radius: FloatArray, length: FloatArray
) -> list[HandFit]:
    k = len(hands)
    bends = np.concatenate([np.stack([h.rays for h in hands]), np.ones((k, _KEYPOINTS, 1))], axis=2)
    seen = np.isfinite(bends[..., 0])
    bends = np.where(seen[..., None], bends, 0.0)
    imagined = np.stack([start.bones for start in starts])
    step_weight = 1.0 / np.stack([start.step_sigma for start in starts])
    bone_weight = np.where(seen[:, CHILD] & seen[:, PARENT], 1.0 / _BONE_SIGMA, 0.0)
    slope = np.zeros((k, 2 * (_KEYPOINTS - 1), _KEYPOINTS))  # of the misfits of bones, then of steps
    bone_row, step_row = CHILD - 1, CHILD + _KEYPOINTS - 2
    slope[:, step_row, CHILD], slope[:, step_row, PARENT] = step_weight, -step_weight
    surfaces = Surfaces(
        *(np.concatenate(arrays) for arrays in zip(*(h.surfaces for h in hands), strict=True))
    )
    anchor = np.array([start.anchor for start in starts])
    depths = laid(
        imagined, bends, np.stack([start.depths for start in starts]), np.stack([s.trust for s in starts])
    )
    normal, weight = np.zeros((k, _KEYPOINTS, _KEYPOINTS)), np.zeros((k, _KEYPOINTS))
    diagonal = np.arange(_KEYPOINTS)
    for outlier in _NARROWING:
        chosen = surfaces.closest((depths - radius).ravel())
        off = chosen.depth.reshape(k, _KEYPOINTS) + radius - depths
        known = np.isfinite(off)
        off = np.where(known, off, 0.0)
        certain = 1.0 / (np.where(known, chosen.sigma.reshape(k, _KEYPOINTS), 1.0) ** 2 + _DATA_SIGMA**2)
        weight = np.where(known & seen, certain, 0.0) / (1.0 + (off / outlier) ** 2) ** 2
        weight[_hidden(bends, depths)] = 0.0
        bones = bends[:, CHILD] * depths[:, CHILD, None] - bends[:, PARENT] * depths[:, PARENT, None]
        trust = seen * (_UNMEASURED + weight * _DATA_SIGMA**2)
        trust = np.minimum(trust[:, CHILD], trust[:, PARENT]) * RIGID[CHILD]
        steps = _RELIEF * turned(imagined, bones, trust)[..., 2]
        lengths = np.sqrt((bones * bones).sum(axis=2)) + 1e-9
        unit = bones * (bone_weight / lengths)[..., None]
        slope[:, bone_row, CHILD] = (unit * bends[:, CHILD]).sum(axis=2)
        slope[:, bone_row, PARENT] = -(unit * bends[:, PARENT]).sum(axis=2)
        missed = np.concatenate(
            [
                (lengths - length) * bone_weight,
                (depths[:, CHILD] - depths[:, PARENT] - steps) * step_weight,
            ],
            axis=1,
        )
        down = slope.transpose(0, 2, 1)
        normal = down @ slope
        normal[:, diagonal, diagonal] += weight
        normal[:, 0, 0] += 1.0 / _ANCHOR_SIGMA**2
        right = weight * off - (down @ missed[..., None])[..., 0]
        right[:, 0] += (anchor - depths[:, 0]) / _ANCHOR_SIGMA**2
        depths = depths + np.linalg.solve(normal, right[..., None])[..., 0]
    sigma = np.sqrt(np.linalg.inv(normal)[:, diagonal, diagonal])
    believed = weight * _DATA_SIGMA**2 > 0.1
    sigma[~believed] *= _IMAGINED
    points = bends * depths[..., None]
    points[~seen] = np.nan
    return [HandFit(points[i], sigma[i], believed[i]) for i in range(k)]


def _hidden(bends: FloatArray, depths: FloatArray) -> BoolArray:
    """Which keypoints another part of the same hand hides. Shape (k, 21)."""
    points = bends * depths[..., None]
    parts = np.concatenate([points, (points[:, CHILD] + points[:, PARENT]) / 2.0], axis=1)
    x, y, z = (parts[:, None, :, i] - points[:, :, None, i] for i in range(3))
    hidden: BoolArray = np.asarray(((x**2 + y**2 < _FINGER**2) & (z < -_FINGER)).any(axis=2))
    return hidden


def _turned_axis(direction: FloatArray) -> FloatArray:
    """Image of the z axis under the shortest rotation from the optical axis to a direction. Shape (3,)."""
    return np.array([-direction[0], -direction[1], direction[2]])


def _wrist_depth(hand: HandView, radius: FloatArray, offsets: FloatArray) -> float:
    """Depth of the wrist on which most measured keypoints agree [m]; NaN if none is measured."""
    expected = hand.expected if np.isfinite(hand.expected) else hand.wrist
    votes = (hand.surfaces.depth + (radius - offsets)[:, None]).ravel()
    # The nearest surface is the hand's more likely than one behind it, and a whole one than a piece.
    weights = (hand.surfaces.support * _LAYER_WEIGHTS).ravel()
    known = np.isfinite(votes)
    votes, weights = votes[known], weights[known]
    if not len(votes):
        return float(expected)
    order = np.argsort(votes)
    votes, summed = votes[order], np.append(0.0, np.cumsum(weights[order]))
    ends = np.searchsorted(votes, votes + 2.0 * _OUTLIER)
    agreeing = summed[ends] - summed[:-1]
    if np.isfinite(expected):
        # Of two surfaces the one where the hand is thought to be, unless the other is much larger.
        agreeing *= np.exp(-0.5 * np.clip((votes - expected) / _EXPECTED_SIGMA, -1.5, 1.5) ** 2)
    best = int(np.argmax(agreeing))
    return float(votes[(best + ends[best] - 1) // 2])
