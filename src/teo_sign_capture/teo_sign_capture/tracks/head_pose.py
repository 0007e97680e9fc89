# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a person holds the head: turned and moved against the trunk, frame by frame."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_sign_capture.tracks.body_axes import filled
from teo_sign_capture.tracks.skeleton_track import BODY, EAR, EYE, FACE, NOSE, SkeletonTrack

# Keypoints of the head that keep their places to each other: of the body nose, eyes, ears; of the face the
# bridge of the nose and the corners of the eyes. Rows of body and face, one after the other.
_RIGID = (NOSE, *EYE.values(), *EAR.values(), *(BODY + row for row in (27, 28, 29, 30, 36, 39, 42, 45)))
# Among these: right and left ear, eye, outer corner of the eye.
_PAIRS = ((3, 4), (1, 2), (9, 12))
# Alignment and mean shape are found in turns; after the third neither moves by 0.1 mm.
_PASSES = 3


class HeadPose(NamedTuple):
    """A head over time.

    Attributes:
        turns: How the head is turned from straight. Shape (T, 3, 3).
        places: Where its middle is, in the axes of the track [m]; NaN if it is never seen. Shape (T, 3).
    """

    turns: Array
    places: Array


def head_shape(track: SkeletonTrack) -> Array:
    """Find the keypoints of the head about its middle, the head held straight.

    Straight is where both ears (or eyes, where ears are not seen) are level and to the left and right; as to
    nodding it is where the head mostly is.

    Returns:
        Of body and face; NaN where never seen, and in keypoints that are not of the head [m]. Shape (95, 3).
    """
    points = np.concatenate([track.body.positions, track.face.positions], axis=1)
    rigid = points[:, _RIGID]
    shape = _median(rigid)
    for _ in range(_PASSES):
        turns, places, enough = _held(track.times, rigid, shape)
        if not enough.any():
            return np.full((BODY + FACE, 3), np.nan)
        shape = _median(_straightened(rigid, turns, places)[enough])
    whole = _median(_straightened(points, turns @ _level(shape).T, places)[enough])
    whole[:BODY][[row for row in range(BODY) if row not in _RIGID]] = np.nan
    return whole - _middle(whole)


def head_pose(track: SkeletonTrack, shape: Array) -> HeadPose:
    """Find how a head of a known shape, as `head_shape` gives it, is held; straight while it is not seen."""
    rigid = np.concatenate([track.body.positions, track.face.positions], axis=1)[:, _RIGID]
    turns, places, enough = _held(track.times, rigid, shape[list(_RIGID)])
    if not enough.any():
        straight = np.broadcast_to(np.eye(3), turns.shape)
        return HeadPose(straight, np.full_like(places, np.nan))
    return HeadPose(turns, places)


def _straightened(points: Array, turns: Array, places: Array) -> Array:
    """Points about the middle of the head, in the head's own axes. Shape (T, k, 3)."""
    straight: Array = np.einsum("tij,tki->tkj", turns, points - places[:, None])
    return straight


def _held(times: Array, rigid: Array, shape: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Turns and places that bring a shape onto what was seen, and in which frames enough of it was."""
    known = _known(rigid) & _known(shape)
    enough = known.sum(axis=1) >= 3
    seen = np.where(known[..., None], rigid, 0.0)
    turns, places = _aligned(np.nan_to_num(shape), seen, known.astype(np.float64))
    if enough.any() and not enough.all():
        turns, places = _everywhere(times, turns, places, enough)
    return turns, places, enough


def _aligned(shape: Array, seen: Array, weights: Array) -> tuple[Array, Array]:
    """Rotations and places that bring a shape onto what was seen (Kabsch, Acta Cryst. 1976)."""
    total = np.maximum(weights.sum(axis=1), 1.0)[:, None]
    from_middle, to_middle = weights @ shape / total, (weights[..., None] * seen).sum(axis=1) / total
    spread = np.einsum("tk,tki,tkj->tij", weights, seen - to_middle[:, None], shape - from_middle[:, None])
    left, _, right = np.linalg.svd(spread)
    # Where the points say nothing of a direction, the sign is what makes a rotation.
    signs = np.ones((len(seen), 3))
    signs[:, 2] = np.sign(np.linalg.det(left @ right))
    turns: Array = (left * signs[:, None]) @ right
    return turns, to_middle - np.einsum("tij,tj->ti", turns, from_middle)


def _everywhere(times: Array, turns: Array, places: Array, known: NDArray[np.bool_]) -> tuple[Array, Array]:
    """The same with frames filled in where the head was not seen."""
    vectors = Rotation.from_matrix(turns).as_rotvec()
    vectors[~known], places = np.nan, np.where(known[:, None], places, np.nan)
    return Rotation.from_rotvec(filled(times, vectors)).as_matrix(), filled(times, places)


def _level(shape: Array) -> Array:
    """The rotation that levels the ears, or the eyes, of a shape in the order of `_RIGID`. Shape (3, 3)."""
    for right, left in _PAIRS:
        across = shape[left] - shape[right]
        if np.isfinite(across).all():
            break
    else:
        return np.eye(3)
    across /= np.linalg.norm(across)
    turned = Rotation.from_rotvec(_way(across, np.array([0.0, 1.0, 0.0])))
    matrix: Array = turned.as_matrix()
    return matrix


def _way(start: Array, end: Array) -> Array:
    """The shortest rotation from one unit vector to another, as a rotation vector [rad]."""
    axis = np.cross(start, end)
    sine, cosine = float(np.linalg.norm(axis)), float(start @ end)
    if sine < 1e-9:
        return np.zeros(3)
    vector: Array = axis / sine * np.arctan2(sine, cosine)
    return vector


def _middle(shape: Array) -> Array:
    """The middle of the head: between the ears; where they are not seen, of all that is. Shape (3,)."""
    ears = shape[list(EAR.values())]
    seen = ears if np.isfinite(ears).all() else shape[np.isfinite(shape).all(axis=1)]
    middle: Array = seen.mean(axis=0)
    return middle


def _known(points: Array) -> NDArray[np.bool_]:
    """Which points are known. Shapes (..., 3) and (...)."""
    return np.asarray(np.isfinite(points).all(axis=-1))


def _median(values: Array) -> Array:
    """Median over the first axis of what is known; NaN where nothing is."""
    known = np.isfinite(values).any(axis=0)
    result = np.full(values.shape[1:], np.nan)
    if known.any():
        result[known] = np.nanmedian(values[:, known], axis=0)
    return result
