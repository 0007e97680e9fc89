# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's hand as a chain of bones, fitted to landmarks that were seen by one camera.

The landmarks across the view are good to a pixel or two; their depth is an estimate. Bones of known length
join both: what is foreshortened across the view must go along it, and the estimate says which way.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_skeleton_retriever.lifting.hand_axes import INDEX, KNUCKLES, MIDDLE, THUMB, WRIST, palm_axes

# Deviation of a landmark across the view and in depth [pixel]; the residual of the fits is 2.3 and 8.
_ACROSS, _DEPTH = 2.5, 10.0
# The palm is stiff, and its six points tell how it is turned. Where fingers are not the hinges they are taken
# for - an index pressed aside by the thumb - it is they that give way while the palm is sought: beyond a
# deviation they pull no harder. T's palm is then 14 deg off what its six points say alone, else 26.
_FINGER_POINTS = [point for point in range(21) if point not in (WRIST, THUMB, *KNUCKLES)]
# Fingers spread about their natural direction by 12 deg or so; the last joint follows the middle one at about
# 0.6 of its angle (they share a tendon), give or take 25 deg.
_NATURAL_SPREAD = np.radians([-2.0, 0.0, 3.0, 8.0])
_SPREAD_DEVIATION, _LAST_JOINT_DEVIATION, _LAST_JOINT_RATIO = np.radians(12.0), np.radians(25.0), 0.6
_THUMB_LENGTH_DEVIATION = 2.0  # [pixel]
# Bounds of knuckle bend, spread, middle and last joint [rad] of a healthy hand.
_LOWER, _UPPER = np.radians([-25.0, -25.0, 0.0, 0.0]), np.radians([100.0, 25.0, 115.0, 80.0])
# Length of a bone is what 9 of 10 frames do not exceed across the view: the fingers lie across it often
# enough.
_LENGTH_PERCENTILE = 90.0


@dataclass(frozen=True, kw_only=True)
class SignerHand:
    """The size of one person's hand [pixel].

    Attributes:
        palm: Wrist, thumb's first joint and the four knuckles, in palm axes (along the hand, to the little
            finger's side, out of the palm) from the wrist. Shape (6, 3).
        fingers: Lengths of the three bones of index, middle, ring and little finger. Shape (4, 3).
        thumb: Lengths of the thumb's last three bones. Shape (3,).
    """

    palm: Array
    fingers: Array
    thumb: Array

    @property
    def finger_length(self) -> float:
        """Mean length of the four fingers, knuckle to tip [pixel]."""
        return float(self.fingers.sum(axis=1).mean())


@dataclass(frozen=True, kw_only=True)
class HandPose:
    """What a hand looked like.

    Attributes:
        rotation: Columns are the palm axes (along the hand, to the little finger's side, out of the palm) in
            the signer's axes (forward, left, up). Shape (3, 3).
        bends: Knuckle, middle and last joint of index, middle, ring and little finger [rad]. Shape (4, 3).
        spreads: Sideways angle of the fingers, towards the little finger positive [rad]. Shape (4,).
        thumb: Thumb's second joint, third joint and tip in palm axes from the index knuckle, in lengths of
            the mean finger. Shape (3, 3).
        tips: Finger tips in palm axes from the index knuckle, in lengths of the mean finger. Shape (4, 3).
        residual: Root mean square distance of landmarks and model across the view [pixel].
    """

    rotation: Array
    bends: Array
    spreads: Array
    thumb: Array
    tips: Array
    residual: float


def measure_signer(hands: Iterable[Array]) -> SignerHand:
    """Measure a hand from many frames, shape (n, 21, 3) each."""
    frames = np.concatenate([np.asarray(hand) for hand in hands])

    def length(first: int, second: int) -> float:
        across = np.linalg.norm(frames[:, first, 1:] - frames[:, second, 1:], axis=1)
        return float(np.percentile(across, _LENGTH_PERCENTILE))

    local = np.einsum("nij,nki->nkj", palm_axes(frames), frames - frames[:, WRIST, None])
    palm = np.median(local[:, (WRIST, THUMB, *KNUCKLES)], axis=0)
    # The estimate of depth makes the palm a little short; its length across the view does not.
    palm *= length(WRIST, MIDDLE) / np.linalg.norm(palm[3])
    fingers = [[length(knuckle + bone, knuckle + bone + 1) for bone in range(3)] for knuckle in KNUCKLES]
    thumb = [length(THUMB + bone, THUMB + bone + 1) for bone in range(3)]
    return SignerHand(palm=palm, fingers=np.array(fingers), thumb=np.array(thumb))


def fit_hand(landmarks: Array, signer: SignerHand) -> HandPose:
    """Fit the bones to one set of landmarks.

    Args:
        landmarks: Shape (21, 3) [pixel], axes forward, left, up.
        signer: Size of the hand.
    """
    centred = landmarks - landmarks.mean(axis=0)
    axes = palm_axes(centred[None])[0]
    problem = _Problem(centred, signer)
    # The sign of the depth is the weak point of one camera: try the palm turned towards and away as well.
    starts = [
        problem.start(Rotation.from_rotvec(turn * axes[:, 1]).as_matrix() @ axes) for turn in (0.0, 0.5, -0.5)
    ]
    fits = [least_squares(problem.turned, start, bounds=problem.bounds, max_nfev=60) for start in starts]
    palm, bent = np.split(min(fits, key=lambda fit: float(fit.cost)).x, [3])
    fit = least_squares(
        lambda rest: problem.residuals(np.concatenate([palm, rest])),
        bent,
        bounds=tuple(bound[3:] for bound in problem.bounds),
        max_nfev=60,
    )
    best = np.concatenate([palm, fit.x])
    rotation, local = problem.hand(best)
    seen = local @ rotation.T
    away = (seen - seen.mean(axis=0) - centred)[:, 1:]
    fingers = best[3:19].reshape(4, 4)
    relative = (local - local[INDEX]) / signer.finger_length
    return HandPose(
        rotation=rotation,
        bends=fingers[:, [0, 2, 3]],
        spreads=fingers[:, 1],
        thumb=relative[THUMB + 1 : THUMB + 4],
        tips=relative[[knuckle + 3 for knuckle in KNUCKLES]],
        residual=float(np.sqrt((away**2).sum(axis=1).mean())),
    )


