# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The depth of a head, as one rigid part, and of the face on it: what an arm before them shows is not theirs.

Every surface around a keypoint of head and face is a vote for where the head is. The head is there where most
agree that are no arm's, near where it was and where the shoulders let expect it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_skeleton_retriever.arrays import BoolArray, FloatArray, median
from teo_skeleton_retriever.depth.depth_lookup import Surfaces
from teo_skeleton_retriever.layouts.person_layout import ROW

HEAD = [ROW[name] for name in ("Nose", "REye", "LEye", "REar", "LEar")]
EARS = slice(3, 5)  # of `HEAD`
# [m] How far behind the eyes each of `HEAD` is while the head faces the camera.
_BEHIND_EYES = np.array([-0.02, 0.0, 0.0, 0.085, 0.085])
_AGREE = 0.06  # [m] about a depth within which votes agree: a head that is turned by 40 degrees
_OWN = 0.10  # [m] from where the head lets expect a keypoint within which a surface is its own
# [m] Eyes before the shoulders; heads are bowed and people lean.
_BEFORE_NECK, _BEFORE_NECK_SIGMA = 0.12, 0.10
_MOVED_SIGMA = 0.08  # [m] between images: a nod, and what the last estimate was off
_FLOOR = 0.05  # of a vote that is far from what is expected: people do what is not expected
_FACE_WEIGHT = 0.1  # of a keypoint of the face against one of the body: there are 70
_LEAST = 0.5  # votes: fewer are a speck
_SKIN_SIGMA = 0.008  # [m] how far the skin of a head is from where its kind has it
_HIDDEN_SIGMA = 0.045  # [m] of a keypoint that follows from the others of a turned head


class HeadDepths(NamedTuple):
    """Where a head is."""

    eyes: float
    """depth of the eyes [m]; NaN if nothing tells"""
    depths: FloatArray
    """of `HEAD` [m]; NaN if nothing tells. Shape (5,)"""
    sigma: FloatArray
    """their standard deviations [m]; NaN likewise. Shape (5,)"""
    hidden: BoolArray
    """keypoints at which no surface of the head was measured. Shape (5,)"""


def head_depths(
    head: Surfaces, behind: FloatArray, face: Surfaces, *, neck: float, expected: FloatArray
) -> HeadDepths:
    """Find a head.

    Args:
        head: Measured around `HEAD`, without what is an arm's.
        behind: How far behind the skin each of them is [m]. Shape (5,).
        face: Measured around the keypoints of the face, likewise.
        neck: Depth of the joint between the shoulders [m]; NaN if not known.
        expected: Depths of `HEAD` by the images before [m]; NaN if there were none. Shape (5,).
    """
    own = head.depth + behind[:, None]
    votes = np.concatenate([(own - _BEHIND_EYES[:, None]).ravel(), face.depth.ravel()])
    weights = np.concatenate([head.support.ravel(), _FACE_WEIGHT * face.support.ravel()])
    known = np.isfinite(votes)
    votes, weights = votes[known], weights[known]
    last = median(expected - _BEHIND_EYES)
    eyes = _agreed(votes, weights, neck - _BEFORE_NECK, last)
    if not np.isfinite(eyes):
        eyes = last if np.isfinite(last) else neck - _BEFORE_NECK
    there = eyes + _BEHIND_EYES
    off = np.abs(own - np.where(np.isfinite(expected), (there + expected) / 2.0, there)[:, None])
    off = np.where(np.abs(own - there[:, None]) < _OWN, off, np.inf)
    chosen = np.argmin(off, axis=1)
    rows = np.arange(len(HEAD))
    hidden: BoolArray = ~np.isfinite(off[rows, chosen])
    return HeadDepths(
        eyes,
        np.where(hidden, there, own[rows, chosen]),
        np.where(hidden, _HIDDEN_SIGMA, np.hypot(head.sigma[rows, chosen], _SKIN_SIGMA)),
        hidden,
    )


