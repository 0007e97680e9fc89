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

from teo_lut_executor.capture.dextra import FINGER_LENGTH, PHALANGES
from teo_lut_executor.capture.dextra_table import DextraTable
from teo_lut_executor.capture.hand_model import palm_axes
from teo_lut_executor.capture.hand_points import KNUCKLES, WRIST
from teo_lut_executor.capture.thumb_motion import follow_thumb

Array = NDArray[np.float64]

_STRAIGHT = np.radians([5.0, 8.0, 5.0])
"""[rad] What knuckle, middle and last joint seem bent by in a straight finger, where the signer shows none:
joint centres do not lie on a line. Means over the synthetic signer's flat hands."""
_SEEN_STRAIGHT = np.radians(20.0)
"""[rad] A joint that is never less bent than this has not been seen straight."""
_STRAIGHTEST = 5.0
"""[%] Of the frames a finger is taken for straight in, if it ever is."""


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


def follow_hand(table: DextraTable, times: Array, hand: Array) -> HandMotion:
    """Find TEO's hand in each frame.

    Args:
        table: TEO's hand.
        times: Of the frames [s]. Shape (T,).
        hand: 21 keypoints of a right hand, or of a left one in a mirror, none NaN [m]. Shape (T, 21, 3).
    """
    local = np.einsum("tij,tki->tkj", palm_axes(hand), hand - hand[:, WRIST, None])
    bends = calibrated_bends(finger_bends(local))
    fingers = finger_flexions(table, bends)
    bones = [np.linalg.norm(np.diff(local[:, row : row + 4], axis=1), axis=2).sum(axis=1) for row in KNUCKLES]
    scaled = local * (FINGER_LENGTH / float(np.median(bones)))
    thumb = follow_thumb(table, times, fingers, scaled - scaled[:, KNUCKLES[0], None])
    error = np.abs(bends.sum(axis=2) / 3.0 - fingers).mean(axis=1)
    return HandMotion(np.concatenate([thumb, fingers], axis=1), bends, error)


def finger_bends(local: Array) -> Array:
    """Bends of knuckle, middle and last joint of index ... little finger [rad].

    Args:
        local: The 21 keypoints in palm axes. Shape (T, 21, 3).

    Returns:
        Shape (T, 4, 3).
    """
    bends = np.empty((len(local), 4, 3))
    for finger, knuckle in enumerate(KNUCKLES):
        bones = np.diff(local[:, knuckle : knuckle + 4], axis=1)
        bends[:, finger, 0] = np.arctan2(bones[:, 0, 2], bones[:, 0, 0])
        for joint in (1, 2):
            sine = np.linalg.norm(np.cross(bones[:, joint - 1], bones[:, joint]), axis=1)
            bends[:, finger, joint] = np.arctan2(sine, (bones[:, joint - 1] * bones[:, joint]).sum(axis=1))
    # A knuckle bent beyond 90 deg and more turns round through pi.
    bends[..., 0] = np.where(bends[..., 0] < -np.pi / 2.0, bends[..., 0] + 2.0 * np.pi, bends[..., 0])
    return bends


def calibrated_bends(bends: Array) -> Array:
    """Bends with 0 where this signer's fingers are straight; a joint never seen so is taken as usual."""
    least = np.percentile(bends, _STRAIGHTEST, axis=0)
    zeroed: Array = bends - np.where(np.abs(least) < _SEEN_STRAIGHT, least, _STRAIGHT)
    return zeroed


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
