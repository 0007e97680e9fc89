# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How a person holds the head: turned and moved against the trunk, frame by frame."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import (
    BODY,
    EAR,
    EYE,
    FACE,
    NOSE,
    Flags,
    SkeletonTrack,
    filled,
    seen,
)

# Deviation of each keypoint of the head from a rigid head [m]; body's first, then the face's: contour of the
# jaw, brows, bridge and wings of the nose, eyes, mouth, pupils. Infinite for what is not of the head. Jaw and
# lips move by a centimetre or two while somebody speaks, brows by half of one, the rest with the skin.
_GIVE = np.full(BODY + FACE, np.inf)
_GIVE[[NOSE, *EYE.values(), *EAR.values()]] = 0.004
for _rows, _give in (
    ((0, 17), 0.015),
    ((17, 27), 0.006),
    ((27, 48), 0.004),
    ((48, 68), 0.015),
    ((68, 70), 0.004),
):
    _GIVE[BODY + _rows[0] : BODY + _rows[1]] = _give
_HEAD = np.isfinite(_GIVE)
# Right and left ear, eye, outer corner of the eye: which of them are level when the head is straight.
_PAIRS = (
    (EAR["right"], EAR["left"]),
    (EYE["right"], EYE["left"]),
    (BODY + 36, BODY + 45),
)
# [m] Of a keypoint that says none of its own: a depth camera's at 2 m.
_UNKNOWN_SIGMA = 0.02
# Alignment and mean shape are found in turns; after the third neither moves by 0.1 mm.
_PASSES = 3
# Rounds in which keypoints off the rigid head lose their weight: with an arm before a third of the face the
# fit is there after ten.
_ROUNDS = 12
# Deviations from the rigid head, in sigmas, at which a keypoint counts a quarter (Geman and McClure 1987),
# and beyond which it is something else, such as an arm before the face.
_QUARTER, _OFF = 2.0, 3.0
# Share of the head's keypoints that must be seen for its turn to be believed.
_SEEN = 0.5
_LEAST_POINTS = 3
# `Keypoint3D.STATUS_HELD`: where it was, not seen.
_HELD = 2
# [rad] Necks turn by 80 deg to either side (American Academy of Orthopaedic Surgeons, Joint Motion, 1965), of
# young people by 90.
_NECK_RANGE = np.radians(90.0)
# [rad/s] Fastest turn of a head that people shake as fast as they can: 780 deg/s, the median of 20 (Grossman
# et al., Exp Brain Res 70, 1988).
_NECK_RATE = np.radians(780.0)


class HeadPose(NamedTuple):
    """A head over time.

    Attributes:
        turns: How the head is turned from straight; filled in where it is not seen. Shape (T, 3, 3).
        places: Where its middle is, in the axes of the track [m]; NaN if it is never seen. Shape (T, 3).
        seen: Whether half of the head is seen, held as a neck can hold it. Shape (T,).
    """

    turns: Array
    places: Array
    seen: Flags


class _Points(NamedTuple):
    """Keypoints of body and face: places [m], deviations [m], and which count. (T, 95, 3), (T, 95) twice."""

    places: Array
    sigma: Array
    known: Flags


def head_shape(track: SkeletonTrack) -> Array:
    """Find the keypoints of the head about its middle, the head held straight.

    Straight is where both ears (or eyes, where ears are not seen) are level and to the left and right; as to
    nodding it is where the head mostly is.

    Returns:
        Of body and face; NaN where never seen, and in keypoints that are not of the head [m]. Shape (95, 3).
    """
    points = _points(track)
    places = np.where(points.known[..., None], points.places, np.nan)
    shape = _median(places)
    for _ in range(_PASSES):
        # Nothing is off a shape that is only being found; the median does without what is.
        turns, middles, enough = _held(track.times, points, shape, rounds=1)
        if not enough.any():
            return np.full((BODY + FACE, 3), np.nan)
        shape = _median(_straightened(places, turns, middles)[enough])
    whole = _median(_straightened(places, turns @ _level(shape).T, middles)[enough])
    return whole - _middle(whole)


def head_pose(track: SkeletonTrack, shape: Array) -> HeadPose:
    """Find how a head of a known shape, as `head_shape` gives it, is held; straight while it is not seen.

    One rigid head is fitted to all keypoints, each weighed by its sigma. Frames in which less than half of it
    is seen, or that no neck could reach from those before and after, are filled in.
    """
    turns, places, enough = _held(track.times, _points(track), shape, rounds=_ROUNDS)
    if not enough.any():
        straight = np.broadcast_to(np.eye(3), turns.shape)
        return HeadPose(straight, np.full_like(places, np.nan), enough)
    return HeadPose(turns, places, enough)


def _points(track: SkeletonTrack) -> _Points:
    places = np.concatenate([track.body.positions, track.face.positions], axis=1)
    sigma = np.concatenate([track.body.sigma, track.face.sigma], axis=1)
    status = np.concatenate([track.body.status, track.face.status], axis=1)
    known = seen(places) & (status != _HELD) & _HEAD
    return _Points(places, np.hypot(np.where(np.isfinite(sigma), sigma, _UNKNOWN_SIGMA), _GIVE), known)


