# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The major place of a hand: what a person who watches reads of where a sign is made.

Five heights, four sides, and whether the hand is on the face, elsewhere on the body or in the air. A hand
that is 12 cm off within these is at the same place to who watches; one that is 5 cm off across one may be at
another. The finer names are those of `places`.
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
    """

    heights: Array
    sides: Array
    face: Array
    near: float

    def find(self, points: Array) -> MajorPlaces:
        """The zones of points. Shape (T, 3) [m]."""
        away = np.linalg.norm(points[:, None] - self.face, axis=2).min(axis=1)
        return MajorPlaces(
            height=np.searchsorted(self.heights, points[:, 2]),
            side=np.searchsorted(self.sides, points[:, 1]),
            from_face=away / self.near,
        )


class MajorPlaces(NamedTuple):
    """Major places of a hand over time.

    Attributes:
        height: Row of `HEIGHTS`. Shape (T,).
        side: Row of `SIDES`. Shape (T,).
        from_face: Distance from the nearest place of the face, as a share of that within which a hand is on
            it. Shape (T,).
    """

    height: NDArray[np.intp]
    side: NDArray[np.intp]
    from_face: Array


# A hand counts as on the face instead of in the air, or the reverse, only beyond this share of the distance:
# one that the person has just within it and the robot just outside is at no other place.
_UNDECIDED = 0.5


def same_zone(first: MajorPlaces, second: MajorPlaces) -> Flags:
    """In which moments both are in one zone. Shape (T,)."""
    return np.asarray((first.height == second.height) & (first.side == second.side))


def wrong_place(first: MajorPlaces, second: MajorPlaces) -> Flags:
    """In which moments who watches reads another place: more than one zone away, or face and air confused."""
    far = (np.abs(first.height - second.height) > 1) | (np.abs(first.side - second.side) > 1)
    on, other_on = first.from_face < 1.0, second.from_face < 1.0
    apart = np.abs(first.from_face - second.from_face) > _UNDECIDED
    return np.asarray(far | ((on != other_on) & apart))