def _agreed(votes: FloatArray, weights: FloatArray, by_neck: float, last: float) -> float:
    """Depth on which most votes agree [m]; NaN where too few do."""
    if not len(votes):
        return float("nan")
    agreeing = (np.abs(votes[:, None] - votes) < _AGREE) @ weights
    likely = np.ones(len(votes))
    for expected, spread in ((by_neck, _BEFORE_NECK_SIGMA), (last, _MOVED_SIGMA)):
        if np.isfinite(expected):
            likely *= np.maximum(np.exp(-0.5 * ((votes - expected) / spread) ** 2), _FLOOR)
    best = int(np.argmax(agreeing * likely))
    if agreeing[best] < _LEAST:
        return float("nan")
    near = np.abs(votes - votes[best]) < _AGREE
    return float(np.average(votes[near], weights=weights[near]))


_HEAD_SIZE = 0.13  # [m] from the nose's tip to the ear: nothing of a face is farther from its middle
_OUTLIER = 0.015  # [m] off a smooth surface: half a nose
_SURFACE_SIGMA = 0.008  # [m] of a face about a smooth surface
_BEFORE = 0.04  # [m] no more of a face is before its middle: a nose
_ITERATIONS = 4
_LEAST_OF_FACE = 8  # measured keypoints for a surface of six numbers


class FaceDepths(NamedTuple):
    """The depths of a face."""

    depths: FloatArray
    """of the skin [m]; NaN if nothing is known. Shape (70,)"""
    sigma: FloatArray
    """standard deviations [m]; NaN likewise. Shape (70,)"""
    measured: BoolArray
    """keypoints whose own surface was measured. Shape (70,)"""


def face_depths(rays: FloatArray, surfaces: Surfaces, expected: float) -> FaceDepths:
    """Find the depths of a face.

    A quadratic surface is fitted robustly; hair, a hand before the face, the wall beside the jaw are off it.

    Args:
        rays: x/z, y/z; NaN where the detector did not see the keypoint. Shape (n, 2).
        surfaces: Measured around each keypoint.
        expected: Depth of the face by the images before [m]; NaN if there were none.
    """
    n = len(rays)
    unknown = FaceDepths(np.full(n, np.nan), np.full(n, np.nan), np.zeros(n, dtype=bool))
    nearest = surfaces.closest(np.full(n, expected))
    usable = np.isfinite(rays).all(axis=1) & np.isfinite(nearest.depth)
    if usable.sum() < _LEAST_OF_FACE:
        return unknown
    middle = median(nearest.depth[usable])
    if np.isfinite(expected) and abs(middle - expected) > _HEAD_SIZE:
        middle = expected
    usable &= np.abs(nearest.depth - middle) < _HEAD_SIZE
    if usable.sum() < _LEAST_OF_FACE:
        return unknown
    centre = rays[usable].mean(axis=0)
    seen: BoolArray = np.asarray(np.isfinite(rays).all(axis=1))
    x, y = np.where(seen[:, None], (rays - centre) * middle / 0.1, 0.0).T  # about -1 to 1 on a face
    terms = np.column_stack([np.ones(n), x, y, x * x, x * y, y * y])
    fitted = np.full(n, middle)
    # What hides a part of a face is nearer than it.
    known = np.where(usable, nearest.depth, middle)
    weight = usable * (known > middle - _BEFORE)
    soft = 1e-3 * np.diag([0.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    for _ in range(_ITERATIONS):
        weighed = (terms * weight[:, None]).T
        fitted = terms @ np.linalg.solve(weighed @ terms + soft, weighed @ known)
        misfit = known - fitted
        weight = usable / (1.0 + (misfit / _OUTLIER) ** 2) ** 2
    measured = usable & (np.abs(misfit) < 2.0 * _OUTLIER)
    inside = np.abs(fitted - middle) < _HEAD_SIZE
    depths = np.where(measured, nearest.depth, np.where(inside, fitted, middle))
    sigma = np.where(measured, np.hypot(nearest.sigma, 0.003), np.hypot(_SURFACE_SIGMA, _OUTLIER))
    return FaceDepths(np.where(seen, depths, np.nan), np.where(seen, sigma, np.nan), measured)
