# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""TEO's right hand as points and rods, in the axes of its palm: one handshape (`DextraHand`) or many at once.

A finger's points depend on its one flexion, the thumb's on abductor and flexion: `DextraTable` works both out
once by forward kinematics on a fine grid and interpolates.
"""

from __future__ import annotations

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_description import RIGHT_HAND, joint_limits
from teo_description.robot import Robot

FINGERS = ("Index", "Middle", "Ring", "Pinky")

# Lengths of a finger's phalanges [m], knuckle to tip, alike on the four fingers (Dextra's model).
PHALANGES = np.array([0.035, 0.025, 0.027])

FINGER_LENGTH = float(PHALANGES.sum())

# Thickest phalanges of the collision model [m].
FINGER_RADIUS, THUMB_RADIUS = 0.009, 0.009

# Height of a thumb's axis over the palm's frame at which its surface touches the palm's box [m].
PALM_FRONT = 0.009 - 0.003

# The palm's box along and across the hand [m], the thumb's radius added at its sides.
PALM_FROM, PALM_TO, PALM_HALF_WIDTH = -0.075, 0.032, 0.047

# Step of the table [rad]: between its points it is off by (finger length) * step^2 / 8 < 0.1 mm.
_STEP = np.radians(2.0)


class HandPoints(NamedTuple):
    """Joints and tips in palm axes: along the hand, to the little finger's side, out of the palm [m]."""

    fingers: Array
    """Knuckle, middle joint, last joint and tip of index, middle, ring and little finger. Shape (4, 4, 3)."""
    thumb: Array
    """Knuckle, joint and tip. Shape (3, 3)."""


class DextraHand:
    """Forward kinematics of the right hand relative to its palm."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        parts = ("_link", "Middle_link", "Distal_link", "Tip")
        self._frames = [
            "right_palm",
            *(f"Right{finger}Finger{part}" for finger in FINGERS for part in parts),
            *(f"RightThumbFinger{part}" for part in ("_link", "Distal_link", "Tip")),
        ]

    def points(self, positions: Array) -> HandPoints:
        """Where the joints of the hand are.

        Args:
            positions: Positions of the six axes of `RIGHT_HAND` [rad]. Shape (6,).
        """
        q = self._robot.configuration(dict(zip(RIGHT_HAND, positions.tolist(), strict=True)))
        places = self._robot.placements(q, self._frames)
        palm, others = places[0], places[1:, :3, 3]
        local = (others - palm[:3, 3]) @ palm[:3, :3]
        return HandPoints(local[:16].reshape(4, 4, 3), local[16:])


def thumb_clearances(points: HandPoints) -> Array:
    """Distances of the thumb from the fingers' phalanges and the palm [m]; negative is overlap.

    Left out of the robot's own clearance because fingers and thumb are meant to meet.
    """
    starts, ends = points.thumb[:-1], points.thumb[1:]
    finger_starts, finger_ends = points.fingers[:, :-1].reshape(-1, 3), points.fingers[:, 1:].reshape(-1, 3)
    found = [
        segment_distances(start, end, finger_starts, finger_ends) - (FINGER_RADIUS + THUMB_RADIUS)
        for start, end in zip(starts, ends, strict=True)
    ]
    samples = np.linspace(starts, ends, 3).reshape(-1, 3)
    over_palm = (
        (samples[:, 0] > PALM_FROM) & (samples[:, 0] < PALM_TO) & (np.abs(samples[:, 1]) < PALM_HALF_WIDTH)
    )
    found.append(np.where(over_palm, samples[:, 2] - PALM_FRONT, np.inf))
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


class DextraTable:
    """Joints and tips of the right hand in palm axes (along, to the little finger's side, out of the palm).

    Attributes:
        flexions: At which the fingers are tabled [rad]. Shape (f,).
        fingers: Knuckle, middle joint, last joint and tip of index ... little finger [m]. Shape (f, 4, 4, 3).
        abductors, thumb_flexions: At which the thumb is tabled [rad]. Shapes (a,) and (t,).
        thumb: Knuckle, joint and tip [m]. Shape (a, t, 3, 3).
    """

    def __init__(self, robot: Robot) -> None:
        hand, limits = DextraHand(robot), joint_limits(RIGHT_HAND)
        self.abductors, self.thumb_flexions, self.flexions = (
            np.linspace(low, high, int(np.ceil((high - low) / _STEP)) + 1)
            for low, high in zip(limits.lower[:3], limits.upper[:3], strict=True)
        )
        straight = limits.lower[2:]
        self.fingers = np.stack(
            [hand.points(np.concatenate([[0.0, 0.0], np.full(4, bend)])).fingers for bend in self.flexions]
        )
        self.thumb = np.stack(
            [
                [
                    hand.points(np.concatenate([[abductor, bend], straight])).thumb
                    for bend in self.thumb_flexions
                ]
                for abductor in self.abductors
            ]
        )

    def finger_points(self, flexions: Array) -> Array:
        """Knuckle, middle joint, last joint and tip of four fingers [m].

        Args:
            flexions: Of index, middle, ring and little finger [rad]. Shape (n, 4).

        Returns:
            Shape (n, 4, 4, 3).
        """
        below, share = _between(self.flexions, flexions)
        finger = np.arange(4)
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


_tables: WeakKeyDictionary[Robot, DextraTable] = WeakKeyDictionary()


def dextra_table(robot: Robot) -> DextraTable:
    """The table of a robot, worked out once: it takes longer than bringing a second onto TEO."""
    if robot not in _tables:
        _tables[robot] = DextraTable(robot)
    return _tables[robot]


def _between(grid: Array, values: Array) -> tuple[NDArray[np.intp], Array]:
    """Index of the grid's point below each value, and the share of the way to the next."""
    place = (values - grid[0]) / (grid[1] - grid[0])
    below = np.clip(place.astype(np.intp), 0, len(grid) - 2)
    return below, place - below