def _straightened(points: Array, turns: Array, places: Array) -> Array:
    """Points about the middle of the head, in the head's own axes. Shape (T, k, 3)."""
    straight: Array = np.einsum("tij,tki->tkj", turns, points - places[:, None])
    return straight


def _held(times: Array, points: _Points, shape: Array, *, rounds: int) -> tuple[Array, Array, Flags]:
    """Turns and places that bring a shape onto what was seen, and in which frames enough of it was."""
    known = points.known & seen(shape)
    there, model = np.where(known[..., None], points.places, 0.0), np.nan_to_num(shape)
    precise = known / np.square(np.where(known, points.sigma, 1.0))
    turns, places = _aligned(model, there, precise)
    fitting = known
    for _ in range(rounds - 1):
        off = np.linalg.norm(_straightened(there, turns, places) - model, axis=2) / points.sigma
        fitting = known & (off < _OFF * np.sqrt(3.0))
        # While most is off, the half that is least off leads to the head.
        usual = _median(np.where(known, off, np.nan).T)[:, None]
        counts = 1.0 / np.square(1.0 + np.square(off / np.fmax(usual, _QUARTER)))
        turns, places = _aligned(model, there, precise * counts)
    least = max(_LEAST_POINTS, _SEEN * np.count_nonzero(seen(shape)))
    enough = (fitting.sum(axis=1) >= least) & (np.abs(_yaw(turns)) <= _NECK_RANGE)
    enough[enough] = _reachable(times[enough], turns[enough])
    if enough.any() and not enough.all():
        turns, places = _everywhere(times, turns, places, enough)
    return turns, places, enough


def _yaw(turns: Array) -> Array:
    """By how much heads are turned to the left of the trunk [rad]. Shape (T,)."""
    return np.arctan2(turns[:, 1, 0], turns[:, 0, 0])


def _reachable(times: Array, turns: Array) -> Flags:
    """The most frames that a neck can take one after the other. Shape (T,)."""
    # Whatever is longer ago than this is within reach.
    far = np.pi / _NECK_RATE
    length, before = np.ones(len(times), dtype=int), np.full(len(times), -1)
    for frame, time in enumerate(times):
        recent = np.arange(np.searchsorted(times, time - far), frame)
        traces = np.einsum("tij,ij->t", turns[recent], turns[frame])
        angles = np.arccos(np.clip((traces - 1.0) / 2.0, -1.0, 1.0))
        near = recent[angles <= _NECK_RATE * (time - times[recent])]
        older = np.arange(recent[0] if len(recent) else frame)
        from_here = np.concatenate([older, near])
        if len(from_here):
            before[frame] = from_here[np.argmax(length[from_here])]
            length[frame] = length[before[frame]] + 1
    kept = np.zeros(len(times), dtype=bool)
    frame = int(np.argmax(length)) if len(times) else -1
    while frame >= 0:
        kept[frame], frame = True, int(before[frame])
    return kept


def _aligned(shape: Array, there: Array, weights: Array) -> tuple[Array, Array]:
    """Rotations and places that bring a shape onto what was seen (Kabsch, Acta Cryst. 1976)."""
    total = weights.sum(axis=1)[:, None]
    total = np.where(total > 0.0, total, 1.0)
    from_middle, to_middle = weights @ shape / total, (weights[..., None] * there).sum(axis=1) / total
    from_mean = shape - from_middle[:, None]
    spread = np.einsum("tk,tki,tkj->tij", weights, there - to_middle[:, None], from_mean)
    left, _, right = np.linalg.svd(spread)
    # Where the points say nothing of a direction, the sign is what makes a rotation.
    signs = np.ones((len(there), 3))
    signs[:, 2] = np.sign(np.linalg.det(left @ right))
    turns: Array = (left * signs[:, None]) @ right
    return turns, to_middle - np.einsum("tij,tj->ti", turns, from_middle)


def _everywhere(times: Array, turns: Array, places: Array, known: Flags) -> tuple[Array, Array]:
    """The same with frames filled in where the head was not seen."""
    vectors = Rotation.from_matrix(turns).as_rotvec()
    vectors[~known], places = np.nan, np.where(known[:, None], places, np.nan)
    return Rotation.from_rotvec(filled(times, vectors)).as_matrix(), filled(times, places)


def _level(shape: Array) -> Array:
    """The rotation that levels the ears, or the eyes, of a shape. Shape (3, 3)."""
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
    points = ears if np.isfinite(ears).all() else shape[seen(shape)]
    middle: Array = points.mean(axis=0)
    return middle


def _median(values: Array) -> Array:
    """Median over the first axis of what is known; NaN where nothing is."""
    known = np.isfinite(values).any(axis=0)
    result = np.full(values.shape[1:], np.nan)
    if known.any():
        result[known] = np.nanmedian(values[:, known], axis=0)
    return result
