# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's fingers and thumb over time on a robot's hand.

A robot's finger has one motor for all its joints. The flexion sought is the one with which the last phalanx
lies, in the plane in which the finger bends, most like the person's: both its ends, on phalanges as long as
the robot's.

Its thumb has an abductor and one motor for both its joints. Its tip and joint are sought relative to the
knuckle of the index, in finger lengths; its tip as far from the other tips as the person's where they nearly
touch; and outside of fingers and palm. The same tip can be nearly reached from several sides, so that what
is best frame by frame jumps: the cheapest path through time is taken (Viterbi).

`alphabet.spelling_hand` does the same for single letters that one camera has seen, where the line of sight
counts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_common.dynamic_programming import cheapest_path
from teo_description.hand_geometry import HandGeometry, HandTable
from teo_sign_capture.signing_space import finger_rows
from teo_sign_capture.tracks.signer_motion import SignerArm
from teo_sign_capture.tracks.skeleton_track import smoothed
from teo_skeleton_retriever.lifting.hand_axes import KNUCKLES

# Joints of a person's finger.
_FINGER_JOINTS = 3


class HandMotion(NamedTuple):
    """A hand of a robot over time.

    Attributes:
        axes: Of the right hand [rad]; a left hand as the right one that it mirrors. Shape (T, axes).
        error: Mean over the fingers of the difference of the whole bend, one joint's share [rad]. Shape (T,).
    """

    axes: Array
    error: Array


def follow_hand(table: HandTable, times: Array, arm: SignerArm) -> HandMotion:
    """Find the robot's hand in each frame.

    Args:
        table: The robot's hand.
        times: Of the frames [s]. Shape (T,).
        arm: The person's, with its hand.
    """
    bends, rows = arm.bends, finger_rows(table.hand)
    fingers = finger_flexions(table, bends)
    scaled = arm.local * (table.hand.finger_length / finger_length(arm))
    first = KNUCKLES[rows[0]]
    thumb = follow_thumb(table, times, fingers, scaled - scaled[:, first, None])
    error = np.abs(bends[:, rows].sum(axis=2) - _whole_bends(table, fingers)).mean(axis=1) / _FINGER_JOINTS
    return HandMotion(np.concatenate([thumb, fingers], axis=1), error)


def finger_length(arm: SignerArm) -> float:
    """Length of a person's fingers, median of the four and of the frames [m]."""
    fingers = [arm.local[:, row : row + 4] for row in KNUCKLES]
    return float(np.median([np.linalg.norm(np.diff(one, axis=1), axis=2).sum(axis=1) for one in fingers]))


def finger_flexions(table: HandTable, bends: Array) -> Array:
    """Flexion of each of the robot's fingers that looks most like a person's [rad].

    Args:
        table: The robot's hand.
        bends: Of the joints of a person's four fingers [rad]. Shape (T, 4, 3).

    Returns:
        Shape (T, fingers).
    """
    total = np.cumsum(bends[:, finger_rows(table.hand)], axis=2)
    steps = table.hand.phalanges[:, :, None] * np.stack([np.cos(total), np.sin(total)], axis=-1)
    wanted = np.cumsum(steps, axis=2)[:, :, 1:]
    count = len(table.hand.fingers)
    found = np.empty((len(bends), count))
    for finger in range(count):
        points = table.fingers[:, finger]
        reached = (points[:, 2:] - points[:, :1])[..., (0, 2)]
        cost = ((wanted[:, finger, None] - reached) ** 2).sum(axis=(2, 3))
        found[:, finger] = _lowest(table.flexions, cost)
    return found


def _whole_bends(table: HandTable, fingers: Array) -> Array:
    """By how much fingers of some flexions bend from knuckle to tip [rad]. Shapes (T, fingers)."""
    last = table.fingers[:, :, 3] - table.fingers[:, :, 2]
    whole = np.unwrap(np.arctan2(last[..., 2], last[..., 0]), axis=0)
    bends = [np.interp(column, table.flexions, row) for column, row in zip(fingers.T, whole.T, strict=True)]
    return np.stack(bends, axis=1)


def axis_shares(table: HandTable) -> Array:
    """What a finger's axis turns by for each of a person's three joints that bends by 1. Shape (fingers,)."""
    ends = np.repeat(table.flexions[[0, -1], None], len(table.hand.fingers), axis=1)
    whole = np.diff(_whole_bends(table, ends), axis=0)[0]
    shares: Array = np.round(_FINGER_JOINTS * (table.flexions[-1] - table.flexions[0]) / whole, 6)
    return shares


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


_JOINT, THUMB_TIP = 3, 4
# Rows of the 21 keypoints.
_FINGER_TIPS = (8, 12, 16, 20)

