# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The major place of a hand: what a person who watches reads of where a sign is made.

Five heights, four sides, and whether the hand is on the face, elsewhere on the body, in the air before it or
behind it. A hand that is 12 cm off within these is at the same place to who watches; one that is 5 cm off
across a border may be at another. A hand has a breadth: one that lies across a border is on both its sides.
The finer names are those of `places`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array

Flags = NDArray[np.bool_]

# Zones from the lowest up, and from the hand's own side to the other.
HEIGHTS = ("below the waist", "belly", "chest", "face", "above the head")
SIDES = ("outside", "own side", "middle", "other side")


@dataclass(frozen=True, kw_only=True, eq=False)
class Zones:
    """The zones of one body, seen from the shoulder of the hand's side; right hands, left ones in a mirror.

    Attributes:
        heights: Where one height ends and the next begins, upwards [m]. Shape (4,).
        sides: Where one side ends and the next begins, leftwards [m]. Shape (3,).
        face: Named places of the face, by which a hand is on it [m]. Shape (k, 3).
        near: A hand nearer than this to one of them is on the face [m].
        breadth: Of a hand [m].
        behind: A hand less far forwards than this is behind the body [m].
    """

    heights: Array
    sides: Array
    face: Array
    near: float
    breadth: float
    behind: float

    def find(self, points: Array) -> MajorPlaces:
        """The zones of points. Shape (T, 3) [m]."""
        away = np.linalg.norm(points[:, None] - self.face, axis=2).min(axis=1)
        return MajorPlaces(
            height=np.searchsorted(self.heights, points[:, 2]),
            heights=self._touched(self.heights, points[:, 2]),
            side=np.searchsorted(self.sides, points[:, 1]),
            sides=self._touched(self.sides, points[:, 1]),
            from_face=away / self.near,
            behind=points[:, 0] < self.behind,
        )

    def _touched(self, borders: Array, along: Array) -> NDArray[np.intp]:
        """The first and the last zone that hands lie in. Shape (T, 2)."""
        reach = self.breadth / 2.0
        return np.stack([np.searchsorted(borders, along + way) for way in (-reach, reach)], axis=1)


class MajorPlaces(NamedTuple):
    """Major places of a hand over time.

    Attributes:
        height: Row of `HEIGHTS` that the middle of the hand is in. Shape (T,).
        heights: First and last row that the hand lies in. Shape (T, 2).
        side: Row of `SIDES` that the middle of the hand is in. Shape (T,).
        sides: First and last row that the hand lies in. Shape (T, 2).
        from_face: Distance from the nearest place of the face, as a share of that within which a hand is on
            it. Shape (T,).
        behind: Whether it is behind the body. Shape (T,).
    """

    height: NDArray[np.intp]
    heights: NDArray[np.intp]
    side: NDArray[np.intp]
    sides: NDArray[np.intp]
    from_face: Array
    behind: Flags


# A hand counts as on the face instead of in the air, or the reverse, only beyond this share of the distance:
# one that the person has just within it and the robot just outside is at no other place.
_UNDECIDED = 0.5


def same_zone(first: MajorPlaces, second: MajorPlaces) -> Flags:
    """In which moments both are in one zone, at least in part. Shape (T,)."""
    return _meet(first.heights, second.heights) & _meet(first.sides, second.sides)


def same_zone_of_middles(first: MajorPlaces, second: MajorPlaces) -> Flags:
    """In which moments the middles of both are in one zone, breadths left aside. Shape (T,)."""
    return np.asarray((first.height == second.height) & (first.side == second.side))


def wrong_place(first: MajorPlaces, second: MajorPlaces) -> Flags:
    """In which moments who watches reads another place: more than one zone away, face, air or back confused.

    Shape (T,).
    """
    far = (np.abs(first.height - second.height) > 1) | (np.abs(first.side - second.side) > 1)
    on, other_on = first.from_face < 1.0, second.from_face < 1.0
    apart = np.abs(first.from_face - second.from_face) > _UNDECIDED
    return np.asarray(far | ((on != other_on) & apart) | (first.behind != second.behind))


def _meet(first: NDArray[np.intp], second: NDArray[np.intp]) -> Flags:
    """Which ranges of rows have one in common. Shapes (T, 2), (T,)."""
    return np.asarray(np.maximum(first[:, 0], second[:, 0]) <= np.minimum(first[:, 1], second[:, 1]))
