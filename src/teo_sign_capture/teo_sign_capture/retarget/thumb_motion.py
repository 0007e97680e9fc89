"""A person's thumb over time on TEO's hand.

TEO's thumb has an abductor and one motor for both its joints. Its tip and joint are sought relative to the
knuckle of the index, in finger lengths; its tip as far from the other tips as the person's where they nearly
touch; and outside of fingers and palm. The same tip can be nearly reached from several sides, so that what
is best frame by frame jumps: the cheapest way through time is taken (Viterbi).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_description.hand_geometry import DextraTable
from teo_sign_capture.tracks.body_axes import smoothed
from teo_sign_capture.viterbi import cheapest_path

Array = NDArray[np.float64]

_JOINT, _TIP = 3, 4
_FINGER_TIPS = (8, 12, 16, 20)
"""Rows of the 21 keypoints."""

# Weights of squares: of a metre at the thumb's joint (1 at its tip), at the distance to a tip that it
# touches, inside of a finger or the palm; of a radian of way from frame to frame: 6 deg cost as much as 2 mm.
_JOINT_WEIGHT, _TOUCH_WEIGHT, _INSIDE_WEIGHT, _WAY_WEIGHT = 0.3, 3.0, 60.0, 4e-4
_NEAR, _TOUCH, _SURELY_APART = 0.045, 0.018, 0.006
"""[m] As in `hand_retarget`: tips farther apart are not meant to touch; distance of their axes when they do;
a smaller gap is a contact, two keypoints being off by 3 mm each."""
_RADII, _PALM_FRONT = 0.018, 0.006
"""[m] Radii of a phalanx of thumb and finger together; height over the palm at which the thumb touches it."""
_PALM_TO, _PALM_HALF_WIDTH = 0.032, 0.047
"""[m] The palm along and across the hand, the thumb's radius added (`dextra`)."""
_CANDIDATES = 32
"""Thumbs looked at closely in each frame: those whose tip is best."""
_EVERY = 2
"""Of the table's steps of 2 deg; in between it is smoothed."""
_TREMBLE = 0.04
"""[s] Deviation of the Gaussian that takes the steps away."""


def follow_thumb(table: DextraTable, times: Array, fingers: Array, person: Array) -> Array:
    """Find abductor and flexion of TEO's thumb in each frame.

    Args:
        table: TEO's hand.
        times: [s]. Shape (T,).
        fingers: Flexions of TEO's fingers [rad]. Shape (T, 4).
        person: The person's 21 keypoints in palm axes from the index knuckle, in TEO's size [m].
            Shape (T, 21, 3).

    Returns:
        [rad]. Shape (T, 2).
    """
    abductors, flexions = table.abductors[::_EVERY], table.thumb_flexions[::_EVERY]
    angles = np.stack(np.meshgrid(abductors, flexions, indexing="ij"), axis=-1).reshape(-1, 2)
    grid = table.thumb[::_EVERY, ::_EVERY].reshape(-1, 3, 3)
    points = table.finger_points(fingers)
    knuckle = table.fingers[0, 0, 0]
    rough = _apart(person[:, _TIP] + knuckle, grid[:, 2])
    rough += _JOINT_WEIGHT * _apart(person[:, _JOINT] + knuckle, grid[:, 1])
    chosen = np.argpartition(rough, _CANDIDATES, axis=1)[:, :_CANDIDATES]
    cost = np.take_along_axis(rough, chosen, axis=1) + _meeting(grid[chosen], points, person)
    path = cheapest_path(cost, angles[chosen], _WAY_WEIGHT)
    return smoothed(times, angles[chosen[np.arange(len(path)), path]], _TREMBLE)


def _apart(wanted: Array, reached: Array) -> Array:
    """Squares of the distances of n points from m others [m^2]. Shape (n, m)."""
    squares = (wanted**2).sum(axis=1)[:, None] + (reached**2).sum(axis=1) - 2.0 * wanted @ reached.T
    apart: Array = np.maximum(squares, 0.0)
    return apart


def _meeting(thumbs: Array, fingers: Array, person: Array) -> Array:
    """What thumbs cost that do not meet the fingers as the person's does, or go into them.

    Args:
        thumbs: Knuckle, joint and tip of c candidates [m]. Shape (T, c, 3, 3).
        fingers: Shape (T, 4, 4, 3).
        person: Shape (T, 21, 3).

    Returns:
        Shape (T, c).
    """
    gaps = np.linalg.norm(person[:, _FINGER_TIPS] - person[:, _TIP, None], axis=2)
    nearness = np.clip(1.0 - gaps / _NEAR, 0.0, 1.0)
    # Several fingers at the thumb share the weight of one.
    nearness /= np.maximum(nearness.sum(axis=1, keepdims=True), 1.0)
    wanted = np.where(gaps < _TOUCH + _SURELY_APART, _TOUCH, gaps)
    reached = np.linalg.norm(thumbs[:, :, None, 2] - fingers[:, None, :, 3], axis=3)
    touching = (nearness[:, None] * (reached - wanted[:, None]) ** 2).sum(axis=2)
    shares = np.array([0.3, 0.7, 1.0])[:, None]
    probes = np.concatenate(
        [
            thumbs[:, :, None, part] + shares * (thumbs[:, :, None, part + 1] - thumbs[:, :, None, part])
            for part in (0, 1)
        ],
        axis=2,
    )
    inside = np.zeros(thumbs.shape[:2])
    for finger in range(4):
        for part in range(3):
            start, end = fingers[:, None, None, finger, part], fingers[:, None, None, finger, part + 1]
            bone = end - start
            along = np.clip(((probes - start) * bone).sum(axis=3) / (bone**2).sum(axis=3), 0.0, 1.0)
            away = np.linalg.norm(probes - start - along[..., None] * bone, axis=3)
            inside += (np.maximum(_RADII - away, 0.0) ** 2).sum(axis=2)
    over_palm = (probes[..., 0] < _PALM_TO) & (np.abs(probes[..., 1]) < _PALM_HALF_WIDTH)
    sunk = np.where(over_palm, np.maximum(_PALM_FRONT - probes[..., 2], 0.0), 0.0)
    inside += (sunk**2).sum(axis=2)
    cost: Array = _TOUCH_WEIGHT * touching + _INSIDE_WEIGHT * inside
    return cost
