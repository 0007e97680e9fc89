# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether the thumb is inside a finger of its own hand.

Fingers and thumb are meant to meet, so `clearance` leaves the parts of one hand out. They may touch, and not
pass through each other. Where they are depends on the axes of the hand alone. Thumb and phalanges are
capsules about the points of `hand_geometry`: the rods of the collision model with round ends, as the drawn
finger tips have them. A rod's flat ends stand out behind a bent joint, by up to 7 mm, and are not seen.
"""

from __future__ import annotations

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_geometry import HandTable

# So deep thumb and finger may be in each other where they touch [m]: the shapes of the collision model stand
# out over the drawn parts by 1 mm each, and a finger that its tendon pulls against something stops there.
TOUCH = 0.002


def thumb_gaps(table: HandTable, hands: Array) -> Array:
    """Least distances of the thumb from the fingers of its hand [m]; negative is overlap.

    Args:
        table: Of the robot.
        hands: Positions of the axes of a hand of either side, in the order of `HandGeometry.joints` [rad].
            Shape (n, axes).

    Returns:
        Shape (n,).
    """
    thumb_radii, finger_radii = table.hand.thumb_radii, table.hand.finger_radii
    thumb_starts, thumb_ends = _segments(table.thumb_points(hands[:, 0], hands[:, 1]), thumb_radii)
    starts, ends = _segments(table.finger_points(hands[:, 2:]), finger_radii)
    fingers = (len(hands), 1, len(table.hand.fingers), len(finger_radii))
    thumb = (len(hands), len(thumb_radii), 1, 1)
    apart = _distances(
        thumb_starts.reshape(*thumb, 3),
        thumb_ends.reshape(*thumb, 3),
        starts.reshape(*fingers, 3),
        ends.reshape(*fingers, 3),
    )
    gaps: Array = (apart - thumb_radii[:, None, None] - finger_radii).min(axis=(1, 2, 3))
    return gaps


def with_clear_thumb(table: HandTable, hand: Array) -> Array:
    """A handshape whose thumb is in no finger, moved as little as needed.

    Args:
        table: Of the robot.
        hand: Positions of its axes, in the order of `HandGeometry.joints` [rad]. Shape (axes,).

    Returns:
        The same where thumb and fingers only touch; else with the thumb clear of them that moves least.
    """
    if thumb_gaps(table, hand[None])[0] >= -TOUCH:
        return hand
    abductors, flexions = (
        grid.ravel() for grid in np.meshgrid(table.abductors, table.thumb_flexions, indexing="ij")
    )
    hands = np.tile(hand, (len(abductors), 1))
    hands[:, 0], hands[:, 1] = abductors, flexions
    moved = table.thumb_points(abductors, flexions) - table.thumb_points(hand[:1], hand[1:2])
    way = np.linalg.norm(moved[:, 1:], axis=-1).sum(axis=1)
    clear: Array = hands[np.argmin(np.where(thumb_gaps(table, hands) >= 0.0, way, np.inf))]
    return clear


def _segments(points: Array, radii: Array) -> tuple[Array, Array]:
    """Axes of capsules from joint to joint, the last ending a radius before the tip."""
    starts, ends = points[..., :-1, :], points[..., 1:, :].copy()
    last = ends[..., -1, :] - starts[..., -1, :]
    ends[..., -1, :] -= radii[-1] * last / np.linalg.norm(last, axis=-1, keepdims=True)
    return starts, ends


def _distances(starts: Array, ends: Array, other_starts: Array, other_ends: Array) -> Array:
    """Distances of segments, of shapes (..., 3) that broadcast; see `hand_geometry.segment_distances`."""
    one, other, between = ends - starts, other_ends - other_starts, starts - other_starts
    a, e, b = (_dots(*pair) for pair in ((one, one), (other, other), (one, other)))
    c, f = _dots(one, between), _dots(other, between)
    determinant = a * e - b * b
    parallel = determinant < 1e-12
    s = np.clip(np.where(parallel, 0.0, (b * f - c * e) / np.where(parallel, 1.0, determinant)), 0.0, 1.0)
    t = np.clip((b * s + f) / e, 0.0, 1.0)
    s = np.clip((b * t - c) / a, 0.0, 1.0)
    found: Array = np.linalg.norm(between + s[..., None] * one - t[..., None] * other, axis=-1)
    return found


def _dots(one: Array, other: Array) -> Array:
    dots: Array = np.einsum("...i,...i->...", one, other)
    return dots
