# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A humanoid's right hand as points and rods, in its palm's axes: one handshape (`HandGeometry`) or many.

A finger's points depend on its one flexion, the thumb's on abductor and flexion: `HandTable` works both out
once by forward kinematics on a fine grid and interpolates. Frames and measures are those of `robot.yaml`;
fingers that a hand lacks are left out, so that arrays have a row for each finger that there is.

Fingers and thumb are meant to meet, so `clearance` leaves the parts of one hand out. They may touch, and not
pass through each other: `thumb_gaps` measures that, for thumb and phalanges as capsules about the points.
These are the rods of the collision model with round ends, as the drawn finger tips have them. A rod's flat
ends stand out behind a bent joint, by up to 7 mm, and are not seen.
"""

from __future__ import annotations

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_description.robot_schema import PalmBox

# Step of the table [rad]: between its points it is off by (finger length) * step^2 / 8 < 0.1 mm.
_STEP = np.radians(2.0)

# Decimals of a length [m] that are kept: a nanometre, so that rounding in forward kinematics stays out of it.
_DECIMALS = 9


class HandPoints(NamedTuple):
    """Joints and tips in palm axes: along the hand, to the little finger's side, out of the palm [m]."""

    fingers: Array
    """Knuckle, middle joint, last joint and tip of each finger, index first. Shape (fingers, 4, 3)."""
    thumb: Array
    """Knuckle, joint and tip. Shape (3, 3)."""


class HandGeometry:
    """Forward kinematics of the right hand relative to its palm.

    Attributes:
        joints: Its commanded axes: abductor, thumb, then the fingers that there are.
        limits: Their limits.
        fingers: Names of the fingers, of ``index``, ``middle``, ``ring`` and ``pinky``.
        phalanges: Lengths from the knuckle to the tip [m]. Shape (fingers, 3).
        finger_length: Sum of the phalanges of the median finger [m].
        finger_radii, thumb_radii: Thickness of the phalanges from the knuckle on [m]. Shapes (3,) and (2,).
        palm_box: Where the palm is to the thumb.
        palm_middle, heel: Middle of the palm, and where the hand ends at the wrist [m]. Shape (3,).
    """

    def __init__(self, robot: Robot) -> None:
        humanoid, hand = robot.humanoid, robot.humanoid.file.hand
        self._robot = robot
        self.joints = humanoid.hand("right")
        self.limits = humanoid.limits(self.joints)
        self.fingers = tuple(hand.fingers)
        self.finger_radii, self.thumb_radii = np.array(hand.finger_radii), np.array(hand.thumb_radii)
        self.palm_box: PalmBox = hand.palm_box
        self.palm_middle, self.heel = np.array(hand.palm_middle), np.array(hand.heel)
        at_home = self.points(np.array([humanoid.home[name] for name in self.joints])).fingers
        self.phalanges: Array = np.round(np.linalg.norm(np.diff(at_home, axis=1), axis=2), _DECIMALS)
        self.finger_length = float(np.median(self.phalanges.sum(axis=1)))

    def points(self, positions: Array) -> HandPoints:
        """Where the joints of the hand are.

        Args:
            positions: Positions of `joints` [rad]. Shape (joints,).
        """
        q = self._robot.configuration(dict(zip(self.joints, positions.tolist(), strict=True)))
        places = self._robot.placements(q, self._robot.humanoid.file.hand.frames)
        palm, others = places[0], places[1:, :3, 3]
        local = (others - palm[:3, 3]) @ palm[:3, :3]
        return HandPoints(local[:-3].reshape(-1, 4, 3), local[-3:])

    def thumb_clearances(self, points: HandPoints) -> Array:
        """Distances of the thumb from the fingers' phalanges and the palm [m]; negative is overlap.

        Left out of the robot's own clearance because fingers and thumb are meant to meet.
        """
        starts, ends = points.thumb[:-1], points.thumb[1:]
        finger_starts, finger_ends = (
            points.fingers[:, :-1].reshape(-1, 3),
            points.fingers[:, 1:].reshape(-1, 3),
        )
        radii = self.finger_radii[0] + self.thumb_radii[-1]
        found = [
            segment_distances(start, end, finger_starts, finger_ends) - radii
            for start, end in zip(starts, ends, strict=True)
        ]
        samples, box = np.linspace(starts, ends, 3).reshape(-1, 3), self.palm_box
        over_palm = (samples[:, 0] > box.start) & (samples[:, 0] < box.end)
        over_palm &= np.abs(samples[:, 1]) < box.half_width
        found.append(np.where(over_palm, samples[:, 2] - box.front, np.inf))
        return np.concatenate(found)


def segment_distances(start: Array, end: Array, starts: Array, ends: Array) -> Array:
    """Distances of one segment from several (Ericson, Real-Time Collision Detection, 2005, 5.1.9).

    Args:
        start: One end of the segment. Shape (3,).
        end: The other. Shape (3,).
        starts: One end of each of n segments. Shape (n, 3).
        ends: The others. Shape (n, 3).

    Returns:
        Shape (n,).
    """
    one, others, between = end - start, ends - starts, start - starts
    a, e = float(one @ one), np.einsum("ij,ij->i", others, others)
    b, c, f = others @ one, between @ one, np.einsum("ij,ij->i", others, between)
    determinant = a * e - b * b
    parallel = determinant < 1e-12
    s = np.clip(np.where(parallel, 0.0, (b * f - c * e) / np.where(parallel, 1.0, determinant)), 0.0, 1.0)
    t = np.clip((b * s + f) / e, 0.0, 1.0)
    s = np.clip((b * t - c) / a, 0.0, 1.0)
    distances: Array = np.linalg.norm(between + s[:, None] * one - t[:, None] * others, axis=1)
    return distances


