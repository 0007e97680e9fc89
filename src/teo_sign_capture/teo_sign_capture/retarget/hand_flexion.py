"""A person's fingers over time on TEO's hand.

TEO's finger has one motor for three joints that bend alike. What is sought is the flexion with which the last
phalanx lies, in the plane in which the finger bends, most like the person's: both its ends, on phalanges as
long as TEO's. How the thumb follows is said in `thumb_motion`.

`hand_retarget` does the same for single letters that one camera has seen, where the line of sight counts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_description.hand_geometry import FINGER_LENGTH, PHALANGES, DextraTable
from teo_sign_capture.retarget.thumb_motion import follow_thumb
from teo_sign_capture.signing_space.hand_points import KNUCKLES
from teo_sign_capture.tracks.finger_bends import finger_bends, in_palm

Array = NDArray[np.float64]


class HandMotion(NamedTuple):
    """A hand of TEO over time.

    Attributes:
        axes: Of `RIGHT_HAND` [rad]; a left hand's are the same numbers. Shape (T, 6).
        bends: Of the person's fingers, knuckle, middle and last joint, calibrated [rad]. Shape (T, 4, 3).
        error: Mean over the fingers of the difference of the whole bend, one joint's share [rad]. Shape (T,).
    """

    axes: Array
    bends: Array
    error: Array


def follow_hand(table: DextraTable, times: Array, hand: Array, straight: Array) -> HandMotion:
    """Find TEO's hand in each frame.

    Args:
        table: TEO's hand.
        times: Of the frames [s]. Shape (T,).
        hand: 21 keypoints of a right hand, or of a left one in a mirror, none NaN [m]. Shape (T, 21, 3).
        straight: `Person.straight` [rad]. Shape (4, 3).
    """
    local = in_palm(hand)
    bends = finger_bends(local) - straight
    fingers = finger_flexions(table, bends)
    bones = [np.linalg.norm(np.diff(local[:, row : row + 4], axis=1), axis=2).sum(axis=1) for row in KNUCKLES]
    scaled = local * (FINGER_LENGTH / float(np.median(bones)))
    thumb = follow_thumb(table, times, fingers, scaled - scaled[:, KNUCKLES[0], None])
    error = np.abs(bends.sum(axis=2) / 3.0 - fingers).mean(axis=1)
    return HandMotion(np.concatenate([thumb, fingers], axis=1), bends, error)


def finger_flexions(table: DextraTable, bends: Array) -> Array:
    """Flexion of each of TEO's fingers that looks most like a person's [rad]. (T, 4, 3) gives (T, 4)."""
    total = np.cumsum(bends, axis=2)
    steps = PHALANGES[:, None] * np.stack([np.cos(total), np.sin(total)], axis=-1)
    wanted = np.cumsum(steps, axis=2)[:, :, 1:]
    found = np.empty(bends.shape[:2])
    for finger in range(4):
        points = table.fingers[:, finger]
        reached = (points[:, 2:] - points[:, :1])[..., (0, 2)]
        cost = ((wanted[:, finger, None] - reached) ** 2).sum(axis=(2, 3))
        found[:, finger] = _lowest(table.flexions, cost)
    return found


def _lowest(grid: Array, cost: Array) -> Array:
    """Where costs on an even grid are least, by the parabola through the least and its neighbours."""
    best = np.clip(cost.argmin(axis=1), 1, len(grid) - 2)
    rows = np.arange(len(cost))
    before, at, after = (cost[rows, best + step] for step in (-1, 0, 1))
    curve = before - 2.0 * at + after
    shift = np.where(curve > 0.0, 0.5 * (before - after) / np.where(curve > 0.0, curve, 1.0), 0.0)
    places = grid[best] + np.clip(shift, -1.0, 1.0) * (grid[1] - grid[0])
    lowest: Array = np.clip(places, grid[0], grid[-1])
    return lowest
