# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The major places of TEO's hand beside those of the person's, frame by frame.

A major place is what a person who watches reads of where a sign is made: five heights, four sides, and
whether the hand is on the face, elsewhere on the body, in the air before it or behind it. A hand that is 12
cm off within these is at the same place; one that is 5 cm off across a border may be at another. A hand has a
breadth: one that lies across a border is on both its sides. The finer names are those of
`signing_space`.

Person and robot are each read by their own body: the person's chin, crown, waist and shoulders, and TEO's.
Nothing of the map that says where the robot's hand is to go is used, so that its faults are seen as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_capture.retarget.body_map import BodyMap
from teo_sign_capture.signing_space import MIRROR, find_place
from teo_sign_capture.tracks.signer_motion import Person

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


# Places of the face, as in `Person.places` and `signing_space`.
_FACE = ("forehead", "eye", "nose", "mouth", "chin")
# Shares of the way from the shoulders to the hips at which the chest ends and the waist is.
_CHEST, _WAIST = 1.0 / 3.0, 0.7
# Shares of the distance from the middle of the body to a shoulder within which the middle is, and the outside
# begins.
_MIDDLE, _OUTSIDE = 0.4, 1.2
# [m] A hand nearer than this to a place of the face is on it: of a person whose trunk is `_TRUNK` long, and
# of TEO, whose fingers are 2 cm thick and stop 3 cm before the face.
_NEAR, _NEAR_TEO, _TRUNK = 0.10, 0.13, 0.48
# [m] Breadth of a hand, of a person whose trunk is `_TRUNK` long (Tilley, The Measure of Man and Woman, 1993:
# 80 to 90 mm), and of TEO's.
_BREADTH, _BREADTH_TEO = 0.085, 0.09
# [m] A person's hand farther behind the line of the shoulders than this is behind the body; beside it hands
# swing to and fro by less. Of TEO's what is behind that line at all is.
_BEHIND = 0.10


def place_figures(
    body: BodyMap, person: Person, points: Array, moved: Array, teo: Array, side: str
) -> dict[str, Flags]:
    """Compare the places of one hand, by the fields of `RobotMotion`. Shape (T,) each.

    Args:
        body: The map, for TEO's size.
        person: The person.
        points: The point of the person's hand that counts, in the axes of the track [m]. Shape (T, 3).
        moved: How far the person's head has moved from where it mostly is [m]. Shape (T, 3).
        teo: The same point of TEO's hand, a left one in a mirror [m]. Shape (T, 3).
        side: "right" or "left".
    """
    zones, own = _zones_of_person(person), _zones_of_teo(body, person)
    flip = MIRROR if side == "left" else np.ones(3)
    shown = zones.find(points * flip)
    # On the face is judged where the face is: a head that bows takes it along.
    shown = shown._replace(from_face=zones.find((points - moved) * flip).from_face)
    found = own.find(teo)
    return {
        "same_zone": same_zone(shown, found),
        "same_zone_of_middle": same_zone_of_middles(shown, found),
        "wrong_place": wrong_place(shown, found),
    }


def _zones_of_person(person: Person) -> Zones:
    trunk = person.trunk
    face = [person.places[name] for name in _FACE]
    return Zones(
        heights=np.array(
            [-_WAIST * trunk, -_CHEST * trunk, person.places["chin"][2], person.places["head_top"][2]]
        ),
        sides=person.shoulder * np.array([-_OUTSIDE, -_MIDDLE, _MIDDLE]),
        face=np.array([*face, person.places["eye"] * MIRROR]),
        near=_NEAR * trunk / _TRUNK,
        breadth=_BREADTH * trunk / _TRUNK,
        behind=-_BEHIND * trunk / _TRUNK,
    )


def _zones_of_teo(body: BodyMap, person: Person) -> Zones:
    """TEO's own heights; sides as wide as its space is, for its shoulders are too far apart for its face."""
    face = [find_place(body.humanoid, name).point for name in _FACE]
    names = ("chin", "head_top", "chest", "belly")
    chin, crown, chest, belly = (find_place(body.humanoid, name).point[2] for name in names)
    return Zones(
        heights=np.array([(1.0 - _WAIST) * body.shoulder_height, (chest + belly) / 2.0, chin, crown]),
        sides=body.scale[1] * person.shoulder * np.array([-_OUTSIDE, -_MIDDLE, _MIDDLE]),
        face=np.array([*face, find_place(body.humanoid, "eye").point * MIRROR]),
        near=_NEAR_TEO,
        breadth=_BREADTH_TEO,
        behind=0.0,
    )