class HandTable:
    """Joints and tips of the right hand in palm axes (along, to the little finger's side, out of the palm).

    Attributes:
        hand: What is tabled.
        flexions: At which the fingers are tabled [rad]. Shape (f,).
        fingers: Knuckle, middle joint, last joint and tip of each finger [m]. Shape (f, fingers, 4, 3).
        abductors, thumb_flexions: At which the thumb is tabled [rad]. Shapes (a,) and (t,).
        thumb: Knuckle, joint and tip [m]. Shape (a, t, 3, 3).
    """

    def __init__(self, robot: Robot) -> None:
        self.hand = HandGeometry(robot)
        limits = self.hand.limits
        count = len(self.hand.fingers)
        self.abductors = _grid(limits.lower[0], limits.upper[0])
        self.thumb_flexions = _grid(limits.lower[1], limits.upper[1])
        self.flexions = _grid(limits.lower[2:].min(), limits.upper[2:].max())
        straight = limits.lower[2:]
        self.fingers = np.stack(
            [self.hand.points(np.array([0.0, 0.0, *(bend,) * count])).fingers for bend in self.flexions]
        )
        self.thumb = np.stack(
            [
                [
                    self.hand.points(np.concatenate([[abductor, bend], straight])).thumb
                    for bend in self.thumb_flexions
                ]
                for abductor in self.abductors
            ]
        )

    def finger_points(self, flexions: Array) -> Array:
        """Knuckle, middle joint, last joint and tip of each finger [m].

        Args:
            flexions: Of the fingers that there are, index first [rad]. Shape (n, fingers).

        Returns:
            Shape (n, fingers, 4, 3).
        """
        below, share = _between(self.flexions, flexions)
        finger = np.arange(len(self.hand.fingers))
        low, high = self.fingers[below, finger], self.fingers[below + 1, finger]
        points: Array = low + share[..., None, None] * (high - low)
        return points

    def thumb_points(self, abductors: Array, flexions: Array) -> Array:
        """Knuckle, joint and tip of the thumb [m]; arguments and result of shapes (n,) and (n, 3, 3)."""
        row, down = _between(self.abductors, abductors)
        column, right = _between(self.thumb_flexions, flexions)
        down, right = down[..., None, None], right[..., None, None]
        points: Array = (1.0 - down) * (
            (1.0 - right) * self.thumb[row, column] + right * self.thumb[row, column + 1]
        ) + down * ((1.0 - right) * self.thumb[row + 1, column] + right * self.thumb[row + 1, column + 1])
        return points


_tables: WeakKeyDictionary[Robot, HandTable] = WeakKeyDictionary()


def hand_table(robot: Robot) -> HandTable:
    """The table of a robot, worked out once: it takes longer than a second of motion does."""
    if robot not in _tables:
        _tables[robot] = HandTable(robot)
    return _tables[robot]


def _grid(low: float, high: float) -> Array:
    return np.linspace(low, high, int(np.ceil((high - low) / _STEP)) + 1)


def _between(grid: Array, values: Array) -> tuple[NDArray[np.intp], Array]:
    """Index of the grid's point below each value, and the share of the way to the next."""
    place = (values - grid[0]) / (grid[1] - grid[0])
    below = np.clip(place.astype(np.intp), 0, len(grid) - 2)
    return below, place - below


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
    thumb = _segments(table.thumb_points(hands[:, 0], hands[:, 1]), thumb_radii)
    starts, ends = _segments(table.finger_points(hands[:, 2:]), finger_radii)
    radii = thumb_radii[:, None] + np.tile(finger_radii, len(table.hand.fingers))
    fingers = (points.reshape(len(hands), radii.shape[1], 3) for points in (starts, ends))
    gaps: Array = (_distances(*thumb, *fingers) - radii).min(axis=(1, 2))
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
    """Distances of every segment of one set from every one of another; see `segment_distances`.

    Args:
        starts: Of p segments, n times. Shape (n, p, 3).
        ends: Of the same.
        other_starts: Of q segments. Shape (n, q, 3).
        other_ends: Of the same.

    Returns:
        Shape (n, p, q).
    """
    one, other = ends - starts, other_ends - other_starts
    a, e = _dots(one, one)[:, :, None], _dots(other, other)[:, None]
    others, other_begins = np.swapaxes(other, 1, 2), np.swapaxes(other_starts, 1, 2)
    b = one @ others
    c = _dots(one, starts)[:, :, None] - one @ other_begins
    f = starts @ others - _dots(other, other_starts)[:, None]
    determinant = a * e - b * b
    parallel = determinant < 1e-12
    s = np.clip(np.where(parallel, 0.0, (b * f - c * e) / np.where(parallel, 1.0, determinant)), 0.0, 1.0)
    t = np.clip((b * s + f) / e, 0.0, 1.0)
    s = np.clip((b * t - c) / a, 0.0, 1.0)
    apart = _dots(starts, starts)[:, :, None] + _dots(other_starts, other_starts)[:, None]
    squares = apart - 2.0 * (starts @ other_begins) + s * (s * a + 2.0 * (c - t * b)) + t * (t * e - 2.0 * f)
    found: Array = np.sqrt(np.maximum(squares, 0.0))
    return found


def _dots(one: Array, other: Array) -> Array:
    dots: Array = np.einsum("...i,...i->...", one, other)
    return dots