class _Problem:
    """Unknowns: rotation vector (3); knuckle, spread, middle, last joint a finger (16); thumb bones (9)."""

    def __init__(self, landmarks: Array, signer: SignerHand) -> None:
        self._landmarks = landmarks
        self._signer = signer
        lower = np.concatenate([np.full(3, -9.0), np.tile(_LOWER, 4), np.full(9, -60.0)])
        upper = np.concatenate([np.full(3, 9.0), np.tile(_UPPER, 4), np.full(9, 60.0)])
        self.bounds = (lower, upper)

    def start(self, axes: Array) -> Array:
        local = (self._landmarks - self._landmarks[WRIST]) @ axes
        x = np.zeros(28)
        x[:3] = Rotation.from_matrix(axes).as_rotvec()
        for finger, knuckle in enumerate(KNUCKLES):
            bones = np.diff(local[knuckle : knuckle + 4], axis=0)
            bends = [
                np.arctan2(bones[0, 2], bones[0, 0]),
                _angle(bones[0], bones[1]),
                _angle(bones[1], bones[2]),
            ]
            angles = np.array([bends[0], _NATURAL_SPREAD[finger], bends[1], bends[2]])
            x[3 + 4 * finger : 7 + 4 * finger] = np.clip(angles, _LOWER + 0.02, _UPPER - 0.02)
        thumb = np.diff(local[THUMB : THUMB + 4], axis=0)
        x[19:] = (thumb / np.linalg.norm(thumb, axis=1, keepdims=True) * self._signer.thumb[:, None]).ravel()
        return x

    def hand(self, x: Array) -> tuple[Array, Array]:
        """Rotation and the 21 points in palm axes from the wrist [pixel]."""
        points = np.zeros((21, 3))
        points[[WRIST, THUMB, *KNUCKLES]] = self._signer.palm
        for finger, knuckle in enumerate(KNUCKLES):
            bend, spread, middle, last = x[3 + 4 * finger : 7 + 4 * finger]
            total = np.cumsum([bend, middle, last])
            bones = finger_directions(total, float(spread)) * self._signer.fingers[finger][:, None]
            points[knuckle + 1 : knuckle + 4] = points[knuckle] + np.cumsum(bones, axis=0)
        points[THUMB + 1 : THUMB + 4] = points[THUMB] + np.cumsum(x[19:].reshape(3, 3), axis=0)
        return Rotation.from_rotvec(x[:3]).as_matrix(), points

    def turned(self, x: Array) -> Array:
        """Residuals for the palm's sake: fingers give way."""
        found = self.residuals(x)
        across = found[:42].reshape(21, 2)
        across[_FINGER_POINTS] = _giving_way(across[_FINGER_POINTS])
        return found

    def residuals(self, x: Array) -> Array:
        """Differences from the landmarks, and from what hands are like, in standard deviations."""
        rotation, local = self.hand(x)
        seen = local @ rotation.T
        away = seen - seen.mean(axis=0) - self._landmarks
        fingers = x[3:19].reshape(4, 4)
        thumb = np.linalg.norm(x[19:].reshape(3, 3), axis=1) - self._signer.thumb
        return np.concatenate(
            [
                (away[:, 1:] / _ACROSS).ravel(),
                away[:, 0] / _DEPTH,
                (fingers[:, 1] - _NATURAL_SPREAD) / _SPREAD_DEVIATION,
                (fingers[:, 3] - _LAST_JOINT_RATIO * fingers[:, 2]) / _LAST_JOINT_DEVIATION,
                thumb / _THUMB_LENGTH_DEVIATION,
            ]
        )


def _giving_way(away: Array) -> Array:
    """Residuals whose squares grow as their lengths beyond 1 (pseudo-Huber loss). Shape (n, 2)."""
    length = np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
    shrunk: Array = away * (np.sqrt(2.0 * (np.hypot(1.0, length) - 1.0)) / length)
    return shrunk


def finger_directions(total_bends: Array, spread: float) -> Array:
    """Directions of a finger's bones in palm axes.

    Args:
        total_bends: Angle of each bone out of the plane of the palm [rad]. Shape (k,).
        spread: Sideways angle of the finger's plane [rad].

    Returns:
        Unit vectors. Shape (k, 3).
    """
    ahead = np.cos(total_bends)
    return np.stack([ahead * np.cos(spread), ahead * np.sin(spread), np.sin(total_bends)], axis=-1)


def _angle(first: Array, second: Array) -> float:
    cosine = first @ second / (np.linalg.norm(first) * np.linalg.norm(second))
    return float(np.arccos(np.clip(cosine, -1.0, 1.0)))