# Weights of squares: of a metre at the thumb's joint (1 at its tip), at the distance to a tip that it
# touches, inside of a finger or the palm; of a radian of way from frame to frame: 6 deg cost as much as 2 mm.
_JOINT_WEIGHT, _TOUCH_WEIGHT, _INSIDE_WEIGHT, _WAY_WEIGHT = 0.3, 3.0, 60.0, 4e-4
# [m] Tips farther apart than this, on the robot's scale, are not meant to touch.
_NEAR = 0.045
# [m] A gap smaller than this is a contact: two keypoints are off by 3 mm each.
_SURELY_APART = 0.006
# Thumbs looked at closely in each frame: those whose tip is best.
_CANDIDATES = 32
# Every so manieth of the hand table's steps of 2 deg is a candidate; the path is smoothed afterwards.
_EVERY = 2
# [s] Standard deviation of the Gaussian that takes the steps away.
_TREMBLE = 0.04


def _touching_axes(hand: HandGeometry) -> float:
    """Distance of the axes of thumb and finger when they touch [m]."""
    return float(hand.finger_radii[0] + hand.thumb_radii[-1])


def thumb_contacts(hand: HandGeometry, gaps: Array) -> tuple[Array, Array]:
    """What gaps between a person's thumb and fingers ask of a robot's thumb.

    Args:
        hand: The robot's hand.
        gaps: Distances of the thumb's tip from the fingers', on the robot's scale [m]. Shape (..., f).

    Returns:
        How much the thumb is at each finger, 1 in all at most, and how far from its tip the robot's should be
        [m]. Shapes (..., f).
    """
    nearness = np.clip(1.0 - gaps / _NEAR, 0.0, 1.0)
    # Several fingers at the thumb share the weight of one: else D's three would be bent into a fist to
    # reach it.
    nearness /= np.maximum(nearness.sum(axis=-1, keepdims=True), 1.0)
    touch = _touching_axes(hand)
    return nearness, np.where(gaps < touch + _SURELY_APART, touch, gaps)


def follow_thumb(table: HandTable, times: Array, fingers: Array, person: Array) -> Array:
    """Find abductor and flexion of the robot's thumb in each frame.

    Args:
        table: The robot's hand.
        times: [s]. Shape (T,).
        fingers: Flexions of the robot's fingers [rad]. Shape (T, fingers).
        person: The person's 21 keypoints in palm axes from the knuckle of the first of these fingers, in the
            robot's size [m]. Shape (T, 21, 3).

    Returns:
        [rad]. Shape (T, 2).
    """
    abductors, flexions = table.abductors[::_EVERY], table.thumb_flexions[::_EVERY]
    angles = np.stack(np.meshgrid(abductors, flexions, indexing="ij"), axis=-1).reshape(-1, 2)
    grid = table.thumb[::_EVERY, ::_EVERY].reshape(-1, 3, 3)
    points = table.finger_points(fingers)
    knuckle = table.fingers[0, 0, 0]
    rough = _apart(person[:, THUMB_TIP] + knuckle, grid[:, 2])
    rough += _JOINT_WEIGHT * _apart(person[:, _JOINT] + knuckle, grid[:, 1])
    chosen = np.argpartition(rough, _CANDIDATES, axis=1)[:, :_CANDIDATES]
    cost = np.take_along_axis(rough, chosen, axis=1) + _meeting(table.hand, grid[chosen], points, person)
    path = cheapest_path(cost, angles[chosen], _WAY_WEIGHT)
    return smoothed(times, angles[chosen[np.arange(len(path)), path]], _TREMBLE)


def _apart(wanted: Array, reached: Array) -> Array:
    """Squares of the distances of n points from m others [m^2]. Shape (n, m)."""
    squares = (wanted**2).sum(axis=1)[:, None] + (reached**2).sum(axis=1) - 2.0 * wanted @ reached.T
    apart: Array = np.maximum(squares, 0.0)
    return apart


def _meeting(hand: HandGeometry, thumbs: Array, fingers: Array, person: Array) -> Array:
    """What thumbs cost that do not meet the fingers as the person's does, or go into them.

    Args:
        hand: The robot's.
        thumbs: Knuckle, joint and tip of c candidates [m]. Shape (T, c, 3, 3).
        fingers: Shape (T, fingers, 4, 3).
        person: Shape (T, 21, 3).

    Returns:
        Shape (T, c).
    """
    tips = [_FINGER_TIPS[row] for row in finger_rows(hand)]
    gaps = np.linalg.norm(person[:, tips] - person[:, THUMB_TIP, None], axis=2)
    nearness, wanted = thumb_contacts(hand, gaps)
    touch, box = _touching_axes(hand), hand.palm_box
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
    for finger in range(fingers.shape[1]):
        for part in range(3):
            start, end = fingers[:, None, None, finger, part], fingers[:, None, None, finger, part + 1]
            bone = end - start
            along = np.clip(((probes - start) * bone).sum(axis=3) / (bone**2).sum(axis=3), 0.0, 1.0)
            away = np.linalg.norm(probes - start - along[..., None] * bone, axis=3)
            inside += (np.maximum(touch - away, 0.0) ** 2).sum(axis=2)
    over_palm = (probes[..., 0] < box.end) & (np.abs(probes[..., 1]) < box.half_width)
    sunk = np.where(over_palm, np.maximum(box.front - probes[..., 2], 0.0), 0.0)
    inside += (sunk**2).sum(axis=2)
    cost: Array = _TOUCH_WEIGHT * touching + _INSIDE_WEIGHT * inside
    return cost
